// A model that is written and read is the same; a file that is not the one that was written is refused.
#include "palpate/firmware/model_container.hpp"

#include <gtest/gtest.h>

#include "palpate/tick/profiles.hpp"
#include "support/models.hpp"
#include "support/random.hpp"
#include "support/soak.hpp"
#include "units.hpp"

namespace palpate::test {
namespace {

std::vector<Written> chunks_of(const File& file) {
  std::vector<Written> chunks;
  for (const Chunk& chunk : read_all(file, Kind::kModel).chunks) chunks.push_back(as_written(chunk));
  return chunks;
}

void expect_round_trip(const CycleModel& written) {
  CycleModel read{};
  const Finding finding = read_model(model_file(written), read);
  ASSERT_TRUE(finding.is_done()) << read_status_text(finding.status) << " "
                                 << (finding.field == nullptr ? "" : finding.field);
  expect_same(read, written);
}

TEST(ModelContainer, GivesBackTheModel) { expect_round_trip(sample_model()); }

/// What the reader had before does not shine through.
TEST(ModelContainer, OverwritesEverything) {
  sim::ModelParameters parameters;
  CycleModel read{compile_model(parameters), compile_scene({}, parameters)};
  ASSERT_TRUE(read_model(model_file(sample_model()), read).is_done());
  expect_same(read, sample_model());
}

template <class Fixed>
Fixed random_in(Random& random, Fixed least, Fixed most) {
  const auto span = static_cast<uint32_t>(most.raw()) - static_cast<uint32_t>(least.raw());
  const uint32_t offset = span == ~0u ? static_cast<uint32_t>(random.bits()) : random.below(span + 1);
  return Fixed::from_raw(static_cast<int32_t>(static_cast<uint32_t>(least.raw()) + offset));
}
template <class Fixed>
Fixed random_positive(Random& random) {
  return random_in(random, Fixed::from_raw(0), Fixed::max());
}
int16_t random_i16(Random& random) { return static_cast<int16_t>(random.below(65536)); }
LatticePoint random_point(Random& random) {
  return LatticePoint{random_i16(random), random_i16(random), random_i16(random)};
}

ContactRules random_contact(Random& random) {
  ContactRules rules{};
  if (random.below(4) != 0) rules.radius = random_in(random, kLeastRadius, kMostRadius);
  rules.stiffness = random_in(random, Coupling::from_raw(1), Coupling::max());
  rules.damping = random_positive<Coupling>(random);
  rules.friction = random_positive<Fraction>(random);
  rules.force_limit = random_in(random, Force::from_raw(0), kContactForceLimit);
  rules.slew = random_in(random, Force::from_raw(1), kMostContactSlew);
  rules.passivity = {1 + random.below(~0u), random_positive<Coupling>(random)};
  return rules;
}

/// Whatever a model may say, reasonable or not.
CycleModel random_model(Random& random) {
  CycleModel model = sample_model();
  Model& body = model.body;
  for (uint8_t& count : body.block.cubes) count = static_cast<uint8_t>(1 + random.below(4));
  for (uint8_t& region : body.block.region) {
    region = random.below(5) == 0 ? Block::kAbsent : static_cast<uint8_t>(random.below(kRegions));
  }
  body.block.region[0] = 3;
  body.level = static_cast<uint8_t>(3 + random.below(3));
  for (std::size_t i = 0; i < kRegions; ++i) {
    body.materials[i].shear =
        random_in(random, ShearCoefficient::from_raw(0), ShearCoefficient::ratio(1, 12));
    body.materials[i].bulk = random_in(random, BulkCoefficient::from_raw(0), BulkCoefficient::ratio(11, 2));
    body.region_density[i] = static_cast<uint16_t>(102 + random.below(kDensityOne - 101));
    body.remesh.stretch.levels[i] = {static_cast<uint8_t>(random.below(body.level + 1u)),
                                     static_cast<uint8_t>(body.level + random.below(9))};
  }
  body.dynamics = {static_cast<uint8_t>(1 + random.below(kMaxSubsteps)), random_positive<Q<-5, 36>>(random),
                   random_positive<Q<0, 31>>(random),
                   random_in(random, Q<0, 31>::ratio(1, 2), Q<0, 31>::max()),
                   static_cast<int8_t>(3 + random.below(6))};
  RemeshRules& rules = body.remesh;
  rules.rotation = {static_cast<RotationCriterion>(random.below(3)), static_cast<uint8_t>(random.below(15)),
                    static_cast<uint32_t>(random.bits()), 0};
  rules.rotation.join_below = random.below(rules.rotation.split_above);
  rules.stretch.criterion = static_cast<StretchCriterion>(random.below(4));
  rules.stretch.split_above = random_positive<Q<4, 27>>(random);
  rules.stretch.merge_below = random_in(random, Q<4, 27>::from_raw(0), rules.stretch.split_above);
  for (LatticeBox& box : body.held) box = {random_point(random), random_point(random)};
  body.grasp_reach = random_in(random, Position::from_raw(0), Position::ratio(4, 1));
  body.contact = random_contact(random);
  model.scene.edges_per_metre =
      random_in(random, firmware::kLeastEdgesPerMetre, firmware::kMostEdgesPerMetre);
  const Eigen::Matrix3d rotation = random.rotation();
  for (std::size_t i = 0; i < 9; ++i) {
    model.scene.device_rotation[i] = sim::to_fixed<RotationEntry>(rotation.data()[i]);
  }
  for (Position& x : model.scene.device_origin) {
    x = random_in(random, Position::ratio(-4, 1), Position::ratio(4, 1));
  }
  model.scene.newton_mantissa = random_in(random, Q<0, 31>::ratio(1, 2), Q<0, 31>::max());
  model.scene.newton_exponent = static_cast<int8_t>(static_cast<int>(random.below(45)) - 16);
  return model;
}

TEST(ModelContainer, GivesBackAnyModel) {
  Random random(21);
  for (uint32_t round = 0; round < in_soak(100000u, 1000u); ++round) {
    expect_round_trip(random_model(random));
    if (HasFailure()) return;
  }
}

TEST(ModelContainer, RefusesEveryFlippedBit) {
  const File whole = model_file(sample_model());
  for (uint32_t bit = 0; bit < 8 * whole.size(); ++bit) {
    File damaged = whole;
    damaged[bit / 8] = static_cast<uint8_t>(damaged[bit / 8] ^ (1u << (bit % 8)));
    const Finding finding = refusal_of(damaged);
    ASSERT_FALSE(finding.is_done()) << "bit " << bit;
    // At the chunk of the bit or, in the file header, at most at its check.
    ASSERT_LE(finding.offset, bit / 8 < 16 ? 12 : bit / 8);
  }
}

TEST(ModelContainer, RefusesEveryCut) {
  const File whole = model_file(sample_model());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const File cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    ASSERT_EQ(refusal_of(cut).status, ReadStatus::kCut) << size;
  }
}

TEST(ModelContainer, RefusesMissingDoubledAndStrangeChunks) {
  const auto chunks = chunks_of(model_file(sample_model()));
  ASSERT_EQ(chunks.size(), 8u);
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    auto others = chunks;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const Finding missing = refusal_of(file_of(Kind::kModel, others));
    // Only the name may be missing.
    EXPECT_EQ(missing.status, chunks[i].is_required ? ReadStatus::kMissingChunk : ReadStatus::kDone);
    others = chunks;
    others.push_back(chunks[i]);
    EXPECT_EQ(refusal_of(file_of(Kind::kModel, others)).status, ReadStatus::kDuplicateChunk);
    others = chunks;
    ++others[i].version;
    const Finding future = refusal_of(file_of(Kind::kModel, others));
    EXPECT_EQ(future.status, ReadStatus::kFutureChunk);
    EXPECT_EQ(future.tag, chunks[i].tag);
    others = chunks;
    others[i].payload.resize(100);
    EXPECT_EQ(refusal_of(file_of(Kind::kModel, others)).status, ReadStatus::kWrongLength);
  }
  EXPECT_EQ(refusal_of(file_of(Kind::kSnapshot, chunks)).status, ReadStatus::kWrongKind);
}

