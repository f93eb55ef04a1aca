// `palpate paper` writes what it promises, in haste.
#include <fstream>
#include <memory>
#include <pugixml.hpp>

#include "program.hpp"

namespace palpate::test {
namespace {

namespace fs = std::filesystem;
using Strings = std::vector<std::string>;

Strings select(const fs::path& report, const char* path, const char* attribute) {
  pugi::xml_document page;
  EXPECT_TRUE(page.load_file((report / "report.html").c_str(), pugi::parse_default | pugi::parse_doctype));
  Strings all;
  for (const auto& found : page.select_nodes(path)) {
    const pugi::xml_node node = found.node();
    all.emplace_back(*attribute != 0 ? node.attribute(attribute).value() : node.text().get());
  }
  return all;
}

void expect_page(const fs::path& report) {
  EXPECT_EQ(select(report, "//nav//a", ""),
            (Strings{"Table 1: errors of displacement, bar bent by 90 degrees",
                     "Figure 6: the bar at rest, and the time of a tick",
                     "Figure 7: deformation and reaction force", "How smooth the force is",
                     "Re-meshing while it runs", "Which criterion refines the mesh", "Files"}));
  const Strings pictures = select(report, "//img", "src");
  EXPECT_GE(pictures.size(), 10U);
  for (const std::string& picture : pictures) EXPECT_GT(fs::file_size(report / picture), 1000U) << picture;
}

void expect_tables(const fs::path& report) {
  for (const char* name : {"fig7.csv", "smoothness.csv", "criteria.csv", "remesh_time.csv"}) {
    std::ifstream file(report / name);
    std::string header;
    std::string row;
    EXPECT_TRUE(std::getline(file, header) && std::getline(file, row)) << name;
  }
}

void expect_bodies(const fs::path& report) {
  for (const char* run : {"bend", "corner-on-chip", "corner-on-chip-moving", "indentation-fine-moving",
                          "indentation-on-chip-moving"}) {
    const fs::path folder = report / "runs" / run;
    pugi::xml_document series;
    ASSERT_TRUE(series.load_file((folder / "body.pvd").c_str())) << run;
    const auto entries = series.select_nodes("//DataSet");
    EXPECT_GE(entries.size(), 2U) << run;
    for (const auto& entry : entries) {
      EXPECT_TRUE(fs::exists(folder / entry.node().attribute("file").value())) << run;
    }
  }
}

TEST(SlowPaperCommand, QuicklyWritesWhatItPromises) {
  const TemporaryFolder folder;
  const Outcome outcome = run_program(folder, "paper --quick --out report");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("report: report/report.html"), std::string::npos) << outcome.out;
  expect_page(folder / "report");
  expect_tables(folder / "report");
  expect_bodies(folder / "report");
}

}  // namespace
}  // namespace palpate::test
