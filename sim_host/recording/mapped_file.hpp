// A file's bytes where the operating system has them: a long recording is not copied into memory.
#pragma once

#include <string>

#include "palpate/container/bytes.hpp"

namespace palpate::recording {

class MappedFile {
 public:
  /// Throws BadInput for a path that is no readable file, or one of 4 GiB or more.
  explicit MappedFile(const std::string& path);
  MappedFile(const MappedFile&) = delete;
  MappedFile(MappedFile&&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  MappedFile& operator=(MappedFile&&) = delete;
  ~MappedFile();

  [[nodiscard]] container::Bytes bytes() const { return bytes_; }

 private:
  container::Bytes bytes_{nullptr, 0};
};

}  // namespace palpate::recording
