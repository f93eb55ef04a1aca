// A file that is being written. Every write is checked: a full disk is an EnvironmentError, never a short
// file.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>

namespace palpate::sim {

class OutputFile {
 public:
  /// `name`: how messages call it; empty: as it is.
  explicit OutputFile(const std::string& path, const std::string& name = "");
  OutputFile(const OutputFile&) = delete;
  OutputFile(OutputFile&&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  OutputFile& operator=(OutputFile&&) = delete;
  ~OutputFile();

  template <class... Args>
  void print(fmt::format_string<Args...> format, Args&&... args) {
    text_.clear();
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
    write(text_.data(), text_.size());
  }
  void write(const char* data, std::size_t size);
  /// Everything is with the operating system after this, or it throws.
  void close();

 private:
  [[noreturn]] void refuse() const;

  std::string name_;
  std::FILE* file_;
  fmt::memory_buffer text_;
};

/// A whole file at once, text or bytes. A regular file appears complete or not at all.
void write_whole_file(const std::string& path, const std::string& text);

}  // namespace palpate::sim
