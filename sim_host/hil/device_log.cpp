#include "hil/device_log.hpp"

#include <algorithm>

#include "palpate/safety/state.hpp"

namespace palpate::sim {

DeviceLog::DeviceLog(const std::filesystem::path& path) : file_(path.string()) {
  file_.print(
      "tick,time_ms,tip_x_mm,tip_y_mm,tip_z_mm,hand_force_x_N,hand_force_y_N,hand_force_z_N,"
      "encoder_1_counts,encoder_2_counts,encoder_3_counts,motor_1_code,motor_2_code,motor_3_code,"
      "amplifiers_on,safety_state,fault,conditions,requests,flags\n");
}

void DeviceLog::add(const ClosedLoop& loop) {
  const plant::PlantTruth truth = loop.plant().truth();
  const link::ActuatorsMessage& answer = loop.answer();
  file_.print("{},{}", answer.tick + 1, answer.tick + 1);
  for (const double metres : truth.tip) file_.print(",{:.6f}", metres * 1e3);
  for (const double newtons : truth.hand_force) file_.print(",{:.6f}", newtons);
  for (const int32_t counts : loop.sensors().encoder_counts) file_.print(",{}", counts);
  for (const uint16_t code : answer.motor_codes) file_.print(",{}", code);
  file_.print(",{},{},{},{},{},{}\n", truth.is_driven[0] ? 1 : 0,
              safety::state_name(static_cast<safety::State>(answer.safety_state)), answer.fault,
              answer.conditions, loop.wish().requests.bits(), answer.flags);
  peak_hand_force_n_ = std::max(peak_hand_force_n_, truth.hand_force.norm());
}

}  // namespace palpate::sim
