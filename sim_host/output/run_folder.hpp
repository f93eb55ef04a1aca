// The folder of a run. It is filled under a temporary name beside its final one and renamed when all is
// written, so a run folder is complete or absent; a run that fails leaves nothing behind, and an older run
// stays as it was.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace palpate::sim {

class RunFolder {
 public:
  /// What a run of a scenario writes.
  static const std::vector<std::string>& run_files();

  /// Creates the temporary folder. Throws BadInput when `path` holds something that is none of `files`, and
  /// thus no older run, EnvironmentError when it cannot be written.
  explicit RunFolder(const std::filesystem::path& path, std::vector<std::string> files = run_files());
  RunFolder(const RunFolder&) = delete;
  RunFolder(RunFolder&&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;
  RunFolder& operator=(RunFolder&&) = delete;
  /// Removes what was not committed.
  ~RunFolder();

  /// Where a file goes until commit.
  [[nodiscard]] std::filesystem::path file(const char* name) const { return temporary_ / name; }
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Gives the folder its name; an older run of that name goes.
  void commit();

 private:
  void require_replaceable(const std::filesystem::path& path) const;

  std::filesystem::path path_;
  std::vector<std::string> files_;
  std::filesystem::path temporary_;
  std::vector<std::filesystem::path> created_parents_;  // outermost first
  bool committed_ = false;
};

}  // namespace palpate::sim
