// A scenario that can be advanced a tick at a time and looked at, whatever its profile and its way of moving
// the tool.
#pragma once

#include <memory>
#include <optional>

#include "scenario/scenario.hpp"
#include "simulation/body_fields.hpp"

namespace palpate::sim {

/// What a tick did. Positions in the body's file frame: origin at the block's low corner.
struct Sample {
  uint32_t tick;  // ticks done, this one included
  std::array<double, 3> tool_mm;
  std::array<double, 3> displacement_mm;  // of the watched node from its rest position
  std::array<double, 3> force_n;          // of the tissue on the tool, or on the turned end
  std::array<uint16_t, 3> motor_codes;    // only with a device
  uint32_t flags;                         // TickFlag bits
  uint32_t tets, rotation_tets;           // in use
};

/// How many of a pool are in use, and were at most.
struct PoolUse {
  uint32_t used, peak;
};

struct Totals {
  PoolUse tets, nodes, rotation_tets, tethers;
  RemeshCounters remesh;
  ClampCounters clamps;
};

/// The surface and all nodes, at rest and as they are.
struct BodyShape {
  std::vector<std::array<double, 3>> rest_mm;
  std::vector<std::array<double, 3>> now_mm;
  std::vector<std::array<uint32_t, 3>> triangles;  // of the surface, normals outwards: places of nodes above
  std::vector<uint32_t> rotation_tet;              // of each triangle: the same number, the same rotation
};

class Simulation {
 public:
  Simulation() = default;
  Simulation(const Simulation&) = delete;
  Simulation(Simulation&&) = delete;
  Simulation& operator=(const Simulation&) = delete;
  Simulation& operator=(Simulation&&) = delete;
  virtual ~Simulation() = default;

  /// Runs one tick. False when the scenario ended with it.
  virtual bool advance() = 0;
  /// After the last tick, once: closes what the simulation itself writes.
  virtual void end() {}
  [[nodiscard]] virtual Sample sample() const = 0;
  /// Most ticks that the scenario takes.
  [[nodiscard]] virtual uint32_t expected_ticks() const = 0;
  [[nodiscard]] virtual bool has_device() const = 0;

  /// Names and hashes of the stages in order; the last one is "state", over everything.
  [[nodiscard]] virtual std::vector<std::string> hash_names() const = 0;
  [[nodiscard]] virtual std::vector<uint64_t> hashes() const = 0;
  /// Host time spent in each stage so far, in the same order, without "state".
  [[nodiscard]] virtual std::vector<double> stage_ms() const = 0;

  [[nodiscard]] virtual Totals totals() const = 0;
  [[nodiscard]] virtual BodyShape shape() const = 0;
  [[nodiscard]] virtual BodyFields fields() const = 0;
  /// Why the run did not end as it should, if so.
  [[nodiscard]] virtual std::optional<std::string> failure() const { return std::nullopt; }
};

/// For the `run` scenarios and for `hil`. Throws BadInput when the model does not fit the profile.
std::unique_ptr<Simulation> make_tool_simulation(const Scenario& scenario);
std::unique_ptr<Simulation> make_device_simulation(const Scenario& scenario);

}  // namespace palpate::sim
