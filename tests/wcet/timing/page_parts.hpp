// Pieces of the page.
#pragma once

#include <string>
#include <vector>

#include "profile_timing.hpp"

namespace palpate::wcet::timing {

std::string escaped(const std::string& text);

struct Cell {
  std::string text;
  bool is_number = true;
};

/// Rows of text, numbers to the right.
class PageTable {
 public:
  explicit PageTable(const std::vector<Cell>& head);
  void add(const std::vector<Cell>& cells);
  /// A row whose first cell is a bar, from 0 to 1, with a label.
  void add_bar(double share, const std::string& colour, const std::vector<Cell>& cells);
  [[nodiscard]] std::string html() const { return html_ + "</table>\n"; }

 private:
  std::string html_;
};

std::string tables_of_path(const ImageFigures& figures);
std::string tables_of_memory(const ImageFigures& figures);
std::string table_of_formula(const Formula& formula, double bound);

}  // namespace palpate::wcet::timing
