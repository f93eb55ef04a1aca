// A spherical tool against the surface, by a proxy (god object) and a virtual coupling.
//
// The proxy is the tool's centre as the surface lets it be: it goes where the tool goes, but is kept a radius
// away from the surface. In a tick it
//   1. moves with the material that it touched
//   2. goes towards the tool by up to half a radius along the surface and half across it; with
//      friction towards a point beside the tool, as far as stiction holds
//   3. is pushed to a radius from the surface point closest to it, kPushes times
// From a legal place it cannot get to the other side in one tick, so which side is out follows from where it
// was. A tool that appears begins to touch when it is a radius away from the organ; before, nothing holds it.
//
// With e = proxy - tool and the contact's normal n the force on the tool is
//   F = k e + b (e - e of the tick before)
// without its pull along n (F.n >= 0), with its part across n at most mu F.n, and at most force_limit long.
// The opposite acts on the face's nodes, by the weights of the contact's point (load.hpp). How fast the
// tool's own force may change is no matter of the body's (reaction.hpp): a force that lags behind would keep
// it swinging.
#pragma once

#include "palpate/touch/contact_rules.hpp"
#include "palpate/touch/inside.hpp"
#include "palpate/touch/load.hpp"

namespace palpate {

/// Pushes a tick: one for a face or a convex edge, more in a concave edge or corner.
inline constexpr uint32_t kPushes = 3;

struct Contact {
  Vector3<Position> proxy;    // in the last tick
  Vector3<Position> stretch;  // e
  Vector3<Position> anchor;   // the loaded point, as the proxy was placed
  Direction normal;           // from the surface to the tool; zero while nothing is touched
  Vector3<Force> force;       // on the tool
  Load load;
  bool is_touching;
  bool is_certain;          // no face could be nearer than the ones that were looked at
  uint32_t faces_examined;  // in the last tick, at most one and a half times Profile::kContactCandidates

  bool is_present;  // whether there was a tool in the last tick

  /// No tool yet, or one that holds on to a node instead.
  void clear() {
    proxy = stretch = anchor = zero_vector<Position>();
    normal = zero_vector<Fraction>();
    force = zero_vector<Force>();
    load.count = 0;
    is_touching = is_present = false;
    is_certain = true;
    faces_examined = 0;
  }
  /// A tool that was not there before: nothing is between it and its proxy.
  void begin(const Vector3<Position>& at) {
    clear();
    proxy = at;
    is_present = true;
  }
};

namespace contact_detail {

inline Vector3<Position> across(const Vector3<Position>& v, const Direction& n) {
  return v - vector_along(n, component_along(v, n));
}

/// The proxy's way to where it is drawn: the tool, or the point beside it at which stiction holds the proxy.
/// With u the proxy's offset across n and h its height above the tool, that is where |k u| <= mu k h. Not
/// longer than the way to the tool.
inline Vector3<Position> way_to_goal(const ContactRules& rules, const Vector3<Position>& proxy,
                                     const Vector3<Position>& tool, const Direction& n) {
  const Vector3<Position> e = proxy - tool;
  const Position height = component_along(e, n);
  if (rules.friction.raw() <= 0 || height.raw() <= 0) return -e;
  const auto most = narrow_saturated<Position>(rules.friction * height);
  return limited_to(across(e, n), most) - e;
}

/// In the maximum norm.
inline Position largest_part(const Vector3<Position>& v) {
  const auto larger = [](Position a, Position b) { return a > b ? a : b; };
  return larger(abs(v[0]), larger(abs(v[1]), abs(v[2])));
}

/// As much of it as one tick allows: half a radius across n, half along it.
inline Vector3<Position> step_towards(const Vector3<Position>& way, const Direction& n, Position radius) {
  const Position most = Position::from_raw(radius.raw() / 2);
  const Position height = component_along(way, n);
  return limited_to(across(way, n), most) + vector_along(n, clamp(height, -most, most));
}

/// F of a stretch, before all limits; a component saturates at 16, a full mantissa below what direction_of
/// takes.
inline Vector3<Force> coupling_force(const ContactRules& rules, const Vector3<Position>& stretch,
                                     const Vector3<Position>& before) {
  constexpr int kBits = Coupling::kFractionBits + Position::kFractionBits;
  constexpr Force kMost = Force::ratio(16, 1);
  const auto component = [&](Eigen::Index axis) {
    const int64_t change = int64_t{stretch[axis].raw()} - before[axis].raw();
    const auto product = Acc<kBits>::from_raw(int64_t{stretch[axis].raw()} * rules.stiffness.raw() +
                                              change * rules.damping.raw());
    return clamp(narrow_saturated<Force>(product), -kMost, kMost);
  };
  return Vector3<Force>(component(0), component(1), component(2));
}

/// Without its pull, and within the friction cone.
inline Vector3<Force> within_cone(const Vector3<Force>& force, const Direction& n, Fraction friction) {
  const Force press = component_along(force, n);
  if (press.raw() <= 0) return zero_vector<Force>();
  Vector3<Force> normal = vector_along(n, press);
  if (friction.raw() <= 0) return normal;
  const auto most = narrow_saturated<Force>(friction * press);
  return normal + limited_to(Vector3<Force>(force - normal), most);
}

}  // namespace contact_detail

template <class Profile>
class ContactStep {
 public:
  ContactStep(const Forest<Profile>& forest, const ContactRules& rules, Candidates<Profile>& candidates,
              Contact& contact)
      : forest_(forest), rules_(rules), candidates_(candidates), contact_(contact) {}

