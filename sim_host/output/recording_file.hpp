// The file that a recording goes to.
#pragma once

#include <stdexcept>
#include <string>

#include "output/output_file.hpp"
#include "palpate/container/chunk_writer.hpp"

namespace palpate::sim {

class RecordingFile {
 public:
  explicit RecordingFile(const std::string& path) : file_(path) {}

  /// As a sink; a full disk throws.
  bool operator()(const uint8_t* bytes, uint32_t size) {
    file_.write(reinterpret_cast<const char*>(bytes), size);
    return true;
  }
  /// `last`: what the writer's end() said.
  void close(container::WriteStatus last) {
    if (last != container::WriteStatus::kDone) throw std::logic_error("a recording that cannot be written");
    file_.close();
  }

 private:
  OutputFile file_;
};

}  // namespace palpate::sim
