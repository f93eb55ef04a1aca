// Why there is no bound, and where.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace palpate::wcet {

struct Place {
  std::string function;
  uint32_t address = 0;
  std::string line;  // file:line; empty without DWARF
};

/// "function at 0x1234 (file:line)"
std::string to_string(const Place& place);

/// The program holds something that has no bound, or that the analysis can't follow.
class Refusal : public std::runtime_error {
 public:
  Refusal(const Place& place, const std::string& why) : std::runtime_error(to_string(place) + ": " + why) {}
};

/// A file, a root or a model that is not there or can't be read.
class BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace palpate::wcet
