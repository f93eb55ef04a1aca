// The paper's first experiment as a whole: Table 1, the error over the number of rotation tets, and Figure 6.
#pragma once

#include "output/wireframe_picture.hpp"
#include "paper/computation_time.hpp"
#include "paper/error_curves.hpp"

namespace palpate::sim {

struct Table1Study {
  Table1 table;
  int substeps;  // of a tick
  std::vector<ErrorCurve> curves;
  std::vector<TickTime> times;
  std::vector<WireframePicture> bodies;    // Figure 6a
  std::vector<std::string> body_captions;  // beside them
};

/// Runs everything: some three minutes, and less than a minute if options.is_quick. Throws Interrupted on
/// Ctrl-C.
Table1Study study_table1(const Table1Options& options);

}  // namespace palpate::sim
