// Charts in one style, as scripts for run_gnuplot: curves over numbers, and stacked bars over names. Scripts
// can be joined. Titles and labels are plain text.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "domain.hpp"

namespace palpate::sim {

enum class ChartSize { kFull, kHalf };  // kHalf: two of them fit side by side on a page

/// x and y. A value that is not finite, or not positive on a logarithmic axis, is a gap.
using ChartPoints = std::vector<std::array<double, 2>>;

/// Columns of a CSV file with a header, as gnuplot's expressions: "column('force_x_N')*1e3".
struct CsvColumns {
  std::string file;  // as seen from the folder of the script
  std::string x, y;
  uint32_t every = 1;  // takes one row of so many
};

enum class SeriesStyle { kLine, kPoints, kLineAndPoints };

struct Series {
  std::string title;
  std::variant<ChartPoints, CsvColumns> data;
  SeriesStyle style = SeriesStyle::kLine;
  bool is_main = false;  // black and thicker, the one that the others are seen against
};

struct Axis {
  std::string label;  // with the unit: "force, mN"
  bool is_logarithmic = false;
  std::optional<Range> range = std::nullopt;  // of the data otherwise
  std::vector<std::string> names = {};        // of 0, 1 and so on, instead of the numbers
};

struct Chart {
  std::string file;  // .svg
  Axis x, y;
  std::vector<Series> series;
  ChartSize size = ChartSize::kFull;
};

struct BarPart {
  std::string title;
  std::vector<double> values;  // a bar
};

struct StackedBars {
  std::string file;  // .svg
  std::string x_label, y_label;
  std::vector<std::string> bars;  // their names, without double quotes
  std::vector<BarPart> parts;     // from below
  ChartSize size = ChartSize::kFull;
};

std::string chart_script(const Chart& chart);
std::string chart_script(const StackedBars& chart);

}  // namespace palpate::sim
