// `record` and `hil --port` over a serial line: a pseudo terminal, at whose other end a firmware is played.
#include "hil/serial_line.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <thread>

#include "hil/link_run.hpp"
#include "palpate/link/frame_reader.hpp"
#include "palpate/telemetry/command.hpp"
#include "program/commands.hpp"
#include "recording/mapped_file.hpp"
#include "scenario/errors.hpp"
#include "support/temporary_folder.hpp"
#include "telling_board.hpp"

namespace palpate::sim {
namespace {

/// What stands at the other end of a line runs in a thread of its own until its owner goes.
class PseudoTerminal {
 public:
  PseudoTerminal() : master_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    EXPECT_GE(master_, 0);
    EXPECT_EQ(::grantpt(master_), 0);
    EXPECT_EQ(::unlockpt(master_), 0);
    path_ = ::ptsname(master_);
  }
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal(PseudoTerminal&&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(PseudoTerminal&&) = delete;
  ~PseudoTerminal() {
    is_over_ = true;
    if (thread_.joinable()) thread_.join();
    ::close(master_);
  }

  void play(std::function<void(PseudoTerminal&)> firmware) {
    thread_ = std::thread([this, firmware = std::move(firmware)] { firmware(*this); });
  }
  [[nodiscard]] const std::string& path() const { return path_; }

  // For the thread.
  [[nodiscard]] bool is_over() const { return is_over_; }
  void send(const uint8_t* bytes, std::size_t count) {
    while (count > 0 && !is_over_) {
      const ssize_t sent = ::write(master_, bytes, count);
      if (sent <= 0) {
        wait(POLLOUT);
        continue;
      }
      bytes += sent;
      count -= static_cast<std::size_t>(sent);
    }
  }
  /// Nothing, now and then.
  std::vector<uint8_t> receive() {
    wait(POLLIN);
    std::vector<uint8_t> bytes(4096);
    const ssize_t count = ::read(master_, bytes.data(), bytes.size());
    bytes.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    return bytes;
  }

 private:
  void wait(short events) const {
    pollfd ready{master_, events, 0};
    (void)::poll(&ready, 1, 10);
  }

  int master_;
  std::string path_;
  std::atomic<bool> is_over_{false};
  std::thread thread_;
};

TEST(SerialLine, IsRecordedFromAStartOfTheFirmwareOn) {
  const test::TemporaryFolder folder;
  PseudoTerminal terminal;
  std::ofstream(folder / "model", std::ios::binary) << TellingBoard().model();
  // Whoever comes to a line has missed what was before: the firmware starts again and again.
  terminal.play([](PseudoTerminal& line) {
    TellingBoard board;
    for (int tick = 0; !line.is_over(); ++tick) {
      if (tick % 300 == 0) board.restart();
      (void)board.tick();
      line.send(board.bytes().data(), board.bytes().size());
    }
  });
  const std::string out = (folder / "recording").string();
  EXPECT_EQ(record_device({terminal.path(), (folder / "model").string(), "small", out, 201}), 0);
  const recording::MappedFile file(out);
  EXPECT_EQ(replayed_ticks(file.bytes()), 201u);
}

TEST(SerialLine, CarriesTheLockstep) {
  const test::TemporaryFolder folder;
  Scenario scenario = small_touch();
  scenario.ticks = 300;
  PseudoTerminal terminal;
  scenario.port = terminal.path();
  scenario.record = (folder / "recording").string();
  terminal.play([&scenario](PseudoTerminal& line) {
    const auto state = std::make_unique<firmware::CycleState<Small>>();
    ASSERT_EQ(firmware::start(*state, cycle_model(scenario)), Status::kDone);
    ASSERT_TRUE(firmware::guard_device(*state, safety::kPremium15Parameters));
    firmware::NoProbe probe;
    HostController<Small, firmware::NoProbe> controller(*state, probe);
    link::FrameReader reader;
    link::FrameWriter writer;
    UserWish wish;
    while (!line.is_over()) {
      for (const uint8_t byte : line.receive()) {
        if (!reader.push(byte)) continue;
        link::CommandMessage command{};
        link::SensorsMessage sensors{};
        if (link::decode(reader.frame(), command) == link::DecodeStatus::kDone) {
          wish = {telemetry::requests_of(command), telemetry::change_of(command)};
        } else if (link::decode(reader.frame(), sensors) == link::DecodeStatus::kDone) {
          link::WireFrame wire;
          writer.write(link::ActuatorsMessage::kType, link::encode(controller.answer(sensors, wish)), wire);
          line.send(wire.data(), wire.size());
          wish = {};
        }
      }
    }
  });
  const RunFolder run_folder(folder / "run");
  const LinkRun run = run_over_link(scenario, run_folder, [](uint32_t) {});
  EXPECT_EQ(run.ticks, 300u);
  EXPECT_EQ(run.last_state, "Ramping");
  const recording::MappedFile file(scenario.record);
  EXPECT_EQ(replayed_ticks(file.bytes()), 300u);
}

TEST(SerialLine, IsNoOtherFile) {
  EXPECT_THROW(SerialLine("/dev/null"), BadInput);
  EXPECT_THROW(SerialLine("/no/such/line"), EnvironmentError);
}

}  // namespace
}  // namespace palpate::sim
