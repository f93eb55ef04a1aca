#include "output/report_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <set>
#include <sstream>
#include <stdexcept>

#include "output/output_file.hpp"
#include "output/report_style.hpp"

namespace palpate::sim {
namespace {

using pugi::xml_node;

struct MarkStyle {
  const char* css_class = "";
  const char* sign = "";  // colour alone is not for every reader
  const char* meaning = "";
};

MarkStyle style_of(Mark mark) {
  switch (mark) {
    case Mark::kPaper:
      return {"paper", "", "the paper's value"};
    case Mark::kOurs:
      return {"ours", "", "our value"};
    case Mark::kHolds:
      return {"holds", "✓", "required, and holds"};
    case Mark::kFails:
      return {"fails", "✗", "required, and fails"};
    case Mark::kGoalMet:
      return {"goal-met", "●", "a goal, met"};
    case Mark::kGoalMissed:
      return {"goal-missed", "○", "a goal, missed"};
    default:
      return {};
  }
}

void set(xml_node node, const char* name, const std::string& value) {
  node.append_attribute(name).set_value(value.c_str());
}

/// With a text node even when the text is empty: HTML knows no <td/>.
xml_node add(xml_node parent, const char* tag, const std::string& text) {
  xml_node node = parent.append_child(tag);
  node.append_child(pugi::node_pcdata).set_value(text.c_str());
  return node;
}

xml_node add_with_class(xml_node parent, const char* tag, const std::string& css_class) {
  xml_node node = parent.append_child(tag);
  if (!css_class.empty()) set(node, "class", css_class);
  return node;
}

void add_marked(xml_node node, const std::string& text, const MarkStyle& style) {
  node.append_child(pugi::node_pcdata).set_value(text.c_str());
  if (*style.sign != 0) set(add(node, "span", style.sign), "class", "sign");
}

bool is_number(const std::string& text) {
  const bool has_digit = text.find_first_of("0123456789") != std::string::npos;
  return has_digit && text.find_first_not_of("0123456789+-.,/eE% ") == std::string::npos;
}

/// Numbers, and at least one: what is missing may be "" or a dash.
bool is_number_column(const Table& table, std::size_t column) {
  const auto is_missing = [](const std::string& text) { return text.empty() || text == "-" || text == "–"; };
  bool has_number = false;
  for (const auto& row : table.rows) {
    const std::string& text = row[column].text;
    if (!is_number(text) && !is_missing(text)) return false;
    has_number = has_number || is_number(text);
  }
  return has_number;
}

std::string joined(const char* first, const char* second) {
  return fmt::format("{}{}{}", first, *first != 0 && *second != 0 ? " " : "", second);
}

void require_shape(const Table& table) {
  for (const auto& row : table.rows) {
    if (row.size() == table.header.size()) continue;
    throw std::invalid_argument(fmt::format("a row of the table '{}' has {} cells, but its header has {}",
                                            table.caption, row.size(), table.header.size()));
  }
}

void add_legend(xml_node header, const std::set<Mark>& marks) {
  if (marks.empty()) return;
  xml_node legend = add_with_class(header, "p", "legend");
  for (const Mark mark : marks) {
    const MarkStyle style = style_of(mark);
    add_marked(add_with_class(legend, "span", style.css_class), style.meaning, style);
  }
}

}  // namespace

struct ReportPage::Parts {
  pugi::xml_document document;
  xml_node header, contents, main, section;
  int sections = 0;
  std::set<Mark> marks;
};

ReportPage::ReportPage(const std::string& title, const std::string& summary)
    : parts_(std::make_unique<Parts>()) {
  pugi::xml_document& document = parts_->document;
  document.append_child(pugi::node_doctype).set_value("html");
  xml_node html = document.append_child("html");
  set(html, "lang", "en");
  xml_node head = html.append_child("head");
  set(head.append_child("meta"), "charset", "utf-8");
  xml_node viewport = head.append_child("meta");
  set(viewport, "name", "viewport");
  set(viewport, "content", "width=device-width, initial-scale=1");
  add(head, "title", title);
  add(head, "style", kReportStyle);
  xml_node body = html.append_child("body");
  parts_->header = body.append_child("header");
  add(parts_->header, "h1", title);
  if (!summary.empty()) set(add(parts_->header, "p", summary), "class", "summary");
  parts_->main = body.append_child("main");
  parts_->section = parts_->main;
}

ReportPage::~ReportPage() = default;

void ReportPage::add_section(const std::string& title) {
  const std::string id = fmt::format("section-{}", ++parts_->sections);
  if (parts_->sections == 1) parts_->contents = parts_->header.append_child("nav").append_child("ol");
  set(add(parts_->contents.append_child("li"), "a", title), "href", "#" + id);
  parts_->section = parts_->main.append_child("section");
  set(parts_->section, "id", id);
  add(parts_->section, "h2", title);
}

void ReportPage::add_paragraph(const std::string& text) { add(parts_->section, "p", text); }

void ReportPage::add_table(const Table& table) {
  require_shape(table);
  xml_node node = add_with_class(parts_->section, "div", "wide").append_child("table");
  if (!table.caption.empty()) add(node, "caption", table.caption);
  std::vector<const char*> alignment;
  for (std::size_t i = 0; i < table.header.size(); ++i)
    alignment.push_back(is_number_column(table, i) ? "number" : "");
  xml_node head = node.append_child("thead").append_child("tr");
  for (std::size_t i = 0; i < table.header.size(); ++i)
    add_marked(add_with_class(head, "th", alignment[i]), table.header[i], MarkStyle{});
  xml_node body = node.append_child("tbody");
  for (const auto& row : table.rows) {
    xml_node line = body.append_child("tr");
    for (std::size_t i = 0; i < row.size(); ++i) {
      const MarkStyle style = style_of(row[i].mark);
      add_marked(add_with_class(line, "td", joined(alignment[i], style.css_class)), row[i].text, style);
      if (row[i].mark != Mark::kPlain) parts_->marks.insert(row[i].mark);
    }
  }
}

void ReportPage::add_figures(const std::vector<Figure>& figures) {
  xml_node row = add_with_class(parts_->section, "div", "figures");
  for (const Figure& figure : figures) {
    xml_node node = row.append_child("figure");
    xml_node image = node.append_child("img");
    set(image, "src", figure.file);
    set(image, "alt", figure.caption);
    add(node, "figcaption", figure.caption);
  }
}

std::string ReportPage::html() const {
  pugi::xml_document page;
  page.reset(parts_->document);
  add_legend(page.child("html").child("body").child("header"), parts_->marks);
  std::ostringstream text;
  page.save(text, "  ", pugi::format_indent | pugi::format_no_declaration);
  return text.str();
}

void ReportPage::write(const std::filesystem::path& path) const { write_whole_file(path.string(), html()); }

}  // namespace palpate::sim
