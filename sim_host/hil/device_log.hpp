// device.csv of a run folder: what the simulated device did, a row a tick. The same file from the cycle on
// this machine and from a firmware behind a link.
#pragma once

#include <filesystem>

#include "hil/closed_loop.hpp"
#include "output/output_file.hpp"

namespace palpate::sim {

class DeviceLog {
 public:
  explicit DeviceLog(const std::filesystem::path& path);
  void add(const ClosedLoop& loop);
  void close() { file_.close(); }

  [[nodiscard]] double peak_hand_force_n() const { return peak_hand_force_n_; }

 private:
  OutputFile file_;
  double peak_hand_force_n_ = 0.0;
};

}  // namespace palpate::sim
