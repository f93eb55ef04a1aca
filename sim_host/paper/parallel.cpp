#include "paper/parallel.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace palpate::sim {

void print_line(const std::string& line) {
  static std::mutex printing;
  const std::lock_guard<std::mutex> lock(printing);
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

}  // namespace palpate::sim
