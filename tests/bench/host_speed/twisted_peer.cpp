#include "twisted_peer.hpp"

#include "reference/mesh_from_forest.hpp"
#include "units.hpp"

namespace palpate::bench {
namespace {

PeerSetup setup_of(const TwistedBar& bar, PeerMode mode) {
  const sim::ModelParameters& parameters = bar.parameters();
  const sim::RegionParameters& material = parameters.regions.front();
  PeerSetup setup{bar.bar().mesh(),
                  {},
                  material.youngs_modulus_pa,
                  material.poisson_ratio,
                  material.density_kg_m3,
                  parameters.mass_damping_per_s,
                  parameters.stiffness_damping_s,
                  sim::kTickS,
                  mode};
  for (const uint8_t by : bar.bar().held_nodes()) setup.is_moved.push_back(by != 0);
  return setup;
}

}  // namespace

TwistedPeer::TwistedPeer(const TwistedBar& bar, PeerMode mode)
    : edge_m_(bar.parameters().edge_m),
      mesh_(bar.bar().mesh()),
      held_by_(bar.bar().held_nodes()),
      ticks_(bar.ticks()),
      peer_(make_peer(setup_of(bar, mode))) {
  const Motion motion = bar.bar().motion();
  peer_->set_motion(motion.position, motion.velocity);
}

void TwistedPeer::tick() {
  ++ticks_;
  const reference::RigidMotion end = reference::rigid_motion(end_motion_at(ticks_), edge_m_);
  for (uint32_t node = 0; node < held_by_.size(); ++node) {
    if (held_by_[node] == 2) peer_->lead(node, end.rotation * mesh_.rest[node] + end.translation);
  }
  peer_->step();
}

}  // namespace palpate::bench
