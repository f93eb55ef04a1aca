// The gimbal: every tick takes one channel's result and asks for the next, so that each is new every third
// tick.
#include "palpate/ports/gimbal.hpp"
#include "units.hpp"

namespace palpate::port {
namespace {

std::array<uint16_t, 3> g_codes{2048, 2048, 2048};
uint32_t g_asked = 0;  // whose conversion runs

}  // namespace

std::array<uint32_t, 3> read_gimbal() {
  using Converter = imxrt::GimbalConverter;
  g_codes[g_asked] = static_cast<uint16_t>(Converter::Result::read() & 0xFFF);
  g_asked = g_asked < 2 ? g_asked + 1 : 0;
  Converter::Request::write(Converter::channel_of(g_asked));
  return {g_codes[0], g_codes[1], g_codes[2]};  // as a whole it would be a call of memcpy
}

}  // namespace palpate::port
