#include "paper/requirements.hpp"

#include <algorithm>

namespace palpate::sim {

std::size_t Requirements::failed() const {
  return static_cast<std::size_t>(
      std::count_if(all_.begin(), all_.end(), [](const Requirement& one) { return !one.holds; }));
}

Table Requirements::table() const {
  Table table{"Over whole runs of two periods of the sine; the commands are in smoothness.csv.",
              {"what", "required", "measured"},
              {}};
  for (const Requirement& one : all_) {
    table.rows.push_back(
        {{one.what}, {one.required}, {one.measured, one.holds ? Mark::kHolds : Mark::kFails}});
  }
  return table;
}

}  // namespace palpate::sim
