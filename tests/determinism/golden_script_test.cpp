// The golden scenario's script is made by the compiler; here are some of its rows.
#include <gtest/gtest.h>

#include "golden_body.hpp"

namespace palpate {
namespace {

TEST(GoldenScript, PassesThroughItsPoses) {
  const firmware::ScenarioImage& image = firmware::kScenarioImage;
  ASSERT_EQ(image.row_count, 2400u);
  EXPECT_EQ(image.rows[400].encoder_counts[0], -1613);
  EXPECT_EQ(image.rows[0].buttons, 0);
  EXPECT_EQ(image.rows[100].buttons, firmware::ScriptRow::kGraspButton);
}

}  // namespace
}  // namespace palpate