  /// One tick with the tool at `tool`, within the position limit.
  void run(const Vector3<Position>& tool) {
    namespace detail = contact_detail;
    if (!contact_.is_present) {
      if (is_clear(tool)) contact_.begin(tool);
      return;
    }
    const Vector3<Position> carried_along = within_position_limit(contact_.proxy + carried());
    const Vector3<Position> way = detail::way_to_goal(rules_, carried_along, tool, contact_.normal);
    const Vector3<Position> step = detail::step_towards(way, contact_.normal, rules_.radius);
    const Vector3<Position> proxy = place(within_position_limit(carried_along + step));
    const Vector3<Position> stretch = proxy - tool;
    Vector3<Force> force = zero_vector<Force>();
    if (contact_.is_touching) {
      force = detail::within_cone(detail::coupling_force(rules_, stretch, contact_.stretch), contact_.normal,
                                  rules_.friction);
      force = limited_to(force, rules_.force_limit);
    }
    contact_.force = force;
    contact_.proxy = proxy;
    contact_.stretch = contact_.is_touching ? stretch : zero_vector<Position>();
    contact_.anchor = loaded_point(forest_, contact_.load);
  }

 private:
  /// Whether a tool may appear here: one in the organ or within its skin could be on either side.
  bool is_clear(const Vector3<Position>& tool) {
    find_all_candidates(forest_, tool, rules_.radius, candidates_);
    auto looks = bounded_total<Candidates<Profile>::kMost>([] {});
    SurfacePoint nearest;  // nearest_surface fills it
    const bool is_near = nearest_surface(forest_, candidates_, tool, rules_.radius, looks, nearest);
    const bool is_seen = candidates_.range >= rules_.radius;
    return is_seen && !(is_near && nearest.distance < rules_.radius) &&
           !is_inside(forest_, tool, candidates_.sides);
  }
  /// How far the material under the proxy has moved since it was placed there.
  [[nodiscard]] Vector3<Position> carried() const {
    if (!contact_.is_touching) return zero_vector<Position>();
    return loaded_point(forest_, contact_.load) - contact_.anchor;
  }
  /// The proxy, a radius away from the surface.
  Vector3<Position> place(Vector3<Position> proxy) {
    const Position reach = Position::from_raw(2 * rules_.radius.raw());
    find_candidates(forest_, proxy, reach, candidates_);
    contact_.is_touching = false;
    const Vector3<Position> searched = proxy;
    auto looks = bounded_total<kMostExamined>(ExaminedTotal{});
    SurfacePoint nearest;  // nearest_surface fills it
    for ([[maybe_unused]] const uint32_t push : bounded<kPushes>(kPushes, [] {})) {
      // Only what is within a radius of it can push the proxy.
      const Position within = rules_.radius + contact_detail::largest_part(proxy - searched);
      if (!nearest_surface(forest_, candidates_, proxy, within, looks, nearest)) break;
      if (nearest.distance >= rules_.radius || is_flat(nearest)) break;
      proxy = within_position_limit(nearest.point + vector_along(nearest.normal, rules_.radius));
      contact_.normal = nearest.normal;
      contact_.load.put_on(nearest);
      contact_.is_touching = true;
    }
    contact_.faces_examined = kMostExamined - looks.left();
    contact_.is_certain = candidates_.range >= rules_.radius && looks.left() > 0;
    if (!contact_.is_touching) contact_.normal = zero_vector<Fraction>();
    if (!contact_.is_touching && contact_.force == zero_vector<Force>()) contact_.load.count = 0;
    return proxy;
  }
  static constexpr uint32_t kMostExamined = Profile::kContactCandidates * 3 / 2;
  struct ExaminedTotal {};

  /// Without any area where the proxy is on it: it has no side.
  static bool is_flat(const SurfacePoint& nearest) { return nearest.normal == zero_vector<Fraction>(); }

  const Forest<Profile>& forest_;
  const ContactRules& rules_;
  Candidates<Profile>& candidates_;
  Contact& contact_;
};

}  // namespace palpate
