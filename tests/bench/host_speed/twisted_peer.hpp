// A peer's body that starts as a twisted bar is and goes on with it: the same mesh, material, damping, held
// nodes and motion of the end.
#pragma once

#include "peer.hpp"
#include "twisted_bar.hpp"

namespace palpate::bench {

class TwistedPeer {
 public:
  TwistedPeer(const TwistedBar& bar, PeerMode mode);

  /// A step of 1 ms.
  void tick();
  [[nodiscard]] Peer& peer() { return *peer_; }
  [[nodiscard]] const Peer& peer() const { return *peer_; }
  [[nodiscard]] const reference::Mesh& mesh() const { return mesh_; }
  /// Since the bar's start.
  [[nodiscard]] uint32_t ticks() const { return ticks_; }

 private:
  double edge_m_;
  reference::Mesh mesh_;
  std::vector<uint8_t> held_by_;
  uint32_t ticks_;
  std::unique_ptr<Peer> peer_;
};

}  // namespace palpate::bench
