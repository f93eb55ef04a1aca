#include "output/run_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <string>

#include "model_parameters.hpp"
#include "output/vtu_series.hpp"
#include "scenario/errors.hpp"

namespace palpate::sim {
namespace {

namespace fs = std::filesystem;

template <class IsWritten>
void require_only(const fs::path& path, IsWritten is_written_by_a_run) {
  for (const auto& entry : fs::directory_iterator(path)) {
    const std::string name = entry.path().filename().string();
    if (is_written_by_a_run(name)) continue;
    throw BadInput(fmt::format("'{}' holds '{}', which no run writes; choose another --out, or empty it",
                               path.string(), name));
  }
}

fs::path without_trailing_slash(const fs::path& path) {
  const fs::path normal = fs::absolute(path).lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  throw EnvironmentError(fmt::format("cannot write the run folder '{}': {}", path.string(), why));
}

}  // namespace

const std::vector<std::string>& RunFolder::run_files() {
  static const std::vector<std::string> names = {
      "summary.json",    "force.csv",        "hash.csv",         "nodes.csv",     "force.svg",
      "body.png",        "device.csv",       "console.csv",      "model.palpate", "body.svg",
      "motor_codes.svg", "displacement.svg", VtuSeries::kFolder, VtuSeries::kList};
  return names;
}

RunFolder::RunFolder(const fs::path& path, std::vector<std::string> files)
    : path_(path), files_(std::move(files)) {
  try {
    const fs::path absolute = without_trailing_slash(path);
    require_replaceable(absolute);
    temporary_ =
        absolute.parent_path() / fmt::format(".{}.partial-{}", absolute.filename().string(), getpid());
    for (fs::path parent = absolute.parent_path(); !fs::exists(parent); parent = parent.parent_path()) {
      created_parents_.insert(created_parents_.begin(), parent);
    }
    for (const fs::path& parent : created_parents_) fs::create_directory(parent);
    fs::create_directory(temporary_);
  } catch (const fs::filesystem_error& error) {
    std::error_code ignored;
    for (auto at = created_parents_.rbegin(); at != created_parents_.rend(); ++at) fs::remove(*at, ignored);
    refuse(path, error.code().message());
  }
}

RunFolder::~RunFolder() {
  if (committed_) return;
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
  // Removes empty folders only: another run may have used them meanwhile.
  for (auto at = created_parents_.rbegin(); at != created_parents_.rend(); ++at) fs::remove(*at, ignored);
}

/// Only what a run wrote may be replaced by a run.
void RunFolder::require_replaceable(const fs::path& path) const {
  if (!fs::exists(fs::symlink_status(path))) return;
  if (!fs::is_directory(path))
    throw BadInput(fmt::format("'{}' is not a folder; choose another --out", path.string()));
  require_only(path, [this](const std::string& name) {
    return std::find(files_.begin(), files_.end(), name) != files_.end();
  });
  const fs::path bodies = path / VtuSeries::kFolder;
  if (fs::is_directory(bodies)) require_only(bodies, VtuSeries::is_file_name);
}

void RunFolder::commit() {
  const fs::path final_path = without_trailing_slash(path_);
  const fs::path old = temporary_.string() + ".old";
  try {
    require_replaceable(final_path);
    const bool replaces = fs::exists(final_path);
    if (replaces) fs::rename(final_path, old);
    fs::rename(temporary_, final_path);
    committed_ = true;
    if (replaces) fs::remove_all(old);
  } catch (const fs::filesystem_error& error) {
    std::error_code ignored;
    if (!committed_ && fs::exists(old, ignored)) fs::rename(old, final_path, ignored);
    refuse(path_, error.code().message());
  }
}

}  // namespace palpate::sim
