// What the paper's experiments have to show, and whether they do.
#pragma once

#include <string>
#include <vector>

#include "output/report_page.hpp"

namespace palpate::sim {

struct Requirement {
  std::string what;
  std::string required;
  std::string measured;
  bool holds;
};

class Requirements {
 public:
  void add(const Requirement& requirement) { all_.push_back(requirement); }
  [[nodiscard]] const std::vector<Requirement>& all() const { return all_; }
  [[nodiscard]] std::size_t failed() const;
  /// What is required, what was measured, and a mark.
  [[nodiscard]] Table table() const;

 private:
  std::vector<Requirement> all_;
};

}  // namespace palpate::sim
