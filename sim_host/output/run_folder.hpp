// The folder of a run. It is filled under a temporary name beside its final one and renamed when all is
// written, so a run folder is complete or absent; a run that fails leaves nothing behind, and an older run
// stays as it was.
#pragma once

#include <filesystem>
#include <vector>

namespace palpate::sim {

class RunFolder {
 public:
  /// Creates the temporary folder. Throws BadInput when `path` holds something that is not a run,
  /// EnvironmentError when it cannot be written.
  explicit RunFolder(const std::filesystem::path& path);
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
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::vector<std::filesystem::path> created_parents_;  // outermost first
  bool committed_ = false;
};

}  // namespace palpate::sim
