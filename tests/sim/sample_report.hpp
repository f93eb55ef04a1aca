// A report with all that a page can hold, to look at and to test.
#pragma once

#include <filesystem>

#include "output/report_page.hpp"

namespace palpate::test {

/// Draws error.svg, stages.svg and force.svg into the folder.
void draw_sample_charts(const std::filesystem::path& folder);
void fill_sample_report(sim::ReportPage& page);

}  // namespace palpate::test
