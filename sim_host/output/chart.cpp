#include "output/chart.hpp"

#include <fmt/format.h>

namespace palpate::sim {
namespace {

// Colours that stay apart for colour-blind readers (Okabe and Ito), and shapes that stay apart in print.
constexpr std::array<const char*, 6> kColours = {"#0072b2", "#d55e00", "#009e73",
                                                 "#cc79a7", "#e69f00", "#56b4e9"};
constexpr std::array<int, 6> kShapes = {7, 5, 9, 13, 11, 15};

/// A string of gnuplot's: in single quotes nothing but the quote is special.
std::string gnuplot_string(const std::string& text) {
  std::string result = "'";
  for (const char character : text) result += character == '\'' ? "''" : std::string(1, character);
  return result + "'";
}

/// Everything but the data. The legend stands beside a wide chart and above a narrow one.
std::string common_script(const std::string& file, const std::string& x_label, const std::string& y_label,
                          ChartSize size) {
  const bool is_full = size == ChartSize::kFull;
  return fmt::format(
      "reset\nset terminal svg size {} font 'Helvetica,15' background '#ffffff'\nset output {}\n"
      "set datafile separator ','\nset grid lc rgb '#d8d8d8' lw 1\nset key {} samplen 1.5\n"
      "set border 3 lc rgb '#606060'\nset tics nomirror\nset lmargin 10\nset bmargin 3.5\n"
      "set xlabel {} noenhanced\nset ylabel {} noenhanced\n",
      is_full ? "900,420" : "520,400", gnuplot_string(file),
      is_full ? "outside right top Left reverse"
              : "outside center top horizontal Left reverse width -3 font ',13'",
      gnuplot_string(x_label), gnuplot_string(y_label));
}

std::string axis_script(const Axis& axis, char name) {
  std::string text;
  if (axis.is_logarithmic) text += fmt::format("set logscale {0}\nset format {0} '%g'\n", name);
  for (std::size_t i = 0; i < axis.names.size(); ++i) {
    text +=
        fmt::format("set {}tics {}({} {})\n", name, i == 0 ? "" : "add ", gnuplot_string(axis.names[i]), i);
  }
  if (axis.range) text += fmt::format("set {}range [{}:{}]\n", name, axis.range->low, axis.range->high);
  return text;
}

std::string inline_data(const ChartPoints& points, std::size_t index) {
  std::string text = fmt::format("$series_{} << EOD\n", index);
  for (const auto& [x, y] : points) text += fmt::format("{},{}\n", x, y);
  return text + "EOD\n";
}

std::string source_of(const Series& series, std::size_t index) {
  const auto* columns = std::get_if<CsvColumns>(&series.data);
  if (columns == nullptr) return fmt::format("$series_{} using 1:2", index);
  return fmt::format("{} using ({}):({}) every {}", gnuplot_string(columns->file), columns->x, columns->y,
                     columns->every);
}

std::string style_of(const Series& series, std::size_t index) {
  const char* colour = series.is_main ? "#000000" : kColours[index % kColours.size()];
  const double width = series.is_main ? 2.0 : 1.5;
  const int shape = kShapes[index % kShapes.size()];
  switch (series.style) {
    case SeriesStyle::kPoints:
      return fmt::format("points lc rgb '{}' pt {} ps 0.7", colour, shape);
    case SeriesStyle::kLineAndPoints:
      return fmt::format("linespoints lc rgb '{}' lw {} pt {} ps 0.6", colour, width, shape);
    default:
      return fmt::format("lines lc rgb '{}' lw {}", colour, width);
  }
}

}  // namespace

std::string chart_script(const Chart& chart) {
  std::string text = common_script(chart.file, chart.x.label, chart.y.label, chart.size);
  if (!chart.y.is_logarithmic) text += "set offsets 0, 0, graph 0.05, graph 0.05\n";
  text += axis_script(chart.x, 'x') + axis_script(chart.y, 'y');
  std::string plot;
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const Series& series = chart.series[i];
    if (const auto* points = std::get_if<ChartPoints>(&series.data)) text += inline_data(*points, i);
    plot += fmt::format("{}{} with {} title {} noenhanced", i == 0 ? "plot " : ", \\\n  ",
                        source_of(series, i), style_of(series, i), gnuplot_string(series.title));
  }
  return text + plot + "\nunset output\n";
}

std::string chart_script(const StackedBars& chart) {
  std::string text = common_script(chart.file, chart.x_label, chart.y_label, chart.size);
  text +=
      "set style data histograms\nset style histogram rowstacked\nset style fill solid 1.0 noborder\n"
      "set boxwidth 0.62\nset grid noxtics\nset xtics scale 0 noenhanced\nset yrange [0:*]\n"
      "set offsets 0, 0, graph 0.05, 0\n$bars << EOD\n";
  for (std::size_t bar = 0; bar < chart.bars.size(); ++bar) {
    text += fmt::format("\"{}\"", chart.bars[bar]);
    for (const BarPart& part : chart.parts) text += fmt::format(",{}", part.values.at(bar));
    text += "\n";
  }
  text += "EOD\n";
  // A legend beside the bars has their order.
  if (chart.size == ChartSize::kFull) text += "set key invert\n";
  for (std::size_t i = 0; i < chart.parts.size(); ++i) {
    text += fmt::format("{}$bars using {}:xticlabels(1) lc rgb '{}' title {} noenhanced",
                        i == 0 ? "plot " : ", \\\n  ", i + 2, kColours[i % kColours.size()],
                        gnuplot_string(chart.parts[i].title));
  }
  return text + "\nunset output\n";
}

}  // namespace palpate::sim
