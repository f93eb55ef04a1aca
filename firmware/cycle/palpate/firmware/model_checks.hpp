// What must hold between the fields of a model, each of which is in its range: that the core may rely on it
// after the model came as bytes. Whether a model is stable is the host's matter, who knows its SI values.
#pragma once

#include "palpate/container/chunk_reader.hpp"
#include "palpate/firmware/scenario_image.hpp"

namespace palpate::firmware {

namespace model_checks {

using container::Finding;
using container::ReadStatus;
using container::Tag;

inline constexpr Tag kShapeTag = Tag::of("BLCK");
inline constexpr Tag kRegionsTag = Tag::of("REGN");
inline constexpr Tag kDynamicsTag = Tag::of("DYNM");
inline constexpr Tag kRemeshTag = Tag::of("RMSH");
inline constexpr Tag kContactTag = Tag::of("CNTC");
inline constexpr Tag kSceneTag = Tag::of("SCEN");
/// The lightest region has a twentieth of the heaviest one's density.
inline constexpr uint16_t kLeastDensity = kDensityOne / 20;

/// Its offset is that of the chunk: the caller knows it.
inline Finding refuse(ReadStatus status, Tag tag, const char* field, int64_t least, int64_t most,
                      int64_t found) {
  return Finding{status, 0, tag, field, least, most, found};
}

/// Of all 64 places, so that those outside the block say nothing strange either.
inline Finding check_cubes(const Block& block) {
  uint32_t present = 0;
  for (const uint32_t cube : bounded<kMaxCubes>(kMaxCubes, [] {})) {
    const uint8_t region = block.region[cube];
    if (region == Block::kAbsent) continue;
    if (region >= kRegions) {
      return refuse(ReadStatus::kOutOfRange, kShapeTag, "region of a cube", 0, kRegions - 1, region);
    }
    present += cube < block.cube_count() ? 1u : 0u;
  }
  if (present != 0) return Finding::nothing();
  return refuse(ReadStatus::kContradiction, kShapeTag, "cubes that are there", 1, block.cube_count(), 0);
}

/// Of a mesh that changes: every range holds the level at the start, and ends where the profile does.
inline Finding check_levels(const Model& model, uint8_t deepest) {
  if (model.remesh.stretch.criterion == StretchCriterion::kFixed) return Finding::nothing();
  for (const uint32_t i : bounded<kRegions>(kRegions, [] {})) {
    const LevelRange& levels = model.remesh.stretch.levels[i];
    if (levels.least > model.level) {
      return refuse(ReadStatus::kContradiction, kRegionsTag, "least level", 0, model.level, levels.least);
    }
    if (levels.most < model.level || levels.most > deepest) {
      return refuse(ReadStatus::kContradiction, kRegionsTag, "most level", model.level, deepest, levels.most);
    }
  }
  return Finding::nothing();
}

/// The lightest node that a region can make has a tet's quarter. For a unit force it must move less than 8
/// edges in a substep, the end of Impulse; 1/1024 less, since impulse_of rounds.
inline Finding check_region(const Model& model, uint8_t region) {
  const uint16_t density = model.region_density[region];
  if (density < kLeastDensity) {
    return refuse(ReadStatus::kContradiction, kRegionsTag, "density", kLeastDensity, kDensityOne, density);
  }
  const bool is_fixed = model.remesh.stretch.criterion == StretchCriterion::kFixed;
  const uint8_t finest = is_fixed ? model.level : model.remesh.stretch.levels[region].most;
  const Dynamics& dynamics = model.dynamics;
  constexpr int kBits = 31 + 3;  // of the mantissa, and of 8
  const int64_t most = static_cast<int64_t>(quarter_mass(finest, density))
                       << (kBits - dynamics.impulse_exponent);
  const int64_t mantissa = dynamics.impulse_mantissa.raw();
  if (mantissa <= most - most / 1024) return Finding::nothing();
  return refuse(ReadStatus::kContradiction, kDynamicsTag, "impulse mantissa", 0, most - most / 1024,
                mantissa);
}

/// A front that would join what it has just split never comes to rest. Full corotation has no thresholds.
inline Finding check_hysteresis(const RemeshRules& rules) {
  const auto refuse_low = [](const char* field, int64_t most, int64_t found) {
    return refuse(ReadStatus::kContradiction, kRemeshTag, field, 0, most, found);
  };
  const RotationRules& rotation = rules.rotation;
  if (rotation.criterion != RotationCriterion::kFull && rotation.join_below > rotation.split_above) {
    return refuse_low("rotation join below", rotation.split_above, rotation.join_below);
  }
  const StretchRules& stretch = rules.stretch;
  if (stretch.merge_below > stretch.split_above) {
    return refuse_low("stretch merge below", stretch.split_above.raw(), stretch.merge_below.raw());
  }
  return Finding::nothing();
}

/// A tool that touches has a size, a spring, and a force that can change and come back.
inline Finding check_contact(const ContactRules& rules) {
  if (!rules.is_on()) return Finding::nothing();
  const auto refuse_low = [](const char* field, int64_t least, int64_t most, int64_t found) {
    return refuse(ReadStatus::kContradiction, kContactTag, field, least, most, found);
  };
  if (rules.radius < kLeastRadius) {
    return refuse_low("tool radius", kLeastRadius.raw(), kMostRadius.raw(), rules.radius.raw());
  }
  if (rules.stiffness.raw() < 1) return refuse_low("stiffness", 1, Coupling::max().raw(), 0);
  if (rules.slew.raw() < 1) return refuse_low("slew", 1, kMostContactSlew.raw(), 0);
  if (rules.passivity.ceiling < 1) return refuse_low("passivity ceiling", 1, UINT32_MAX, 0);
  return Finding::nothing();
}

/// Rows of length 1, upright on each other to 4 LSB (2^-28), and no mirror: otherwise the device would make
/// or lose work. Entries are within +-1, so sums of three products fit.
inline Finding check_rotation(const DeviceRotation& r) {
  constexpr int64_t kMost = int64_t{4} << RotationEntry::kFractionBits;
  constexpr int64_t kOne = int64_t{1} << (2 * RotationEntry::kFractionBits);
  const auto entry = [&r](uint32_t row, uint32_t column) { return int64_t{r[3 * row + column].raw()}; };
  const auto refuse_it = [](int64_t least, int64_t most, int64_t found) {
    return refuse(ReadStatus::kContradiction, kSceneTag, "device rotation", least, most, found);
  };
  for (const uint32_t i : bounded<3>(3, [] {})) {
    for (const uint32_t j : bounded<3>(3, [] {})) {
      const int64_t dot = entry(i, 0) * entry(j, 0) + entry(i, 1) * entry(j, 1) + entry(i, 2) * entry(j, 2);
      const int64_t error = dot - (i == j ? kOne : 0);
      if (error < -kMost || error > kMost) return refuse_it(-kMost, kMost, error);
    }
  }
  const auto minor = [&entry](uint32_t a, uint32_t b) {
    return (entry(1, a) * entry(2, b) - entry(1, b) * entry(2, a)) >> RotationEntry::kFractionBits;
  };
  const int64_t determinant =
      entry(0, 0) * minor(1, 2) + entry(0, 1) * minor(2, 0) + entry(0, 2) * minor(0, 1);
  return determinant > 0 ? Finding::nothing() : refuse_it(1, kOne, determinant);
}

}  // namespace model_checks

/// Of a model whose fields are in their ranges, for a profile with this deepest level. The finding's offset
/// is not set. O(cubes).
[[nodiscard]] inline container::Finding check_model(const CycleModel& model, uint8_t deepest) {
  namespace checks = model_checks;
  const Model& body = model.body;
  container::Finding finding = checks::check_cubes(body.block);
  if (finding.is_done()) finding = checks::check_levels(body, deepest);
  for (const uint32_t cube : bounded<kMaxCubes>(body.block.cube_count(), [] {})) {
    const uint8_t region = body.block.region[cube];
    if (finding.is_done() && region != Block::kAbsent) finding = checks::check_region(body, region);
  }
  if (finding.is_done()) finding = checks::check_hysteresis(body.remesh);
  if (finding.is_done()) finding = checks::check_contact(body.contact);
  return finding.is_done() ? checks::check_rotation(model.scene.device_rotation) : finding;
}

}  // namespace palpate::firmware
