// The link to the simulated device: two files of the emulator's (named pipes, as a rule), or the second
// serial line. The command line of the emulator says which:
//   ... fifo <file to read> <file to write>
//   ... uart
#include "palpate/ports/lockstep_stream.hpp"

#include "palpate/ports/console.hpp"
#include "palpate/ports/system.hpp"
#include "registers.hpp"
#include "semihosting.hpp"

namespace palpate::mps2 {
namespace {

constexpr uint32_t kMostCommandLine = 400;
constexpr uint32_t kMostWords = 8;
std::array<char, kMostCommandLine> g_command_line;

uint32_t g_read_handle = 0;
uint32_t g_write_handle = 0;
bool g_is_uart = false;

[[noreturn]] void fail(const char* why) {
  for (; *why != '\0'; ++why) port::write_console(*why);
  port::exit_program(1);
}

uint32_t length(const char* text) {
  uint32_t count = 0;
  while (text[count] != '\0') ++count;
  return count;
}

bool are_equal(const char* a, const char* b) {
  for (; *a == *b; ++a, ++b) {
    if (*a == '\0') return true;
  }
  return false;
}

/// Cuts the command line at its blanks; the words that are not there are empty.
std::array<const char*, kMostWords> words() {
  semihosting_call(Semihosting::kCommandLine, {address_of(g_command_line.data()), kMostCommandLine - 1, 0});
  std::array<const char*, kMostWords> found;
  for (const char*& word : found) word = "";
  uint32_t count = 0;
  bool is_in_word = false;
  for (char& character : g_command_line) {
    if (character == '\0') break;
    const bool is_blank = character == ' ';
    if (!is_blank && !is_in_word && count < kMostWords) found[count++] = &character;
    if (is_blank) character = '\0';
    is_in_word = !is_blank;
  }
  return found;
}

uint32_t open_file(const char* path, uint32_t mode) {
  const uint32_t handle = semihosting_call(Semihosting::kOpen, {address_of(path), mode, length(path)});
  if (handle == 0xFFFF'FFFF) fail("error,the link's file cannot be opened\n");
  return handle;
}

/// What has come and was not taken yet.
struct Buffer {
  std::array<uint8_t, 64> bytes;
  uint32_t count = 0;
  uint32_t taken = 0;
};
Buffer g_buffer;

void fill_buffer() {
  const uint32_t size = g_buffer.bytes.size();
  const uint32_t missing =
      semihosting_call(Semihosting::kRead, {g_read_handle, address_of(g_buffer.bytes.data()), size});
  if (missing >= size) fail("error,the link has ended\n");
  g_buffer.count = size - missing;
  g_buffer.taken = 0;
}

uint8_t read_uart() {
  while ((LinkUart::State::read() & LinkUart::kReceiveFull) == 0) {
  }
  return static_cast<uint8_t>(LinkUart::Data::read());
}

void write_uart(uint8_t byte) {
  while ((LinkUart::State::read() & LinkUart::kTransmitFull) != 0) {
  }
  LinkUart::Data::write(byte);
}

}  // namespace
}  // namespace palpate::mps2

namespace palpate::port {

void open_lockstep_stream() {
  constexpr uint32_t kReadBinary = 1;
  constexpr uint32_t kWriteBinary = 5;
  const auto words = mps2::words();
  // The first word is the program's name.
  if (mps2::are_equal(words[1], "uart")) {
    mps2::g_is_uart = true;
    mps2::LinkUart::BaudDivider::write(mps2::kPeripheralClockHz / 921'600);
    mps2::LinkUart::Control::write(mps2::LinkUart::kTransmitEnable | mps2::LinkUart::kReceiveEnable);
  } else if (mps2::are_equal(words[1], "fifo")) {
    mps2::g_read_handle = mps2::open_file(words[2], kReadBinary);
    mps2::g_write_handle = mps2::open_file(words[3], kWriteBinary);
  } else {
    mps2::fail("error,no link is named: fifo <file to read> <file to write>, or uart\n");
  }
}

uint8_t read_lockstep_stream() {
  if (mps2::g_is_uart) return mps2::read_uart();
  if (mps2::g_buffer.taken == mps2::g_buffer.count) mps2::fill_buffer();
  return mps2::g_buffer.bytes[mps2::g_buffer.taken++];
}

void write_lockstep_stream(const uint8_t* bytes, uint32_t count) {
  if (mps2::g_is_uart) {
    for (uint32_t i = 0; i < count; ++i) mps2::write_uart(bytes[i]);
    return;
  }
  mps2::semihosting_call(mps2::Semihosting::kWrite, {mps2::g_write_handle, mps2::address_of(bytes), count});
}

}  // namespace palpate::port

/// No timer runs: an interrupt of it is a mistake.
extern "C" void palpate_tick_handler() { palpate::mps2::fail("error,a timer's tick in lockstep\n"); }
