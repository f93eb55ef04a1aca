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
  return finding.is_done() ? checks::check_hysteresis(body.remesh) : finding;
}

}  // namespace palpate::firmware
