// A rotation front: tets of the bisection tree of which every leaf has exactly one above it or is one. Each
// is a group, whose leaves share its rotation.
#pragma once

#include "reference/bisection_tree.hpp"

namespace palpate::reference {

/// What splits along with a tet. kConforming: all tets around its refinement edge, and before them the
/// coarser ones that stand in their way, so that the front is a conforming mesh like the simulation front.
enum class Closure { kNone, kConforming };

class Front {
 public:
  /// The roots. The tree must outlive the front.
  explicit Front(const BisectionTree& tree);
  /// Full corotation: every leaf is a group.
  static Front of_leaves(const BisectionTree& tree);

  [[nodiscard]] const BisectionTree& tree() const { return *tree_; }
  [[nodiscard]] bool contains(uint32_t tet) const { return is_in_[tet]; }
  [[nodiscard]] uint32_t count() const { return count_; }
  /// In the order of the tree.
  [[nodiscard]] std::vector<uint32_t> tets() const;
  /// For each leaf of the mesh its group.
  [[nodiscard]] std::vector<uint32_t> group_of_leaves() const;

  [[nodiscard]] bool can_split(uint32_t tet) const { return is_in_[tet] && !tree_->is_leaf(tet); }
  void split(uint32_t tet, Closure closure);
  /// Both children are in the front.
  [[nodiscard]] bool can_merge(uint32_t parent) const;
  void merge(uint32_t parent);

 private:
  void split_alone(uint32_t tet);
  void split_down_to(uint32_t tet);

  const BisectionTree* tree_;
  std::vector<bool> is_in_;
  uint32_t count_ = 0;
};

}  // namespace palpate::reference
