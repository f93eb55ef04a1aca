// A model whose bytes are whole may still say what the core must not take. Each refusal has the field's name.
#include <gtest/gtest.h>

#include <functional>

#include "support/models.hpp"

namespace palpate::test {
namespace {

struct Case {
  const char* chunk;
  const char* field;
  ReadStatus status;
  std::function<void(CycleModel&)> change;
};

constexpr ReadStatus kRange = ReadStatus::kOutOfRange;
constexpr ReadStatus kPair = ReadStatus::kContradiction;

template <class Fixed>
Fixed beyond(Fixed limit, int32_t by) {
  return Fixed::from_raw(limit.raw() + by);
}

const std::vector<Case>& refused() {
  using M = CycleModel;
  static const std::vector<Case> cases = {
      {"BLCK", "cubes", kRange, [](M& m) { m.body.block.cubes[1] = 0; }},
      {"BLCK", "cubes", kRange, [](M& m) { m.body.block.cubes[2] = 5; }},
      {"BLCK", "level", kRange, [](M& m) { m.body.level = kDeepestLevel + 1; }},
      {"BLCK", "region of a cube", kRange, [](M& m) { m.body.block.region[0] = kRegions; }},
      {"BLCK", "region of a cube", kRange, [](M& m) { m.body.block.region[63] = 0xfe; }},
      {"BLCK", "cubes that are there", kPair,
       [](M& m) {
         for (std::size_t i = 0; i < 4; ++i) m.body.block.region[i] = Block::kAbsent;
         m.body.block.region[4] = 0;  // outside the block
       }},
      {"REGN", "shear", kRange, [](M& m) { m.body.materials[7].shear = ShearCoefficient::from_raw(-1); }},
      {"REGN", "shear", kRange,
       [](M& m) { m.body.materials[0].shear = beyond(ShearCoefficient::ratio(1, 12), 1); }},
      {"REGN", "bulk", kRange, [](M& m) { m.body.materials[0].bulk = BulkCoefficient::from_raw(-1); }},
      {"REGN", "bulk", kRange,
       [](M& m) { m.body.materials[0].bulk = beyond(BulkCoefficient::ratio(555, 100), 1); }},
      {"REGN", "density", kRange, [](M& m) { m.body.region_density[2] = kDensityOne + 1; }},
      {"REGN", "density", kPair, [](M& m) { m.body.region_density[1] = 101; }},
      {"REGN", "least level", kRange, [](M& m) { m.body.remesh.stretch.levels[0].least = 15; }},
      {"REGN", "most level", kRange, [](M& m) { m.body.remesh.stretch.levels[0].most = 15; }},
      {"REGN", "least level", kPair, [](M& m) { m.body.remesh.stretch.levels[1].least = 3; }},
      {"REGN", "most level", kPair, [](M& m) { m.body.remesh.stretch.levels[1].most = 1; }},
      {"DYNM", "substeps", kRange, [](M& m) { m.body.dynamics.substeps = 0; }},
      {"DYNM", "substeps", kRange, [](M& m) { m.body.dynamics.substeps = kMaxSubsteps + 1; }},
      {"DYNM", "impulse exponent", kRange, [](M& m) { m.body.dynamics.impulse_exponent = 2; }},
      {"DYNM", "impulse exponent", kRange, [](M& m) { m.body.dynamics.impulse_exponent = 35; }},
      {"DYNM", "mass damping", kRange, [](M& m) { m.body.dynamics.mass_damping = Q<-5, 36>::from_raw(-1); }},
      {"DYNM", "stiffness damping", kRange,
       [](M& m) { m.body.dynamics.stiffness_damping = Q<0, 31>::from_raw(-1); }},
      {"DYNM", "impulse mantissa", kRange,
       [](M& m) { m.body.dynamics.impulse_mantissa = beyond(Q<0, 31>::ratio(1, 2), -1); }},
      {"DYNM", "impulse mantissa", kPair, [](M& m) { m.body.dynamics.impulse_exponent = 34; }},
      {"RMSH", "rotation criterion", kRange,
       [](M& m) { m.body.remesh.rotation.criterion = static_cast<RotationCriterion>(3); }},
      {"RMSH", "rotation start level", kRange, [](M& m) { m.body.remesh.rotation.start_level = 15; }},
      {"RMSH", "stretch criterion", kRange,
       [](M& m) { m.body.remesh.stretch.criterion = static_cast<StretchCriterion>(4); }},
      {"RMSH", "stretch split above", kRange,
       [](M& m) { m.body.remesh.stretch.split_above = Q<4, 27>::from_raw(-1); }},
      {"RMSH", "stretch merge below", kRange,
       [](M& m) { m.body.remesh.stretch.merge_below = Q<4, 27>::from_raw(-1); }},
      {"RMSH", "rotation join below", kPair,
       [](M& m) { m.body.remesh.rotation.join_below = m.body.remesh.rotation.split_above + 1; }},
      {"RMSH", "stretch merge below", kPair,
       [](M& m) { m.body.remesh.stretch.merge_below = beyond(m.body.remesh.stretch.split_above, 1); }},
      {"HOLD", "grasp reach", kRange, [](M& m) { m.body.grasp_reach = Position::from_raw(-1); }},
      {"HOLD", "grasp reach", kRange, [](M& m) { m.body.grasp_reach = beyond(Position::ratio(4, 1), 1); }},
      {"CNTC", "tool radius", kRange, [](M& m) { m.body.contact.radius = Position::from_raw(-1); }},
      {"CNTC", "tool radius", kRange, [](M& m) { m.body.contact.radius = beyond(kMostRadius, 1); }},
      {"CNTC", "tool radius", kPair, [](M& m) { m.body.contact.radius = beyond(kLeastRadius, -1); }},
      {"CNTC", "stiffness", kRange, [](M& m) { m.body.contact.stiffness = Coupling::from_raw(-1); }},
      {"CNTC", "stiffness", kPair, [](M& m) { m.body.contact.stiffness = Coupling::from_raw(0); }},
      {"CNTC", "damping", kRange, [](M& m) { m.body.contact.damping = Coupling::from_raw(-1); }},
      {"CNTC", "friction", kRange, [](M& m) { m.body.contact.friction = Fraction::from_raw(-1); }},
      {"CNTC", "force limit", kRange, [](M& m) { m.body.contact.force_limit = Force::from_raw(-1); }},
      {"CNTC", "force limit", kRange,
       [](M& m) { m.body.contact.force_limit = beyond(kContactForceLimit, 1); }},
      {"CNTC", "slew", kRange, [](M& m) { m.body.contact.slew = Force::from_raw(-1); }},
      {"CNTC", "slew", kRange, [](M& m) { m.body.contact.slew = beyond(kMostContactSlew, 1); }},
      {"CNTC", "slew", kPair, [](M& m) { m.body.contact.slew = Force::from_raw(0); }},
      {"CNTC", "passivity ceiling", kPair, [](M& m) { m.body.contact.passivity.ceiling = 0; }},
      {"CNTC", "passivity damping", kRange,
       [](M& m) { m.body.contact.passivity.most_damping = Coupling::from_raw(-1); }},
      {"SCEN", "edges per metre", kRange,
       [](M& m) { m.scene.edges_per_metre = firmware::EdgesPerMetre::ratio(3, 4); }},
      {"SCEN", "edges per metre", kRange,
       [](M& m) { m.scene.edges_per_metre = firmware::EdgesPerMetre::ratio(63, 1); }},
      {"SCEN", "device origin", kRange,
       [](M& m) { m.scene.device_origin[2] = beyond(Position::ratio(-4, 1), -1); }},
      {"SCEN", "device origin", kRange,
       [](M& m) { m.scene.device_origin[0] = beyond(Position::ratio(4, 1), 1); }},
      {"SCEN", "device rotation", kRange,
       [](M& m) { m.scene.device_rotation[4] = beyond(firmware::kWholeEntry, 1); }},
      {"SCEN", "device rotation", kPair, [](M& m) { m.scene.device_rotation = {}; }},
      {"SCEN", "device rotation", kPair,
       [](M& m) { m.scene.device_rotation[1] = beyond(m.scene.device_rotation[1], 20); }},
      {"SCEN", "device rotation", kPair,
       [](M& m) {  // a mirror
         m.scene.device_rotation = firmware::kNotTurned;
         m.scene.device_rotation[8] = -firmware::kWholeEntry;
       }},
      {"SCEN", "newton mantissa", kRange, [](M& m) { m.scene.newton_mantissa = Q<0, 31>::from_raw(0); }},
      {"SCEN", "newton exponent", kRange, [](M& m) { m.scene.newton_exponent = -17; }},
      {"SCEN", "newton exponent", kRange, [](M& m) { m.scene.newton_exponent = 29; }},
  };
  return cases;
}

TEST(ModelRange, IsRefusedByName) {
  for (const Case& refusal : refused()) {
    SCOPED_TRACE(refusal.field);
    CycleModel model = sample_model();
    refusal.change(model);
    const File file = model_file(model);
    const Finding finding = refusal_of(file);
    EXPECT_EQ(finding.status, refusal.status);
    ASSERT_NE(finding.field, nullptr);
    EXPECT_STREQ(finding.field, refusal.field);
    EXPECT_EQ(finding.tag.at(0), refusal.chunk[0]);
    EXPECT_EQ(finding.tag.at(3), refusal.chunk[3]);
    EXPECT_TRUE(finding.found < finding.least || finding.found > finding.most);
    // The place: within the chunk of this tag.
    for (const Chunk& chunk : read_all(file, Kind::kModel).chunks) {
      if (chunk.tag != finding.tag) continue;
      EXPECT_GE(finding.offset, chunk.offset);
      EXPECT_LT(finding.offset, chunk.payload_offset() + chunk.payload.size);
    }
  }
}

TEST(ModelRange, EndsWhereTheProfileDoes) {
  const File file = model_file(sample_model());  // starts at level 2, goes down to 5
  EXPECT_TRUE(refusal_of(file, 5).is_done());
  const Finding deep = refusal_of(file, 4);
  EXPECT_EQ(deep.status, kPair);
  EXPECT_STREQ(deep.field, "most level");
  EXPECT_EQ(deep.most, 4);
  EXPECT_EQ(deep.found, 5);
  const Finding deeper = refusal_of(file, 1);
  EXPECT_EQ(deeper.status, kRange);
  EXPECT_STREQ(deeper.field, "level");
  EXPECT_EQ(deeper.most, 1);
}

void expect_taken(const std::function<void(CycleModel&)>& change) {
  CycleModel model = sample_model();
  change(model);
  CycleModel read{};
  ASSERT_TRUE(read_model(model_file(model), read).is_done());
  expect_same(read, model);
}

/// The limits themselves, and what is a limit only elsewhere.
TEST(ModelRange, HasItsLimitsInside) {
  using M = CycleModel;
  expect_taken([](M& m) {
    m.body.materials[0] = {ShearCoefficient::ratio(1, 12), BulkCoefficient::from_raw(0)};
  });
  expect_taken([](M& m) { m.body.materials[0].bulk = BulkCoefficient::ratio(555, 100); });
  expect_taken([](M& m) { m.body.region_density[7] = 0; });  // no cube has it
  expect_taken([](M& m) { m.body.region_density[1] = 102; });
  expect_taken([](M& m) { m.body.grasp_reach = Position::ratio(4, 1); });
  expect_taken([](M& m) { m.body.remesh.stretch.merge_below = m.body.remesh.stretch.split_above; });
  expect_taken([](M& m) { m.body.remesh.rotation.join_below = m.body.remesh.rotation.split_above; });
  expect_taken([](M& m) { m.body.contact.radius = kLeastRadius; });
  expect_taken([](M& m) { m.body.contact.radius = kMostRadius; });
  expect_taken([](M& m) { m.body.contact.passivity.most_damping = Coupling::from_raw(0); });
  expect_taken([](M& m) { m.body.contact = ContactRules{}; });  // no contact needs no rules
  expect_taken([](M& m) { m.scene.device_rotation = firmware::kNotTurned; });
  expect_taken([](M& m) { m.scene.edges_per_metre = firmware::kLeastEdgesPerMetre; });
  // Full corotation joins below 1 and splits above 0; its front has no thresholds.
  expect_taken([](M& m) { m.body.remesh.rotation = {RotationCriterion::kFull, 0, 0, 1}; });
  // A mesh that stays as it is has no use for its levels.
  expect_taken([](M& m) {
    m.body.remesh.stretch.criterion = StretchCriterion::kFixed;
    m.body.remesh.stretch.levels[0] = {9, 1};
  });
}

/// The lightest node of any model that is taken has an impulse within its format.
TEST(ModelRange, KeepsImpulsesInTheirFormat) {
  CycleModel model = sample_model();
  uint32_t taken = 0;
  for (int8_t exponent = 3; exponent <= 34; ++exponent) {
    for (const Q<0, 31> mantissa : {Q<0, 31>::ratio(1, 2), Q<0, 31>::ratio(3, 4), Q<0, 31>::max()}) {
      model.body.dynamics.impulse_exponent = exponent;
      model.body.dynamics.impulse_mantissa = mantissa;
      const bool is_taken = refusal_of(model_file(model)).is_done();
      bool fits = true;
      for (const uint8_t region : {uint8_t{0}, uint8_t{1}}) {
        const uint8_t most = model.body.remesh.stretch.levels[region].most;
        const MassUnits lightest = quarter_mass(most, model.body.region_density[region]);
        const double edges = std::ldexp(mantissa.raw(), exponent - 31) / lightest;
        fits = fits && edges < 8.0 * 1023.0 / 1024.0;
        if (!is_taken) continue;
        EXPECT_NEAR(std::ldexp(impulse_of(model.body.dynamics, lightest).raw(), -28), edges, 1e-6);
      }
      EXPECT_EQ(is_taken, fits) << int{exponent};
      taken += is_taken ? 1u : 0u;
    }
  }
  EXPECT_GT(taken, 30u);
}

}  // namespace
}  // namespace palpate::test
