// The field of a contest: bodies that are timed against each other, each with its line of the report.
#pragma once

#include "report.hpp"
#include "twisted_peer.hpp"

namespace palpate::bench {

/// | f - exact | / | exact | over all nodes, exact: full corotation in doubles with nodes at these places.
double force_error(const reference::Mesh& mesh, const reference::Material& material,
                   const reference::Positions& at, const std::vector<reference::Vector>& force);

class Field {
 public:
  using Bar = std::shared_ptr<TwistedBar>;
  using Entrant = std::size_t;

  /// `full`: the bar with full corotation, for the distance from it.
  Entrant add_ticks(const std::string& who, const Bar& bar, const Bar& full);
  /// One evaluation after the other of a copy of the bar as it is now.
  Entrant add_forces(const std::string& who, const Bar& bar);
  /// Steps of a peer that starts as the bar with full corotation is.
  Entrant add_peer_ticks(const std::string& who, const Bar& full, PeerMode mode);
  /// Of a peer with nodes at these places.
  Entrant add_peer_forces(const std::string& who, const Bar& full, const reference::Positions& at);

  void race(uint32_t rounds);

  [[nodiscard]] std::vector<Row> rows() const;
  [[nodiscard]] const Row& row(Entrant entrant) const { return entries_.at(entrant).row; }
  [[nodiscard]] Figure speed_ratio(Entrant entrant, Entrant slower) const {
    return contest_.speed_ratio(entrant, slower);
  }

 private:
  struct Entry {
    Row row;
    std::function<void(Row&)> complete;  // what is known after the race
  };
  Entrant add(Row row, std::function<void()> run, uint32_t times_a_slice, std::function<void(Row&)> complete);

  Contest contest_;
  std::vector<Entry> entries_;
};

}  // namespace palpate::bench
