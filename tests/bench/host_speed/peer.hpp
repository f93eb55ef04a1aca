// Who the core is measured beside: another library's deformable body, made of the same mesh.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "bar.hpp"

namespace palpate::bench {

enum class PeerMode : uint8_t {
  kImplicit,             // implicit Euler, one Newton step a step, held nodes by projection
  kImplicitMultipliers,  // held nodes by Lagrange multipliers: Bullet's default
  kExplicit              // elastic forces explicit, damping implicit
};

struct PeerSetup {
  reference::Mesh mesh;
  std::vector<bool> is_moved;  // by us, not by forces: held or led
  double youngs_modulus_pa;
  double poisson_ratio;
  double density_kg_m3;
  double mass_damping_per_s;
  double stiffness_damping_s;
  double step_s;
  PeerMode mode;
};

class Peer {
 public:
  Peer() = default;
  Peer(const Peer&) = delete;
  Peer(Peer&&) = delete;
  Peer& operator=(const Peer&) = delete;
  Peer& operator=(Peer&&) = delete;
  virtual ~Peer() = default;

  virtual void set_motion(const reference::Positions& position,
                          const std::vector<reference::Vector>& velocity) = 0;
  /// All that elastic forces at the nodes' positions take: deformation gradients, rotations, forces.
  virtual void evaluate_forces() = 0;
  /// Of the last evaluation, N.
  [[nodiscard]] virtual std::vector<reference::Vector> forces() const = 0;
  /// Where a moved node is at the end of the next step, m.
  virtual void lead(uint32_t node, const reference::Vector& to) = 0;
  virtual void step() = 0;
  [[nodiscard]] virtual reference::Positions positions() const = 0;
};

/// Name and version; nothing where the program was built without a peer.
std::optional<std::string> peer_name();
/// Only where there is one.
std::unique_ptr<Peer> make_peer(const PeerSetup& setup);

}  // namespace palpate::bench
