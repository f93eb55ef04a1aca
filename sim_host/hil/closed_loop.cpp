#include "hil/closed_loop.hpp"

#include "plant/units.hpp"

namespace palpate::sim {
namespace {

plant::PlantInput plant_input(const link::ActuatorsMessage& answer) {
  return {answer.motor_codes, answer.is_amplifier_enabled, answer.watchdog_level};
}

/// Within half a degree a joint's reset is as good as a hand makes it.
bool is_at_reset_pose(const plant::Plant& plant) {
  return plant.truth().arm.q.cwiseAbs().maxCoeff() < plant::radians(0.5);
}

}  // namespace

link::SensorsMessage sensors_message(const plant::PlantOutput& output) {
  return {output.tick,
          {output.encoder_counts[0], output.encoder_counts[1], output.encoder_counts[2]},
          output.gimbal_adc,
          static_cast<uint8_t>(output.buttons),
          false,
          false,
          output.amplifiers_cut};
}

safety::EventSet next_request(safety::State state, bool is_at_reset_pose) {
  using safety::Event;
  using safety::EventSet;
  switch (state) {
    case safety::State::kUncalibrated:
      return EventSet::of(Event::kCalibrationStarted);
    case safety::State::kCalibrating:
      return EventSet::of(Event::kCalibrationDone, is_at_reset_pose);
    case safety::State::kIdle:
      return EventSet::of(Event::kEnable);
    case safety::State::kFault:
      return EventSet::of(Event::kAcknowledge);
    default:
      return {};
  }
}

ClosedLoop::ClosedLoop(plant::Plant& plant, Controller& controller, uint32_t extra_delay)
    : plant_(plant),
      controller_(controller),
      late_(extra_delay, plant::PlantInput{{2048, 2048, 2048}, {false, false, false}, false}) {}

void ClosedLoop::advance() {
  sensors_ = sensors_message(plant_.output());
  wish_ = {next_request(static_cast<safety::State>(answer_.safety_state), is_at_reset_pose(plant_)), {}};
  if (!changes_.empty() && changes_.front().tick == sensors_.tick + 1) {
    wish_.change = changes_.front().change;
    changes_.pop_front();
  }
  answer_ = controller_.answer(sensors_, wish_);
  late_.push_back(plant_input(answer_));
  plant_.step(late_.front());
  late_.pop_front();
}

}  // namespace palpate::sim
