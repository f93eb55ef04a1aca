#include "recovery.hpp"

#include <fmt/format.h>

namespace palpate::fault {
namespace {

constexpr uint32_t kTicksInFault = 100;
/// 0.2 s home, some for the last half degree, the ramp, and a little.
constexpr uint32_t kMostTicksToActive = 1000;
/// A body that was pulled swings to and fro before the hand finds it.
constexpr uint32_t kMostTicksToForce = 3000;
/// Pulled as far as a yank pulls it, it loses half of its swing in 0.7 s.
constexpr uint32_t kMostTicksToRest = 12000;

}  // namespace

std::string Recovery::advance() {
  loop_.advance();
  return checks_.see(loop_);
}

/// The user acknowledges in each of these ticks.
std::string Recovery::stay_in_fault() {
  for (uint32_t i = 0; i < kTicksInFault; ++i) {
    if (std::string failure = advance(); !failure.empty()) return failure;
    if (loop_.state() != safety::State::kFault) return "it left Fault without a new start";
  }
  return {};
}

std::string Recovery::reach_active() {
  loop_.lead_hand({{0.2, home()}});
  for (ticks_to_active_ = 0; loop_.state() != safety::State::kActive; ++ticks_to_active_) {
    if (ticks_to_active_ == kMostTicksToActive)
      return fmt::format("it stays in {}", state_name(loop_.state()));
    if (std::string failure = advance(); !failure.empty()) return failure;
  }
  return {};
}

/// The hand presses every half second. A body that swings over a tool before that touches lets it feel
/// nothing until it has been outside.
std::string Recovery::feel_force() {
  std::vector<plant::Knot> way;
  for (double start = 0.0; start < kMostTicksToForce * plant::kTickSeconds; start += 0.5) {
    way.push_back({start + 0.15, point_at_surface(-0.02)});
    way.push_back({start + 0.3, point_at_surface(0.008)});
    way.push_back({start + 0.4, point_at_surface(0.008)});
  }
  loop_.lead_hand(way);
  for (uint32_t i = 0; i < kMostTicksToForce; ++i) {
    if (std::string failure = advance(); !failure.empty()) return failure;
    if (loop_.given.motor_codes != firmware::at_rest().motor_codes && i > 150) return {};
  }
  return "no force where the hand presses";
}

/// The hand waits above the free end, where the body does not swing against the tool.
std::string Recovery::come_to_rest(const PoolsInUse& at_rest) {
  const Eigen::Vector3d above = home() + Eigen::Vector3d(0.0, 0.0, 0.07);
  loop_.lead_hand({{0.15, point_at_surface(-0.003)}, {0.3, home()}, {0.45, above}});
  PoolsInUse now{};
  for (uint32_t i = 0; i < kMostTicksToRest; ++i) {
    if (std::string failure = advance(); !failure.empty()) return failure;
    now = pools_in_use(loop_.cycle);
    const bool is_back = now.leaves == at_rest.leaves && now.pairs == at_rest.pairs &&
                         now.nodes == at_rest.nodes && now.groups == at_rest.groups &&
                         now.tethers == at_rest.tethers;
    if (is_back && i > 500) return {};
  }
  return fmt::format(
      "pools do not return: {} leaves of {}, {} pairs of {}, {} nodes of {}, {} groups of {}, {} tethers",
      now.leaves, at_rest.leaves, now.pairs, at_rest.pairs, now.nodes, at_rest.nodes, now.groups,
      at_rest.groups, now.tethers);
}

std::string Recovery::run(bool needs_start) {
  std::string failure;
  if (needs_start) {
    failure = stay_in_fault();
    loop_.start_firmware();
    checks_.note_new_start();
    checks_.allow_clamps();
  }
  if (failure.empty()) failure = reach_active();
  if (failure.empty()) failure = feel_force();
  return failure.empty() ? failure : "recovery: " + failure;
}

}  // namespace palpate::fault
