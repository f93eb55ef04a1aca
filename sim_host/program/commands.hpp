// What the program does once its command line is read. Each returns the exit code 0 or 1.
#pragma once

#include <string>

#include "paper/table1.hpp"
#include "scenario/scenario.hpp"

namespace palpate::sim {

/// `run` and `hil`: records a scenario into a run folder.
int run_scenario(Scenario scenario, const std::string& command);
/// `model`: prints what a scenario's model is; or writes it where a path is given, as C++ for the firmware,
/// as a container, or both.
int describe_model(Scenario scenario, const std::string& firmware_image_path,
                   const std::string& container_path);
/// `paper`: the paper's experiments, with a report in the folder `out`; cut short if `is_quick`.
int run_paper(const std::string& out, bool is_quick);
/// `compare`.
int compare_runs(const std::string& first, const std::string& second);

struct Table1Request {
  Table1Options options;
  std::string out = "out/table1";
  bool plots = true;
};
/// `table1`: the paper's Table 1, its curve and Figure 6, into a folder.
int make_table1(const Table1Request& request);

}  // namespace palpate::sim
