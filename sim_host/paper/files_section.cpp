// What else is in the report's folder.
#include <fmt/format.h>

#include "paper/sections.hpp"

namespace palpate::sim {

void add_files_section(const PaperRuns& runs, ReportPage& page) {
  page.add_section("Files");
  page.add_paragraph(
      "Each run is a folder in runs/, with force.csv (a row a tick), hash.csv, nodes.csv and summary.json, "
      "and any "
      "can be repeated with its command. Those below also have body.pvd, the body over time for ParaView, "
      "and "
      "pictures. The tables of this page are fig7.csv, smoothness.csv, criteria.csv and remesh_time.csv.");
  Table table{"", {"body over time", "command"}, {}};
  for (const Trace* trace : {&runs.bend, &runs.corner.on_chip, &runs.corner.on_chip_moving,
                             &runs.indentation.fine_moving, &runs.indentation.on_chip_moving}) {
    table.rows.push_back(
        {{fmt::format("runs/{}/body.pvd", trace->request.name)}, {command_of(trace->request)}});
  }
  page.add_table(table);
}

}  // namespace palpate::sim
