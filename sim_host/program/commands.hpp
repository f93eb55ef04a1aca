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
/// `replay`: runs a recording again, from the last snapshot at or before `from_tick`. 1: it is not the same.
int replay_recording(const std::string& path, uint32_t from_tick);
/// `inspect`: prints what a recording holds, and writes it with pictures into the folder `out` if that is
/// given.
int inspect_recording(const std::string& path, const std::string& out, bool as_json);
/// `record`: from a device on a bench, until so many ticks, or Ctrl-C.
struct RecordRequest {
  std::string port;     // serial line
  std::string model;    // container that the board was given
  std::string profile;  // of its firmware
  std::string out;
  uint32_t ticks = 0;  // 0: without end
};
int record_device(const RecordRequest& request);
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
