// Boards without a device: encoders and buttons play back the scenario's script, a row a tick.
#include "palpate/firmware/scenario_image.hpp"
#include "palpate/ports/buttons.hpp"
#include "palpate/ports/encoders.hpp"

namespace palpate::port {
namespace {

uint32_t g_next_row = 0;
firmware::ScriptRow g_row{};

}  // namespace

std::array<int32_t, 3> read_encoders() {
  if (g_next_row < firmware::kScenarioImage.row_count) g_row = firmware::kScenarioImage.rows[g_next_row++];
  return {g_row.encoder_counts[0], g_row.encoder_counts[1], g_row.encoder_counts[2]};
}

uint32_t read_buttons() {
  return (g_row.buttons & firmware::ScriptRow::kGraspButton) != 0 ? kGraspButton : 0;
}

}  // namespace palpate::port
