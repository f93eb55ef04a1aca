// For a bench: prints what all inputs say, and sends every byte of the link back. The motors get no current
// and the amplifiers stay off. Both watchdogs are fed, so that their circuits can be watched too.
//   board,<model's place>,<model memory's bytes>,<cycles a second>,<reset by the watchdog>
//   inputs,<tick>,<count> x 3,<gimbal> x 3,<buttons>,<device status>,<late ticks>,<link bytes>
#include "palpate/ports/buttons.hpp"
#include "palpate/ports/cycle_counter.hpp"
#include "palpate/ports/device_status.hpp"
#include "palpate/ports/encoders.hpp"
#include "palpate/ports/gimbal.hpp"
#include "palpate/ports/indicator.hpp"
#include "palpate/ports/link.hpp"
#include "palpate/ports/model_memory.hpp"
#include "palpate/ports/motors.hpp"
#include "palpate/ports/system.hpp"
#include "palpate/ports/tick_timer.hpp"
#include "palpate/ports/watchdog.hpp"
#include "text.hpp"

namespace palpate::firmware {
namespace {

constexpr uint32_t kTickPeriodUs = 1000;
constexpr uint32_t kTicksARow = 100;
constexpr uint32_t kRows = PALPATE_ROWS;  // 0: for ever

struct Inputs {
  std::array<int32_t, 3> counts;
  std::array<uint32_t, 3> gimbal;
  uint32_t buttons;
  uint32_t status;
};

// Of the tick. The background may see parts of two ticks in a row.
Inputs g_inputs{};
volatile uint32_t g_ticks = 0;
uint32_t g_late_ticks = 0;

template <class Integer>
void print_field(Integer value) {
  print(",");
  print_decimal(value);
}

void print_board() {
  const port::ModelMemory model = port::model_memory();
  print("board");
  print_field(static_cast<uint32_t>(reinterpret_cast<uintptr_t>(model.bytes)));
  print_field(model.size);
  print_field(port::cycles_per_second());
  print_field(uint32_t{port::was_reset_by_watchdog()});
  print("\n");
}

void print_inputs(uint32_t link_bytes) {
  const Inputs inputs = g_inputs;
  print("inputs");
  print_field(uint32_t{g_ticks});
  for (const int32_t count : inputs.counts) print_field(count);
  for (const uint32_t code : inputs.gimbal) print_field(code);
  print_field(inputs.buttons);
  print_field(inputs.status);
  print_field(g_late_ticks);
  print_field(link_bytes);
  print("\n");
}

[[noreturn]] void run_inputs() {
  port::initialize_board();
  print_board();
  port::start_watchdog();
  port::start_ticks(kTickPeriodUs);
  uint32_t link_bytes = 0;
  uint32_t rows = 0;
  for (uint32_t next = kTicksARow; kRows == 0 || rows < kRows;) {
    port::wait_for_tick();
    for (uint8_t byte = 0; port::receive_byte(byte); ++link_bytes) static_cast<void>(port::send_byte(byte));
    if (g_ticks < next) continue;
    print_inputs(link_bytes);
    next += kTicksARow;
    ++rows;
  }
  port::hold_ticks();
  print("stack");
  print_field(port::stack_peak_bytes());
  print("\nend\n");
  port::exit_program(0);
}

}  // namespace
}  // namespace palpate::firmware

namespace palpate::port {

void on_tick() {
  firmware::Inputs& inputs = firmware::g_inputs;
  inputs = {read_encoders(), read_gimbal(), read_buttons(), read_device_status()};
  static_cast<void>(encoder_reading_number());
  static_cast<void>(tick_number());
  write_motors({2048, 2048, 2048});
  set_amplifiers(false);
  show({});
  const bool is_late = tick_pending();
  if (is_late) ++firmware::g_late_ticks;
  if (!is_late) feed_watchdogs();
  firmware::g_ticks = firmware::g_ticks + 1;
}

void run_firmware() { firmware::run_inputs(); }

}  // namespace palpate::port
