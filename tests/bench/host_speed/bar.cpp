#include "bar.hpp"

#include <stdexcept>

#include "palpate/tick/hash.hpp"
#include "palpate/tick/profiles.hpp"
#include "palpate/tick/tick.hpp"
#include "reference/mesh_from_forest.hpp"

namespace palpate::bench {
namespace {

using Profile = Workstation;

class CoreBar final : public Bar {
 public:
  CoreBar(const Model& model, const Units& units)
      : units_(units), state_(std::make_unique<State<Profile>>()) {
    if (start(*state_, model) != Status::kDone) throw std::runtime_error("the bar does not fit its profile");
  }

  void tick(const RigidMotion& end) override {
    NoProbe probe;
    const TickInput input{zero_vector<Position>(), false, {RigidMotion::identity(), end}, false};
    palpate::tick(*state_, input, output_, probe);
  }

  void evaluate_forces() override {
    tick_stages::rotations<true>(*state_);
    tick_stages::forces<Observe::kYes>(*state_);
  }

  [[nodiscard]] std::unique_ptr<Bar> copy() const override {
    auto made = std::make_unique<CoreBar>(state_->model, units_);
    *made->state_ = *state_;
    made->output_ = output_;
    return made;
  }

  [[nodiscard]] reference::Mesh mesh() const override {
    return reference::mesh_of(state_->forest, units_.edge_m);
  }

  [[nodiscard]] std::vector<uint8_t> held_nodes() const override {
    return reference::held_nodes(state_->forest, state_->model.held);
  }

  [[nodiscard]] Motion motion() const override {
    const auto& forest = state_->forest;
    const double m_per_s = units_.edge_m / units_.substep_s;
    Motion motion;
    for (uint32_t i = 0; i < forest.nodes.used(); ++i) {
      const uint16_t node = forest.nodes.live(i);
      motion.position.push_back(in_si(forest.node.position[node], units_.edge_m));
      motion.force_position.push_back(in_si(state_->solve.force_position[node], units_.edge_m));
      motion.velocity.push_back(in_si(forest.node.velocity[node], m_per_s));
      motion.force.push_back(in_si(forest.node.force[node], units_.newtons));
    }
    return motion;
  }

  [[nodiscard]] uint32_t rotations() const override { return state_->front.groups.used(); }

  [[nodiscard]] bool was_clamped() const override {
    const ClampCounters& clamps = state_->clamps;
    return (clamps.speed | clamps.position | clamps.strain) != 0;
  }

  [[nodiscard]] uint64_t hash() const override { return state_hash(*state_, output_); }

 private:
  template <class Scalar>
  static reference::Vector in_si(const Vector3<Scalar>& v, double unit) {
    const double scale = std::ldexp(unit, -Scalar::kFractionBits);
    return {v[0].raw() * scale, v[1].raw() * scale, v[2].raw() * scale};
  }

  Units units_;
  std::unique_ptr<State<Profile>> state_;
  TickOutput output_{};
};

}  // namespace

std::unique_ptr<Bar> PALPATE_MAKE_BAR(const Model& model, const Units& units) {
  return std::make_unique<CoreBar>(model, units);
}

}  // namespace palpate::bench
