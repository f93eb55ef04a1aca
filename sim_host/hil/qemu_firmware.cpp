#include "hil/qemu_firmware.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <vector>

#include "scenario/errors.hpp"

namespace palpate::sim {
namespace {

constexpr int kStartPatienceMs = 60'000;
/// Where the linker scripts of the MPS2 boards have the memory MODEL.
constexpr const char* kModelAddress = "0x001F0000";

[[noreturn]] void fail(const std::string& what) {
  throw EnvironmentError(fmt::format("{}: {}", what, std::strerror(errno)));
}

std::filesystem::path make_folder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "palpate-link-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) fail("no folder for the link");
  return pattern;
}

/// A comma ends an option of QEMU's; two are one.
std::string quoted(const std::filesystem::path& path) {
  std::string text;
  for (const char character : path.string()) {
    text += character;
    if (character == ',') text += ',';
  }
  return text;
}

std::vector<std::string> arguments(const QemuRequest& request, const std::filesystem::path& folder) {
  std::vector<std::string> words = {
      "qemu-system-arm",
      "-M",
      request.machine,
      "-kernel",
      request.firmware.string(),
      "-nographic",
      "-monitor",
      "none",
      "-icount",
      "shift=0,align=off,sleep=off",
      "-device",
      fmt::format("loader,file={},addr={},force-raw=on", quoted(request.model), kModelAddress),
      "-serial",
      "stdio"};
  std::string semihosting = "enable=on,target=native,arg=palpate";
  if (request.link == LinkKind::kFifo) {
    semihosting += fmt::format(",arg=fifo,arg={},arg={}", quoted(folder / "to"), quoted(folder / "from"));
  } else {
    semihosting += ",arg=uart";
    words.insert(words.end(),
                 {"-chardev", fmt::format("socket,id=link,path={},server=off", quoted(folder / "uart")),
                  "-serial", "chardev:link"});
  }
  words.insert(words.end(), {"-semihosting-config", semihosting});
  return words;
}

}  // namespace

QemuFirmware::QemuFirmware(const QemuRequest& request) : folder_(make_folder()) {
  std::signal(SIGPIPE, SIG_IGN);  // a link that breaks is a write that fails
  try {
    if (request.link == LinkKind::kFifo) open_fifos();
    if (request.link == LinkKind::kUart) listen_for_uart();
    spawn(request);
    if (request.link == LinkKind::kUart) accept_uart();
  } catch (...) {
    close();
    throw;
  }
}

QemuFirmware::~QemuFirmware() { close(); }

void QemuFirmware::close() {
  if (process_ > 0) {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  if (files_.to_firmware >= 0) ::close(files_.to_firmware);
  if (files_.from_firmware >= 0 && files_.from_firmware != files_.to_firmware) ::close(files_.from_firmware);
  if (listener_ >= 0) ::close(listener_);
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

/// Both for reading and writing, so that neither side waits for the other to open.
void QemuFirmware::open_fifos() {
  const auto open_one = [this](const char* name) {
    const std::string path = (folder_ / name).string();
    if (::mkfifo(path.c_str(), 0600) != 0) fail("no pipe for the link");
    const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
    if (file < 0) fail("no pipe for the link");
    return file;
  };
  files_.to_firmware = open_one("to");
  files_.from_firmware = open_one("from");
}

void QemuFirmware::listen_for_uart() {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string path = (folder_ / "uart").string();
  if (path.size() >= sizeof address.sun_path)
    throw EnvironmentError("the path of the temporary folder is too long");
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  listener_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (listener_ < 0 || ::bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::listen(listener_, 1) != 0) {
    fail("no socket for the link");
  }
}

void QemuFirmware::accept_uart() {
  pollfd ready{listener_, POLLIN, 0};
  if (::poll(&ready, 1, kStartPatienceMs) != 1) throw EnvironmentError("QEMU does not open the serial line");
  const int file = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
  if (file < 0) fail("no connection from QEMU");
  files_ = {file, file};
}

void QemuFirmware::spawn(const QemuRequest& request) {
  const std::vector<std::string> words = arguments(request, folder_);
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, request.console.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0666);
  const int error = ::posix_spawnp(&process_, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error == 0) return;
  process_ = -1;
  throw EnvironmentError(fmt::format("cannot start qemu-system-arm: {}; install it, or take --board host",
                                     std::strerror(error)));
}

void QemuFirmware::require_alive() {
  int status = 0;
  if (::waitpid(process_, &status, WNOHANG) == 0) return;
  process_ = -1;
  throw EnvironmentError(fmt::format("the firmware in QEMU has ended by itself; its console says why"));
}

int QemuFirmware::wait() {
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0) {
    if (errno != EINTR) fail("QEMU is lost");
  }
  process_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace palpate::sim
