#pragma once

#include <string>

namespace palpate::sim {

/// A serial line to a board, for bytes as they are: 8 bits, no parity, no flow control, at 921600 baud.
class SerialLine {
 public:
  /// Throws BadInput when the path is no serial line, EnvironmentError when it can't be opened.
  explicit SerialLine(const std::string& path);
  SerialLine(const SerialLine&) = delete;
  SerialLine(SerialLine&&) = delete;
  SerialLine& operator=(const SerialLine&) = delete;
  SerialLine& operator=(SerialLine&&) = delete;
  ~SerialLine();

  [[nodiscard]] int file() const { return file_; }

 private:
  int file_;
};

}  // namespace palpate::sim
