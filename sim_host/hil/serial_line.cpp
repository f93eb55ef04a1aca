#include "hil/serial_line.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "model_parameters.hpp"
#include "scenario/errors.hpp"

namespace palpate::sim {

SerialLine::SerialLine(const std::string& path) : file_(::open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)) {
  if (file_ < 0) throw EnvironmentError(fmt::format("cannot open '{}': {}", path, std::strerror(errno)));
  termios line{};
  if (::tcgetattr(file_, &line) != 0) {
    ::close(file_);
    throw BadInput(fmt::format("port is '{}', but must be a serial line, such as /dev/ttyACM0", path));
  }
  ::cfmakeraw(&line);
  line.c_cflag |= CLOCAL | CREAD;
  ::cfsetspeed(&line, B921600);
  line.c_cc[VMIN] = 1;
  line.c_cc[VTIME] = 0;
  if (::tcsetattr(file_, TCSANOW, &line) != 0 || ::tcflush(file_, TCIOFLUSH) != 0) {
    const int error = errno;
    ::close(file_);
    throw EnvironmentError(fmt::format("cannot set up '{}': {}", path, std::strerror(error)));
  }
}

SerialLine::~SerialLine() { ::close(file_); }

}  // namespace palpate::sim
