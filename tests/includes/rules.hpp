// The rules of the source tree, each as a function from a file to its findings. A path is relative to the
// repository.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace palpate::test {

struct Source {
  std::string path;
  std::string text;
};

/// One line each: path:line: what is wrong.
using Findings = std::vector<std::string>;

/// Who may include whom: numeric, memory <- mesh <- {elastic, remesh, solve, touch, embed} <- tick <-
/// firmware/cycle; firmware/safety sees numeric and phantom; hal/phantom, firmware/container and
/// firmware/link see numeric; firmware/telemetry sees the cycle and the link; hal/ports its platform only, a
/// board the ports. System headers: platform.hpp only.
Findings check_includes(const Source& source);

/// No float, no heap, no exceptions, no virtual functions, no containers of the library.
Findings check_words(const Source& source);

/// Every loop is `for (... : bounded<...>(...))` or `for (... : total.take(...))`, in core, hal and firmware,
/// but not in firmware/main.
Findings check_loops(const Source& source);

/// What a rule lets pass, and why. `line` is the offending line without its comment and the spaces at its
/// ends.
struct Exception {
  std::string_view path, line, reason;
};
const std::vector<Exception>& exceptions();

}  // namespace palpate::test
