// Runs a program in QEMU with the counting plugin.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "plugin/counts.hpp"
#include "plugin/plan.hpp"

namespace palpate::wcet {

/// The run itself failed.
class RunFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// `command`: of QEMU, or of a script that hands further arguments on to it. What it prints is thrown away
/// when all is well. Throws RunFailed with it otherwise.
Counts run_counted(const std::vector<std::string>& command, const std::string& plugin, const Plan& plan);

}  // namespace palpate::wcet
