// The sections of the report, each from its runs.
#pragma once

#include "output/report_page.hpp"
#include "paper/criterion_study.hpp"
#include "paper/requirements.hpp"
#include "paper/sine_runs.hpp"

namespace palpate::sim {

/// Fig. 7: deformation and reaction force of all models.
void add_fig7_sections(const PaperRuns& runs, const Experiment& experiment, ReportPage& page);
/// How smooth the force is while the fronts move, and what is required of it.
void add_smoothness_section(const PaperRuns& runs, const Experiment& experiment, ReportPage& page);
void require_smoothness(const PaperRuns& runs, Requirements& requirements);
/// Which criterion should refine the mesh.
void add_criterion_section(const std::vector<LoadStudy>& studies, const Experiment& experiment,
                           ReportPage& page);
/// The time that re-meshing takes, and both fronts over time.
void add_remesh_section(const PaperRuns& runs, const Experiment& experiment, ReportPage& page);
/// What else is in the folder.
void add_files_section(const PaperRuns& runs, ReportPage& page);

}  // namespace palpate::sim
