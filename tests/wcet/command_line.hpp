// How the programs of this folder end.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>

#include "refusal.hpp"

namespace palpate::wcet {

enum ExitCode { kFine = 0, kFailed = 1, kBadInput = 2, kEnvironment = 3 };

/// Parses and runs. What goes wrong is said on stderr, behind the program's name.
inline int run_program(CLI::App& app, int argc, char** argv, const std::function<ExitCode()>& run) {
  const auto fail = [&app](ExitCode code, const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", app.get_name().c_str(), error.what());
    return code;
  };
  try {
    app.parse(argc, argv);
    return run();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kFine : kBadInput;
  } catch (const Refusal& refusal) {
    return fail(kFailed, refusal);
  } catch (const BadInput& bad) {
    return fail(kBadInput, bad);
  } catch (const std::exception& error) {
    return fail(kEnvironment, error);
  }
}

}  // namespace palpate::wcet
