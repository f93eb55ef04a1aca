// Boards without a device: encoders and buttons play back the scenario's script, a row a tick.
#include "palpate/firmware/scenario_image.hpp"
#include "palpate/ports/buttons.hpp"
#include "palpate/ports/device_status.hpp"
#include "palpate/ports/encoders.hpp"
#include "palpate/ports/gimbal.hpp"

namespace palpate::port {
namespace {

uint32_t g_next_row = 0;
firmware::ScriptRow g_row{};

}  // namespace

std::array<int32_t, 3> read_encoders() {
  if (g_next_row < firmware::kScenarioImage.row_count) g_row = firmware::kScenarioImage.rows[g_next_row++];
  return {g_row.encoder_counts[0], g_row.encoder_counts[1], g_row.encoder_counts[2]};
}

uint32_t encoder_reading_number() { return g_next_row; }

std::array<uint32_t, 3> read_gimbal() { return {2048, 2048, 2048}; }

uint32_t read_device_status() { return 0; }

bool was_reset_by_watchdog() { return false; }

uint32_t read_buttons() {
  return (g_row.buttons & firmware::ScriptRow::kGraspButton) != 0 ? kGraspButton : 0;
}

}  // namespace palpate::port
