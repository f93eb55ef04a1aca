#pragma once

#include <string>

namespace palpate::sim {

/// RFC 4648, with padding, in one line.
std::string base64(const std::string& bytes);

}  // namespace palpate::sim
