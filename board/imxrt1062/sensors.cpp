#include "debounce.hpp"
#include "palpate/ports/buttons.hpp"
#include "palpate/ports/encoders.hpp"
#include "units.hpp"
#include "wide_count.hpp"

namespace palpate::port {
namespace {

std::array<int32_t, 3> g_counts{};
uint32_t g_readings = 0;
device::Debounce g_buttons;

}  // namespace

// Three accesses, in a fraction of a microsecond: at 1 m/s that is less than a tenth of a count between the
// first axis and the last.
std::array<int32_t, 3> read_encoders() {
  g_counts[0] = device::wide_count(g_counts[0], imxrt::Encoder1::CountLow::read());
  g_counts[1] = device::wide_count(g_counts[1], imxrt::Encoder2::CountLow::read());
  g_counts[2] = device::wide_count(g_counts[2], imxrt::Encoder3::CountLow::read());
  ++g_readings;
  return g_counts;
}

// A decoder in the processor always answers.
uint32_t encoder_reading_number() { return g_readings; }

// Contacts pull their pins to ground.
uint32_t read_buttons() {
  const uint32_t down = ~imxrt::InputPort::Input::read();
  const uint32_t reading = ((down & imxrt::kGraspButtonPin) != 0 ? kGraspButton : 0) |
                           ((down & imxrt::kSecondButtonPin) != 0 ? imxrt::kSecondButton : 0);
  return g_buttons.take(reading);
}

}  // namespace palpate::port
