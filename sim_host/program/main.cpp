// The program: exit codes and one line for whatever goes wrong.
#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "model_parameters.hpp"
#include "output/interrupt.hpp"
#include "program/command_line.hpp"
#include "scenario/errors.hpp"

namespace palpate::sim {
namespace {

enum ExitCode : int { kBadInput = 2, kEnvironment = 3 };

int fail(ExitCode code, const char* what) {
  fmt::print(stderr, "palpate: {}\n", what);
  return code;
}

int run_program(int argc, const char* const* argv) {
  try {
    const int code = run_command_line(argc, argv);
    if (std::fflush(stdout) != 0) {
      throw EnvironmentError(fmt::format("cannot write to standard output: {}", std::strerror(errno)));
    }
    return code;
  } catch (const BadInput& error) {
    return fail(kBadInput, error.what());
  } catch (const Interrupted& error) {
    fail(kEnvironment, error.what());
    end_by_signal();
    return kEnvironment;
  } catch (const std::exception& error) {
    return fail(kEnvironment, error.what());
  }
}

}  // namespace
}  // namespace palpate::sim

int main(int argc, char** argv) {
  palpate::sim::watch_signals();
  return palpate::sim::run_program(argc, argv);
}
