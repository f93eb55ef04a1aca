#include "figure_file.hpp"

#include <fmt/format.h>

#include <regex>

#include "refusal.hpp"
#include "toml_file.hpp"

namespace palpate::wcet::timing {
namespace {

class FigureReader {
 public:
  explicit FigureReader(const std::string& path) : path_(path) {}

  FigureFile read() {
    const toml::table file = read_toml(path_, "has no figures");
    FigureFile figures;
    each(file, "profile", [&](const toml::table& row) { figures.rows.push_back(read_row(row)); });
    each(file, "board", [&](const toml::table& row) { figures.boards.push_back(read_board(row)); });
    if (figures.rows.empty() || figures.boards.empty()) refuse("has no [[profile]] or no [[board]]");
    return figures;
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const { throw BadInput(path_ + " " + why); }

  template <class Use>
  static void each(const toml::table& file, const char* key, Use use) {
    const toml::array* list = file[key].as_array();
    if (list == nullptr) return;
    for (const toml::node& node : *list) use(node.is_table() ? *node.as_table() : toml::table());
  }

  std::string text(const toml::table& row, const char* key) const {
    std::string value = row[key].value_or(std::string());
    if (value.empty()) refuse(std::string("has a row without ") + key);
    return value;
  }

  std::optional<Cycles> number(const toml::table& row, const char* table, const char* key) const {
    const toml::node_view<const toml::node> node = row[table][key];
    if (!node) return std::nullopt;
    const std::optional<int64_t> value = node.value<int64_t>();
    if (!value || *value <= 0) refuse(fmt::format("has no whole number above 0 as {}.{}", table, key));
    return value;
  }

  Cycles committed(const toml::table& row, const char* key) const {
    const std::optional<Cycles> value = number(row, "committed", key);
    if (!value) refuse(fmt::format("has no committed.{} of {}", key, text(row, "profile")));
    return *value;
  }

  FigureRow read_row(const toml::table& row) const {
    return {text(row, "profile"),
            text(row, "core"),
            {number(row, "design", "cycles"), number(row, "design", "goal_cycles"),
             number(row, "design", "ram_bytes"), number(row, "design", "tick_code_bytes"),
             number(row, "design", "stack_bytes")},
            {committed(row, "instructions"), committed(row, "cycles"), committed(row, "ram_bytes"),
             committed(row, "tick_code_bytes"), committed(row, "stack_bytes")}};
  }

  Board read_board(const toml::table& row) const {
    const double clock_mhz = row["clock_mhz"].value_or(0.0);
    if (clock_mhz <= 0) refuse("has a board without clock_mhz");
    return {text(row, "name"), text(row, "core"), clock_mhz, text(row, "profile"), text(row, "devices")};
  }

  std::string path_;
};

}  // namespace

FigureFile read_figures(const std::string& path) { return FigureReader(path).read(); }

std::string with_committed(const std::string& text, const std::vector<FigureRow>& rows) {
  std::string result = text;
  for (const FigureRow& row : rows) {
    const CommittedFigures& now = row.committed;
    const std::regex place("(profile = \"" + row.profile + "\"\\s+core = \"" + row.core +
                           "\"[^\\[]*committed = )\\{[^}]*\\}");
    if (!std::regex_search(result, place))
      throw BadInput("the figures have no committed = {...} of " + row.profile + " on " + row.core);
    result = std::regex_replace(
        result, place,
        fmt::format("$1{{ instructions = {}, cycles = {}, ram_bytes = {}, tick_code_bytes = {}, "
                    "stack_bytes = {} }}",
                    now.instructions, now.cycles, now.ram_bytes, now.tick_code_bytes, now.stack_bytes));
  }
  return result;
}

}  // namespace palpate::wcet::timing
