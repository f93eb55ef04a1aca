// The runs behind Fig. 7 and the figures on smoothness: a node of the bar follows a sine, at a corner of the
// free end (the paper's Evaluation 2), and in the middle of a side with both ends held, an indentation.
#pragma once

#include "paper/experiment.hpp"
#include "paper/model_sine.hpp"

namespace palpate::sim {

/// The same motion with ever more that moves.
struct SineRuns {
  std::string what;      // "corner of the free end"
  Trace full;            // profile workstation, full corotation, uniform mesh
  Trace at_paper_theta;  // theta 1.8 degrees of our own measure
  Trace fine;            // rotation front as fine as the paper's row of 1.8 degrees
  Trace fine_moving;     // and the mesh changes too
  Trace on_chip;         // profile cuboid-paper, as it is by default
  Trace on_chip_moving;  // and the mesh changes too
};

struct PaperRuns {
  SineRuns corner, indentation;
  Trace corner_default;  // profile workstation with the default theta
  ModelTrace linear, st_venant_kirchhoff;
  Trace bend;       // profile cuboid-paper
  Trace fine_bend;  // with the rotation front of `fine`
};

PaperRuns run_sines(const Experiment& experiment);

}  // namespace palpate::sim
