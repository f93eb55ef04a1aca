#include "plant/intention.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "plant/smooth_step.hpp"

namespace palpate::plant {

Intention::Intention(std::vector<Knot> knots, Join join) : knots_(std::move(knots)), join_(join) {
  const std::size_t least = join == Join::kHermite ? 2 : 1;
  const auto is_late = [](const Knot& a, const Knot& b) { return !(a.time < b.time); };
  if (knots_.size() < least) throw std::invalid_argument("an intention has too few knots");
  if (std::adjacent_find(knots_.begin(), knots_.end(), is_late) != knots_.end()) {
    throw std::invalid_argument("an intention's times do not rise");
  }
}

Intention Intention::scripted(std::vector<Knot> knots) { return {std::move(knots), Join::kLeastJerk}; }

Intention Intention::recorded(std::vector<Knot> samples) { return {std::move(samples), Join::kHermite}; }

Eigen::Vector3d Intention::slope(std::size_t index) const {
  const Knot& before = knots_[index == 0 ? 0 : index - 1];
  const Knot& after = knots_[std::min(index + 1, knots_.size() - 1)];
  return (after.position - before.position) / (after.time - before.time);
}

Intent Intention::at(double time) const {
  const auto is_before = [](double t, const Knot& knot) { return t < knot.time; };
  const auto next = std::upper_bound(knots_.begin(), knots_.end(), time, is_before);
  const Eigen::Vector3d rest = Eigen::Vector3d::Zero();
  if (next == knots_.begin() || next == knots_.end()) {
    const Knot& last = next == knots_.end() ? knots_.back() : knots_.front();
    return {last.position, rest, last.holds, last.buttons};
  }
  const Knot& from = *(next - 1);
  const double duration = next->time - from.time;
  const double part = (time - from.time) / duration;
  const Eigen::Vector3d way = next->position - from.position;
  if (join_ == Join::kLeastJerk) {
    return {from.position + smooth_step(part) * way, smooth_step_rate(part) / duration * way, from.holds,
            from.buttons};
  }
  const auto index = static_cast<std::size_t>(next - knots_.begin());
  const Eigen::Vector3d bend_from = duration * slope(index - 1) - way;
  const Eigen::Vector3d bend_to = duration * slope(index) - way;
  // p = from + part way + part (1 - part) ((1 - part) bend_from - part bend_to)
  const double rest_of = 1.0 - part;
  const Eigen::Vector3d position =
      from.position + part * way + part * rest_of * (rest_of * bend_from - part * bend_to);
  const Eigen::Vector3d velocity =
      (way + rest_of * (rest_of - 2.0 * part) * bend_from + part * (part - 2.0 * rest_of) * bend_to) /
      duration;
  return {position, velocity, from.holds, from.buttons};
}

}  // namespace palpate::plant
