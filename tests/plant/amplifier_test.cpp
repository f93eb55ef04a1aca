#include "plant/amplifier.hpp"

#include <gtest/gtest.h>

namespace palpate::plant {
namespace {

AmplifierInput all_on(uint16_t code, bool line) { return {{code, code, code}, {true, true, true}, line}; }

TEST(AmplifierCode, BecomesACurrent) {
  Amplifiers amplifiers{AmplifierParameters{}};
  const auto current = [&amplifiers](uint16_t code) {
    amplifiers.receive(all_on(code, false));
    return amplifiers.target_current(1);
  };
  EXPECT_EQ(current(2048), 0.0);
  EXPECT_DOUBLE_EQ(current(4095), 5.5);
  EXPECT_DOUBLE_EQ(current(1), -5.5);
  EXPECT_DOUBLE_EQ(current(2049), 5.5 / 2047);
  EXPECT_DOUBLE_EQ(current(0), -5.5);  // a code below -I_fs, at the limit
}

TEST(AmplifierCode, HasTwelveBits) {
  Amplifiers amplifiers{AmplifierParameters{}};
  amplifiers.receive(all_on(4096 + 2048, false));
  EXPECT_EQ(amplifiers.target_current(0), 0.0);
}

TEST(AmplifierCode, StopsAtTheCurrentLimit) {
  AmplifierParameters parameters;
  parameters.current_limit = 1.24;
  Amplifiers amplifiers{parameters};
  amplifiers.receive(all_on(4095, false));
  EXPECT_EQ(amplifiers.target_current(2), 1.24);
  amplifiers.receive(all_on(1, false));
  EXPECT_EQ(amplifiers.target_current(2), -1.24);
}

TEST(AmplifierEnable, IsOneAnAxis) {
  Amplifiers amplifiers{AmplifierParameters{}};
  amplifiers.receive({{2048, 2048, 2048}, {true, false, true}, true});
  EXPECT_TRUE(amplifiers.is_on(0));
  EXPECT_FALSE(amplifiers.is_on(1));
  EXPECT_TRUE(amplifiers.is_on(2));
}

TEST(AmplifierWatchdog, StartsDroppedOut) {
  Amplifiers amplifiers{AmplifierParameters{}};
  EXPECT_TRUE(amplifiers.is_dropped_out());
  amplifiers.receive(all_on(2048, false));
  EXPECT_TRUE(amplifiers.is_dropped_out());
  EXPECT_FALSE(amplifiers.is_on(0));
}

TEST(AmplifierWatchdog, StaysUpWhileTheLineToggles) {
  Amplifiers amplifiers{AmplifierParameters{}};
  bool line = false;
  for (int tick = 0; tick < 1000; ++tick) {
    line = !line;
    amplifiers.receive(all_on(2048, line));
    ASSERT_TRUE(amplifiers.is_on(0));
  }
}

TEST(AmplifierWatchdog, DropsOutAtItsTickWhateverTheLevel) {
  for (const uint32_t ticks : {1U, 4U, 20U}) {
    for (const bool stuck_at : {false, true}) {
      AmplifierParameters parameters;
      parameters.watchdog_ticks = ticks;
      Amplifiers amplifiers{parameters};
      amplifiers.receive(all_on(2048, true));
      if (!stuck_at) amplifiers.receive(all_on(2048, false));
      for (uint32_t tick = 1; tick <= ticks; ++tick) {
        ASSERT_FALSE(amplifiers.is_dropped_out());
        ASSERT_TRUE(amplifiers.is_on(1));
        amplifiers.receive(all_on(2048, stuck_at));
      }
      ASSERT_TRUE(amplifiers.is_dropped_out());
      ASSERT_FALSE(amplifiers.is_on(1));
    }
  }
}

TEST(AmplifierWatchdog, ComesBackWithTheNextEdge) {
  Amplifiers amplifiers{AmplifierParameters{}};
  amplifiers.receive(all_on(2048, true));
  for (int tick = 0; tick < 100; ++tick) amplifiers.receive(all_on(2048, true));
  ASSERT_TRUE(amplifiers.is_dropped_out());
  amplifiers.receive(all_on(2048, false));
  EXPECT_TRUE(amplifiers.is_on(0));
}

}  // namespace
}  // namespace palpate::plant
