// The body that is timed: the core alone, without a device. Its code is compiled twice, as the preset has it
// and for this very processor, so that one run times both and sees that they make the same bits.
#pragma once

#include <memory>

#include "palpate/tick/model.hpp"
#include "reference/mesh.hpp"

namespace palpate::bench {

/// What a unit of the core is.
struct Units {
  double edge_m;
  double substep_s;
  double newtons;
};

/// Node by node.
struct Motion {
  reference::Positions position;            // m
  reference::Positions force_position;      // m, where the next forces are evaluated: x + beta_K v
  std::vector<reference::Vector> velocity;  // m/s
  std::vector<reference::Vector> force;     // N, of the last evaluation
};

class Bar {
 public:
  Bar() = default;
  Bar(const Bar&) = delete;
  Bar(Bar&&) = delete;
  Bar& operator=(const Bar&) = delete;
  Bar& operator=(Bar&&) = delete;
  virtual ~Bar() = default;

  /// 1 ms, at whose end the second held region has moved so far.
  virtual void tick(const RigidMotion& end) = 0;
  /// One step of each rotation, then all forces and what the next step needs of them: a tick's work in its
  /// last substep. No node moves.
  virtual void evaluate_forces() = 0;

  [[nodiscard]] virtual std::unique_ptr<Bar> copy() const = 0;
  [[nodiscard]] virtual reference::Mesh mesh() const = 0;
  /// Node by node, who moves it: nobody (0), the first or the second held region.
  [[nodiscard]] virtual std::vector<uint8_t> held_nodes() const = 0;
  [[nodiscard]] virtual Motion motion() const = 0;
  [[nodiscard]] virtual uint32_t rotations() const = 0;
  [[nodiscard]] virtual bool was_clamped() const = 0;  // since start: then forces are not the material's
  [[nodiscard]] virtual uint64_t hash() const = 0;     // of the whole state
};

using MakeBar = std::unique_ptr<Bar> (*)(const Model& model, const Units& units);

/// In profile workstation. Throws std::runtime_error when the model does not fit it.
[[gnu::visibility("default")]] std::unique_ptr<Bar> make_bar(const Model& model, const Units& units);
/// -O3 -march=native, whatever SIMD that gives.
[[gnu::visibility("default")]] std::unique_ptr<Bar> make_native_bar(const Model& model, const Units& units);

}  // namespace palpate::bench
