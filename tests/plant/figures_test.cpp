// Doubtful figures are marked, told to whoever asks, and listed in docs/plant.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

#include "arms.hpp"
#include "plant/omni.hpp"
#include "plant/plant.hpp"

namespace palpate::plant {
namespace {

bool names(const std::vector<Figure>& figures, const std::string& name) {
  return std::any_of(figures.begin(), figures.end(), [&](const Figure& one) { return one.name == name; });
}

std::string read_page() {
  std::ifstream file(PALPATE_SOURCE_FOLDER "/docs/plant.md");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

Plant plant_with_hand(const PlantParameters& parameters) {
  return Plant(parameters, Hand(HandParameters{}, Intention::scripted({{0.0, Eigen::Vector3d::Zero()}})));
}

TEST(Figures, NeedAWarningWithoutASource) {
  EXPECT_FALSE(needs_warning({"", 0, "", Mark::kPublished, ""}));
  EXPECT_FALSE(needs_warning({"", 0, "", Mark::kComputed, ""}));
  EXPECT_TRUE(needs_warning({"", 0, "", Mark::kUnverified, ""}));
  EXPECT_TRUE(needs_warning({"", 0, "", Mark::kAssumed, ""}));
}

TEST(Figures, OfThePremiumAreToldWhenUsed) {
  const std::vector<Figure> told = Plant(PlantParameters{}).doubtful_figures();
  EXPECT_TRUE(names(told, "amplifier watchdog"));
  EXPECT_TRUE(names(told, "Coulomb friction"));
  EXPECT_FALSE(names(told, "hand mass"));
  EXPECT_TRUE(names(plant_with_hand(PlantParameters{}).doubtful_figures(), "hand mass"));
}

TEST(Figures, ThatTheCallerReplacedAreTheCallers) {
  PlantParameters parameters;
  parameters.amplifiers.watchdog_ticks = 7;
  parameters.arm.friction.coulomb = 0.02;
  const std::vector<Figure> told = Plant(parameters).doubtful_figures();
  EXPECT_FALSE(names(told, "amplifier watchdog"));
  EXPECT_FALSE(names(told, "Coulomb friction"));
  EXPECT_TRUE(names(told, "viscous friction"));
}

TEST(Figures, OfTheOmniAreToldExceptThePublishedForces) {
  const std::vector<Figure> told = omni::doubtful_figures();
  EXPECT_TRUE(names(told, omni::kLinkLength.name));
  EXPECT_TRUE(names(told, omni::kCountsPerTurn.name));
  EXPECT_TRUE(names(told, omni::kElbowHigh.name));
  EXPECT_FALSE(names(told, omni::kPeakForce.name));
}

TEST(Figures, OfTheOmniAreThoseOfTheFirmware) {
  EXPECT_NEAR(omni::links().upper, omni::kLinkLength.value, 1e-9);
  EXPECT_NEAR(omni::links().fore, omni::kLinkLength.value, 1e-9);
  const Eigen::Vector3d stretched = omni::tool_position({0.0, 0.0, kPi / 2.0});
  EXPECT_NEAR(stretched[1], omni::kOriginUp.value, 1e-9);
  EXPECT_NEAR(stretched[2], 2.0 * omni::kLinkLength.value - omni::kOriginForward.value, 1e-9);
  EXPECT_EQ(omni::kEncoders.counts_per_joint_turn_milli[0], 1000.0 * omni::kCountsPerTurn.value);
  EXPECT_FALSE(phantom::omni::kLengthsVerified);
  EXPECT_FALSE(phantom::omni::kCountsPerRadianVerified);
  EXPECT_FALSE(phantom::omni::kInkwellVerified);
}

TEST(Figures, AreListedInTheManualWithTheirValues) {
  const std::string page = read_page();
  ASSERT_FALSE(page.empty());
  std::vector<Figure> all = plant_with_hand(PlantParameters{}).doubtful_figures();
  const std::vector<Figure> of_omni = omni::doubtful_figures();
  all.insert(all.end(), of_omni.begin(), of_omni.end());
  for (const Figure& figure : all) {
    std::ostringstream row;
    row << "| " << figure.name << " | " << figure.value << " " << figure.unit << " | "
        << (figure.mark == Mark::kAssumed ? "assumed" : "unverified") << " |";
    EXPECT_NE(page.find(row.str()), std::string::npos) << row.str();
  }
}

}  // namespace
}  // namespace palpate::plant
