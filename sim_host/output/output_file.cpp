#include "output/output_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "scenario/errors.hpp"

namespace palpate::sim {

OutputFile::OutputFile(const std::string& path, const std::string& name)
    : name_(name.empty() ? path : name), file_(std::fopen(path.c_str(), "w")) {
  if (file_ == nullptr) refuse();
}

OutputFile::~OutputFile() {
  if (file_ != nullptr) std::fclose(file_);
}

void OutputFile::write(const char* data, std::size_t size) {
  if (std::fwrite(data, 1, size, file_) != size) refuse();
}

void OutputFile::close() {
  std::FILE* file = file_;
  file_ = nullptr;
  const bool flushed = std::fflush(file) == 0;
  const int why = errno;
  const bool closed = std::fclose(file) == 0;
  if (flushed && closed) return;
  if (!flushed) errno = why;
  refuse();
}

void OutputFile::refuse() const {
  throw EnvironmentError(fmt::format("cannot write '{}': {}", name_, std::strerror(errno)));
}

void write_whole_file(const std::string& path, const std::string& text) {
  std::error_code ignored;
  // A device such as /dev/stdout is written to, not replaced.
  const bool is_replaceable =
      !std::filesystem::exists(path, ignored) || std::filesystem::is_regular_file(path, ignored);
  const std::string written = is_replaceable ? fmt::format("{}.partial-{}", path, getpid()) : path;
  try {
    OutputFile file(written, path);
    file.write(text.data(), text.size());
    file.close();
    if (is_replaceable) std::filesystem::rename(written, path);
  } catch (const std::filesystem::filesystem_error& error) {
    std::filesystem::remove(written, ignored);
    throw EnvironmentError(fmt::format("cannot write '{}': {}", path, error.code().message()));
  } catch (const EnvironmentError&) {
    if (is_replaceable) std::filesystem::remove(written, ignored);
    throw;
  }
}

}  // namespace palpate::sim
