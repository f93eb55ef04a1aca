// Where Bullet was not found.
#include <stdexcept>

#include "peer.hpp"

namespace palpate::bench {

std::optional<std::string> peer_name() { return std::nullopt; }

std::unique_ptr<Peer> make_peer(const PeerSetup&) { throw std::logic_error("built without Bullet"); }

}  // namespace palpate::bench
