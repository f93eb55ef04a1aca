// What the firmware is built around: an organ in its scene, and for boards without encoders a script of their
// counts. The host program writes it as a C++ source (`palpate model NAME --firmware-image FILE`).
#pragma once

#include "palpate/firmware/scene.hpp"

namespace palpate::firmware {

struct CycleModel {
  Model body;
  Scene scene;
};

/// Aligned so that a row is copied as two words.
struct alignas(4) ScriptRow {
  static constexpr uint16_t kGraspButton = 1;
  std::array<int16_t, 3> encoder_counts;
  uint16_t buttons;
};

struct ScenarioImage {
  const char* name;
  CycleModel model;
  const ScriptRow* rows;
  uint32_t row_count;
};

extern const ScenarioImage kScenarioImage;

}  // namespace palpate::firmware
