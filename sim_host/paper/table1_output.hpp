// Table 1 and what belongs to it as files, as text, and as sections of a report.
#pragma once

#include <filesystem>

#include "output/report_page.hpp"
#include "paper/table1_study.hpp"

namespace palpate::sim {

/// A row a line; what the paper does not have is empty.
std::string table1_csv(const Table1& table);
std::string curves_csv(const std::vector<ErrorCurve>& curves);

/// For a terminal.
std::string table1_text(const Table1& table);
/// "bent by 90 degrees".
std::string describe_pose(const Table1Options& options);

/// table1.csv, table1_curves.csv, fig6b.csv.
void write_table1_tables(const Table1Study& study, const std::filesystem::path& folder);

/// Writes those, table1_curves.svg, fig6b.svg and the pictures fig6a_* into the folder, and adds the sections
/// that show them.
void add_table1_sections(ReportPage& page, const std::filesystem::path& folder, const Table1Study& study);

}  // namespace palpate::sim
