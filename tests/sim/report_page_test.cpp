// The report: a page that a browser reads as it was meant, and charts that gnuplot draws.
#include "output/report_page.hpp"

#include <pugixml.hpp>

#include "output/chart.hpp"
#include "program.hpp"
#include "sample_report.hpp"

namespace palpate::test {
namespace {

using sim::Mark;
using sim::ReportPage;

/// The page is well-formed, so a reader of XML can check its shape.
class Parsed {
 public:
  explicit Parsed(const std::string& html) {
    EXPECT_TRUE(document_.load_string(
        html.c_str(), pugi::parse_default | pugi::parse_doctype | pugi::parse_ws_pcdata_single));
  }
  [[nodiscard]] pugi::xml_node body() const { return document_.child("html").child("body"); }
  [[nodiscard]] std::vector<std::string> texts(const char* path) const {
    std::vector<std::string> all;
    for (const auto& found : document_.select_nodes(path)) all.emplace_back(found.node().text().get());
    return all;
  }
  [[nodiscard]] std::vector<std::string> attributes(const char* path, const char* name) const {
    std::vector<std::string> all;
    for (const auto& found : document_.select_nodes(path))
      all.emplace_back(found.node().attribute(name).value());
    return all;
  }

 private:
  pugi::xml_document document_;
};

using Strings = std::vector<std::string>;

TEST(ReportPage, EscapesText) {
  ReportPage page("R < R' & more", "a \"summary\"");
  page.add_paragraph("<script>alert(1)</script>");
  page.add_figures({{"a&b.svg", "x < \"y\""}});
  const std::string html = page.html();
  EXPECT_EQ(html.find("<script"), std::string::npos);
  const Parsed parsed(html);
  EXPECT_EQ(parsed.texts("//h1"), Strings{"R < R' & more"});
  EXPECT_EQ(parsed.texts("//p"), (Strings{"a \"summary\"", "<script>alert(1)</script>"}));
  EXPECT_EQ(parsed.attributes("//img", "src"), Strings{"a&b.svg"});
  EXPECT_EQ(parsed.attributes("//img", "alt"), Strings{"x < \"y\""});
}

TEST(ReportPage, ListsItsSections) {
  ReportPage page("title", "");
  page.add_section("one");
  page.add_paragraph("in one");
  page.add_section("two");
  page.add_paragraph("in two");
  const Parsed parsed(page.html());
  EXPECT_EQ(parsed.texts("//nav//a"), (Strings{"one", "two"}));
  EXPECT_EQ(parsed.attributes("//nav//a", "href"), (Strings{"#section-1", "#section-2"}));
  EXPECT_EQ(parsed.texts("//section[@id='section-2']/p"), Strings{"in two"});
}

TEST(ReportPage, TablesHaveTheirShape) {
  ReportPage page("title", "");
  page.add_table({"caption",
                  {"name", "mm", "verdict"},
                  {{{"a"}, {"1.5", Mark::kPaper}, {"", Mark::kHolds}}, {{"b"}, {"–"}, {"2", Mark::kFails}}}});
  const Parsed parsed(page.html());
  EXPECT_EQ(parsed.texts("//caption"), Strings{"caption"});
  EXPECT_EQ(parsed.texts("//thead/tr/th"), (Strings{"name", "mm", "verdict"}));
  EXPECT_EQ(parsed.texts("//tbody/tr[1]/td"), (Strings{"a", "1.5", ""}));
  EXPECT_EQ(parsed.texts("//tbody/tr[2]/td"), (Strings{"b", "–", "2"}));
  EXPECT_EQ(parsed.attributes("//tbody/tr[1]/td", "class"), (Strings{"", "number paper", "number holds"}));
  EXPECT_EQ(parsed.texts("//td/span[@class='sign']"), (Strings{"✓", "✗"}));
  EXPECT_EQ(parsed.texts("//*[@class='legend']/span").size(), 3U);
  EXPECT_THROW(page.add_table({"", {"one"}, {{{"a"}, {"b"}}}}), std::invalid_argument);
}

/// A browser takes <td/> for a start tag; only elements without content may end themselves.
TEST(ReportPage, NoEmptyElementEndsItself) {
  ReportPage page("", "");
  page.add_section("");
  page.add_paragraph("");
  page.add_table({"", {""}, {{{""}}}});
  page.add_figures({{"", ""}});
  const std::string html = page.html();
  for (std::size_t at = html.find("/>"); at != std::string::npos; at = html.find("/>", at + 1)) {
    const std::string element = html.substr(html.rfind('<', at), 5);
    EXPECT_TRUE(element == "<meta" || element == "<img ") << element;
  }
  EXPECT_EQ(html.rfind("<!DOCTYPE html>", 0), 0U);
}

/// Whatever is in a page besides pictures is in the file itself.
TEST(ReportPage, FetchesNothing) {
  ReportPage page("title", "");
  fill_sample_report(page);
  const std::string html = page.html();
  for (const char* word : {"http", "<script", "<link", "@import", "url("}) {
    EXPECT_EQ(html.find(word), std::string::npos) << word;
  }
}

TEST(ReportPage, StyleIsNotEscaped) {
  const std::string html = ReportPage("title", "").html();
  const std::string style = html.substr(html.find("<style>"), html.find("</style>") - html.find("<style>"));
  EXPECT_EQ(style.find('&'), std::string::npos);
}

TEST(Chart, SamplesAreDrawn) {
  const TemporaryFolder folder;
  draw_sample_charts(folder.path());
  EXPECT_EQ(folder.contents(), (Strings{"error.svg", "force.svg", "stages.svg"}));
  const std::string error = read_text(folder / "error.svg");
  EXPECT_NE(error.find("search's best_set"), std::string::npos) << error.substr(0, 200);
}

TEST(Chart, ReadsCsvFiles) {
  const TemporaryFolder folder;
  const std::string script = chart_script(
      sim::Chart{"a'b.svg",
                 {"x"},
                 {"y"},
                 {{"series", sim::CsvColumns{"runs/force.csv", "column('time_ms')/1000", "column('f')"}}}});
  EXPECT_NE(script.find("set output 'a''b.svg'"), std::string::npos);
  EXPECT_NE(script.find("'runs/force.csv' using (column('time_ms')/1000):(column('f')) every 1"),
            std::string::npos);
}

}  // namespace
}  // namespace palpate::test
