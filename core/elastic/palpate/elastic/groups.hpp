// What elasticity keeps for each group of the rotation front: two rotations, and what was seen of it.
//
// `extracted` is the rotation of the group's mean deformation gradient, warm-started from tick to tick.
// Forces use `used`, which goes to it in kBlendSteps whenever the front changes there, so that no force
// jumps.
#pragma once

#include "palpate/elastic/rotation_extraction.hpp"
#include "palpate/mesh/rotation_front.hpp"

namespace palpate {

/// Steps from the parent's rotation to a new group's own, and back before two groups are joined.
inline constexpr uint8_t kBlendSteps = 32;

/// What part of the way that is left is gone in a step, by the steps left: together they are s(t) = 3 t^2 - 2
/// t^3 of the whole way, so that the rotation neither starts nor stops with a jerk, which would be felt as a
/// kick.
inline constexpr std::array<RotationEntry, kBlendSteps + 1> kBlendParts = [] {
  constexpr int64_t kWhole = int64_t{kBlendSteps} * kBlendSteps * kBlendSteps;
  const auto gone = [](int64_t steps) { return 3 * steps * steps * kBlendSteps - 2 * steps * steps * steps; };
  std::array<RotationEntry, kBlendSteps + 1> parts{};
  parts[0] = RotationEntry::ratio(1, 1);
  for (int64_t left = 1; left <= kBlendSteps; ++left) {
    const int64_t before = gone(kBlendSteps - left);
    parts[static_cast<std::size_t>(left)] =
        RotationEntry::ratio(gone(kBlendSteps - left + 1) - before, kWhole - before);
  }
  return parts;
}();

/// How wrong it is to turn all leaves of a group alike, times the group's volume in roots; 0 .. 0.5, LSB
/// 2^-32.
using Misfit = Q<-1, 32>;

template <class Profile>
struct Groups {
  std::array<Quaternion, Profile::kGroups> extracted;
  std::array<Quaternion, Profile::kGroups> used;
  std::array<uint8_t, Profile::kGroups> blend;  // steps until `used` is what it goes to; 0: it is
  std::array<DeformationGradient, Profile::kGroups>
      gradient;                                      // volume mean over the leaves, of the last tick
  std::array<Misfit, Profile::kGroups> misfit;       // see misfit.hpp and misfit_sweep.hpp
  std::array<Misfit, Profile::kGroups> misfit_left;  // its part in the misfit of its parent
};

/// Unrotated and undeformed.
template <class Profile>
void start_groups(const RotationFront<Profile>& front, Groups<Profile>& groups) {
  for (const uint32_t i : bounded<Profile::kGroups>(front.groups.used(), [] {})) {
    const uint16_t group = front.groups.live(i);
    groups.extracted[group] = Quaternion::identity();
    groups.used[group] = Quaternion::identity();
    groups.blend[group] = 0;
    groups.gradient[group] = unstretched();
    groups.misfit[group] = Misfit::from_raw(0);
    groups.misfit_left[group] = Misfit::from_raw(0);
  }
}

/// After `group` was split: both halves start from its rotation and blend to their own.
template <class Profile>
void inherit_rotation(Groups<Profile>& groups, uint16_t group, uint16_t added) {
  groups.extracted[added] = groups.extracted[group];
  groups.used[added] = groups.used[group];
  groups.gradient[added] = groups.gradient[group];
  groups.misfit[added] = groups.misfit[group];
  groups.misfit_left[added] = groups.misfit_left[group];
  groups.blend[group] = kBlendSteps;
  groups.blend[added] = kBlendSteps;
}

/// Makes a group's gradient the mean of it and another one's of equal volume.
template <class Profile>
void take_mean_gradient(Groups<Profile>& groups, uint16_t group, uint16_t other) {
  DeformationGradient& f = groups.gradient[group];
  f = f.binaryExpr(groups.gradient[other], [](Stretch x, Stretch y) {
    return Stretch::from_raw((x.raw() + y.raw() + 1) >> 1);  // entries are below 7, of 32
  });
}

/// After `gone` was joined to `group`, which holds their parent's rotation already.
template <class Profile>
void take_over_rotation(Groups<Profile>& groups, uint16_t group, uint16_t gone) {
  take_mean_gradient(groups, group, gone);
  groups.blend[group] = kBlendSteps;
}

/// 1 where a group is about to be joined, else 0. Without a branch, as what follows.
template <class Profile>
[[nodiscard]] PALPATE_ALWAYS_INLINE uint32_t has_partner(const RotationFront<Profile>& front,
                                                         uint16_t group) {
  return static_cast<uint32_t>(front.partner[group] - kNone) >> 31;
}
/// 1 for the second of two groups about to be joined, else 0.
template <class Profile>
[[nodiscard]] PALPATE_ALWAYS_INLINE uint32_t follows_partner(const RotationFront<Profile>& front,
                                                             uint16_t group) {
  return has_partner(front, group) & static_cast<uint32_t>(is_second_of_pair(front, group));
}

/// One extraction step a group, then one blending step. Of two groups about to be joined the first holds
/// their parent's rotation, and both go to it: its gradient becomes their mean, until forces see it anew. At
/// most two steps' worth of extraction: 130 multiplies a group.
template <class Profile>
void update_rotations(const RotationFront<Profile>& front, Groups<Profile>& groups) {
  // Of a pair one rotation is extracted, and one mean is taken: together as many as there are groups.
  auto work = bounded_total<Profile::kGroups>([] {});
  for (const uint32_t i : bounded<Profile::kGroups>(front.groups.used(), [] {})) {
    const uint16_t group = front.groups.live(i);
    if (follows_partner(front, group) != 0) continue;
    for ([[maybe_unused]] const uint32_t pair : work.take(0, has_partner(front, group))) {
      take_mean_gradient(groups, group, front.partner[group]);
    }
    for ([[maybe_unused]] const uint32_t once : work.take(0, 1)) {
      extract_rotation(groups.gradient[group], groups.extracted[group]);
    }
  }
  for (const uint32_t i : bounded<Profile::kGroups>(front.groups.used(), [] {})) {
    const uint16_t group = front.groups.live(i);
    const uint32_t if_follows = 0u - follows_partner(front, group);
    const uint32_t leader = group ^ ((uint32_t{front.partner[group]} ^ group) & if_follows);
    const uint32_t left = groups.blend[group];
    groups.blend[group] = static_cast<uint8_t>(left - (left > 0 ? 1u : 0u));
    approach(groups.used[group], groups.extracted[leader], kBlendParts[left]);
  }
}

}  // namespace palpate
