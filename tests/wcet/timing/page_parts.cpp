#include "page_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "timing_report.hpp"

namespace palpate::wcet::timing {
namespace {

constexpr size_t kMostFunctions = 15;
constexpr size_t kMostPools = 12;

constexpr const char* kTimeColour = "#3b6fb6";
constexpr const char* kMemoryColour = "#4d9a6a";

Cell text_cell(const std::string& text) { return {escaped(text), false}; }
Cell number_cell(double number) { return {grouped(std::llround(number))}; }
Cell percent_cell(double share) { return {fmt::format("{:.1f} %", 100 * share)}; }

std::string table_of_rows(const char* what, const std::vector<PathRow>& rows, size_t most, double total,
                          bool by_own) {
  PageTable table({{"", false}, {what, false}, {"cycles"}, {"share"}, {"count"}, {"line", false}});
  for (size_t i = 0; i < std::min(most, rows.size()); ++i) {
    const PathRow& row = rows[i];
    const double cycles = by_own ? row.own : row.with_callees;
    table.add_bar(cycles / total, kTimeColour,
                  {text_cell(row.name), number_cell(cycles), percent_cell(cycles / total),
                   number_cell(row.calls), text_cell(row.line)});
  }
  return table.html();
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

PageTable::PageTable(const std::vector<Cell>& head) : html_("<table><tr>") {
  for (const Cell& cell : head)
    html_ += fmt::format("<th{}>{}</th>", cell.is_number ? " class=n" : "", cell.text);
  html_ += "</tr>\n";
}

void PageTable::add(const std::vector<Cell>& cells) {
  html_ += "<tr>";
  for (const Cell& cell : cells)
    html_ += fmt::format("<td{}>{}</td>", cell.is_number ? " class=n" : "", cell.text);
  html_ += "</tr>\n";
}

void PageTable::add_bar(double share, const std::string& colour, const std::vector<Cell>& cells) {
  const double percent = 100 * std::clamp(share, 0.0, 1.0);
  std::vector<Cell> all{
      {fmt::format("<div class=bar><div style=\"width:{:.1f}%;background:{}\"></div></div>", percent, colour),
       false}};
  all.insert(all.end(), cells.begin(), cells.end());
  add(all);
}

std::string tables_of_path(const ImageFigures& figures) {
  const auto total = static_cast<double>(figures.cycles);
  return "<h3>Stages</h3>" + table_of_rows("stage", figures.stages, figures.stages.size(), total, false) +
         "<details><summary>Functions, with what they call</summary>" +
         table_of_rows("function", figures.functions, kMostFunctions, total, false) + "</details>" +
         "<details><summary>Hottest blocks of the worst path</summary>" +
         table_of_rows("in", figures.blocks, figures.blocks.size(), total, true) + "</details>";
}

std::string tables_of_memory(const ImageFigures& figures) {
  const auto ram = static_cast<double>(figures.ram_bytes());
  PageTable sections({{"", false}, {"section", false}, {"RAM, bytes"}, {"flash, bytes"}});
  for (const SectionBytes& section : figures.sections)
    sections.add_bar(section.ram / ram, kMemoryColour,
                     {text_cell(section.name), number_cell(section.ram), number_cell(section.flash)});
  PageTable pools({{"", false}, {"pool", false}, {"bytes"}, {"of", false}});
  double rest = 0;
  for (size_t i = 0; i < figures.pools.size(); ++i) {
    const PoolUse& pool = figures.pools[i];
    if (i >= kMostPools) {
      rest += pool.bytes;
      continue;
    }
    pools.add_bar(pool.bytes / ram, kMemoryColour,
                  {text_cell(pool.name), number_cell(pool.bytes), text_cell(pool.type)});
  }
  pools.add_bar(rest / ram, kMemoryColour, {text_cell("all others"), number_cell(rest), text_cell("")});
  PageTable stack({{"deepest chain of the tick", false}, {"own, bytes"}, {"with callees"}});
  for (const PathRow& row : figures.stack_chain)
    stack.add({text_cell(row.name), number_cell(row.own), number_cell(row.with_callees)});
  return fmt::format(
             "<h3>Memory</h3><p>Stack: at most {} bytes: background {}, exception frame {}, tick {}.</p>",
             figures.stack.bytes(), figures.stack.background, figures.stack.frame, figures.stack.interrupt) +
         sections.html() + "<details><summary>Pools, and the stack's deepest chain</summary>" + pools.html() +
         stack.html() + "</details>";
}

std::string table_of_formula(const Formula& formula, double bound) {
  PageTable table({{"", false}, {"quantity", false}, {"cycles each"}, {"count"}, {"cycles"}});
  table.add_bar(formula.constant / bound, kTimeColour,
                {text_cell("constant"), {""}, {""}, number_cell(formula.constant)});
  for (const FormulaTerm& term : formula.terms) {
    table.add_bar(term.cycles() / bound, kTimeColour,
                  {text_cell(term.quantity), number_cell(term.each), number_cell(term.count),
                   number_cell(term.cycles())});
  }
  return table.html();
}

}  // namespace palpate::wcet::timing
