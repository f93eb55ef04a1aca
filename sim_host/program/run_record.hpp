// What a finished run left to compare: the hashes of its stages every so many ticks, and its summary. Read
// from a run folder (hash.csv, summary.json) or from the console of a target (console.csv).
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

namespace palpate::sim {

struct RunRecord {
  std::string name;                                     // of the folder, as given
  std::string source;                                   // the file with the hashes
  std::vector<std::string> stages;                      // "state", the last one, is over all
  std::map<uint32_t, std::vector<std::string>> hashes;  // by tick
  std::map<std::string, std::string> summary;
  std::string problem;  // why the run is not complete; empty when it is
};

/// Throws BadInput when the folder holds no run, or a line is damaged (with its place).
RunRecord read_run(const std::string& folder);

}  // namespace palpate::sim
