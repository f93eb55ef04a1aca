#include "inputs.hpp"

#include "palpate/ports/buttons.hpp"
#include "palpate/ports/device_status.hpp"
#include "palpate/ports/encoders.hpp"
#include "palpate/ports/gimbal.hpp"

namespace palpate {

worst_case::Inputs worst_case::g_inputs{};

namespace port {

std::array<int32_t, 3> read_encoders() { return worst_case::g_inputs.encoder_counts; }
uint32_t encoder_reading_number() { return worst_case::g_inputs.reading_number; }
std::array<uint32_t, 3> read_gimbal() { return {2048, 2048, 2048}; }
uint32_t read_device_status() { return worst_case::g_inputs.device_status; }
bool was_reset_by_watchdog() { return false; }
uint32_t read_buttons() { return worst_case::g_inputs.buttons; }

}  // namespace port
}  // namespace palpate
