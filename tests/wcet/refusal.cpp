#include "refusal.hpp"

#include <fmt/format.h>

namespace palpate::wcet {

std::string to_string(const Place& place) {
  const std::string line = place.line.empty() ? "" : fmt::format(" ({})", place.line);
  return fmt::format("{} at {:#x}{}", place.function, place.address, line);
}

}  // namespace palpate::wcet
