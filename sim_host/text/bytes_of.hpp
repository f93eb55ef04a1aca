#pragma once

#include <string>

#include "palpate/container/bytes.hpp"

namespace palpate {

/// Those of a text, which must stay.
inline container::Bytes bytes_of(const std::string& text) {
  return {reinterpret_cast<const uint8_t*>(text.data()), static_cast<uint32_t>(text.size())};
}

}  // namespace palpate