TEST(ModelContainer, RefusesASceneWithoutARotation) {
  auto chunks = chunks_of(model_file(sample_model()));
  chunks.back().version = 1;
  chunks.back().payload.resize(24);
  const Finding old = refusal_of(file_of(Kind::kModel, chunks));
  EXPECT_EQ(old.status, ReadStatus::kFutureChunk);
  EXPECT_EQ(old.tag, Tag::of("SCEN"));
}

TEST(ModelContainer, SkipsOnlyWhatIsNotRequired) {
  auto chunks = chunks_of(model_file(sample_model()));
  chunks.insert(chunks.begin() + 2, {Tag::of("NEWS"), 4, false, File(10, 1)});
  CycleModel read{};
  ASSERT_TRUE(read_model(file_of(Kind::kModel, chunks), read).is_done());
  expect_same(read, sample_model());
  chunks[2].is_required = true;
  EXPECT_EQ(refusal_of(file_of(Kind::kModel, chunks)).status, ReadStatus::kUnknownChunk);
}

TEST(ModelContainer, HasItsName) {
  const std::string long_name(100, 'x');
  for (const std::string& name : {std::string(), std::string("grasp"), long_name}) {
    const auto chunks = chunks_of(model_file(sample_model(), name));
    EXPECT_EQ(chunks[0].tag, Tag::of("NAME"));
    EXPECT_EQ(std::string(chunks[0].payload.begin(), chunks[0].payload.end()), name.substr(0, 64));
  }
}

TEST(ModelContainer, SaysWhatItCouldNotWrite) {
  const std::size_t size = model_file(sample_model()).size();
  for (std::size_t room = 0; room < size; ++room) {
    MemorySink sink(room);
    ASSERT_EQ(firmware::write_model(sink, sample_model(), bytes_of(std::string("sample"))),
              WriteStatus::kSinkFull);
  }
}

}  // namespace
}  // namespace palpate::test
