// The firmware's own binary, in QEMU.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "hil/link_controller.hpp"

namespace palpate::sim {

enum class LinkKind { kFifo, kUart };

struct QemuRequest {
  std::filesystem::path firmware;  // ELF
  std::string machine;             // QEMU's name
  std::filesystem::path model;     // container
  std::filesystem::path console;   // file for the firmware's console
  LinkKind link;
};

/// Starts the emulator and opens the link; kills it when it is not waited for.
class QemuFirmware {
 public:
  /// Throws EnvironmentError when there is no emulator, or it does not start.
  explicit QemuFirmware(const QemuRequest& request);
  QemuFirmware(const QemuFirmware&) = delete;
  QemuFirmware(QemuFirmware&&) = delete;
  QemuFirmware& operator=(const QemuFirmware&) = delete;
  QemuFirmware& operator=(QemuFirmware&&) = delete;
  ~QemuFirmware();

  [[nodiscard]] const LinkFiles& files() const { return files_; }

  /// Throws EnvironmentError when it has ended.
  void require_alive();
  /// Until the firmware has ended; its status.
  int wait();

 private:
  void close();
  void open_fifos();
  void listen_for_uart();
  void accept_uart();
  void spawn(const QemuRequest& request);

  std::filesystem::path folder_;  // of pipes or socket
  LinkFiles files_{-1, -1};
  int listener_ = -1;
  pid_t process_ = -1;
};

}  // namespace palpate::sim
