// The bisection tree over the leaves of a forest: every tet that a leaf came from, with its own nodes. The
// core keeps no nodes of internal tets; here they are rebuilt from the leaves.
#pragma once

#include <algorithm>
#include <map>

#include "reference/mesh_from_forest.hpp"

namespace palpate::reference {

struct TreeTet {
  std::array<uint32_t, 4> node;   // in bisection order (palpate/mesh/tet_shape.hpp)
  std::array<uint32_t, 2> child;  // kNoTet for a leaf
  uint32_t parent;                // kNoTet for a root
  uint32_t first_leaf, end_leaf;  // its leaves are mesh.tet[first_leaf .. end_leaf)
  uint32_t patch;                 // the tets around its refinement edge are patches[patch]
  uint8_t level;
  double volume;  // m3
};

inline constexpr uint32_t kNoTet = 0xffffffff;

struct BisectionTree {
  Mesh mesh;                 // the leaves, depth first; nodes as mesh_of(forest) numbers them
  std::vector<TreeTet> tet;  // depth first, a parent before its children
  std::vector<uint32_t> roots;
  std::vector<std::vector<uint32_t>> patches;  // internal tets with the same refinement edge

  [[nodiscard]] bool is_leaf(uint32_t t) const { return tet[t].child[0] == kNoTet; }
  [[nodiscard]] uint32_t sibling(uint32_t t) const {
    const TreeTet& above = tet[tet[t].parent];
    return above.child[above.child[0] == t ? 1 : 0];
  }
};

namespace bisection_tree_detail {

template <class Profile>
class Builder {
 public:
  Builder(const Forest<Profile>& forest, double edge_m) : forest_(forest), place_(Profile::kNodes) {
    tree_.mesh.rest = mesh_of(forest, edge_m).rest;
    for (uint32_t i = 0; i < forest.nodes.used(); ++i) place_[forest.nodes.live(i)] = i;
  }

  BisectionTree build() {
    for (uint32_t pair = 0; pair < Forest<Profile>::kPairs; ++pair) {
      if (!forest_.pairs.is_live(pair) || forest_.pairs.parent(pair) != kNone) continue;
      for (uint32_t k = 0; k < 2; ++k) {
        tree_.roots.push_back(add(static_cast<uint16_t>(2 * pair + k), kNoTet));
      }
    }
    measure();
    collect_patches();
    return std::move(tree_);
  }

 private:
  uint32_t add(uint16_t t, uint32_t parent) {
    const auto id = static_cast<uint32_t>(tree_.tet.size());
    const auto first = static_cast<uint32_t>(tree_.mesh.tet.size());
    tree_.tet.push_back(TreeTet{{}, {kNoTet, kNoTet}, parent, first, first, 0, forest_.level_of(t), 0.0});
    if (forest_.tet[t].is_leaf()) {
      const Leaf& leaf = forest_.leaf_of(t);
      for (uint32_t i = 0; i < 4; ++i) tree_.tet[id].node[i] = place_[leaf.node[i]];
      tree_.mesh.tet.push_back(tree_.tet[id].node);
      tree_.mesh.region.push_back(leaf.region());
    } else {
      const uint32_t child0 = add(forest_.child(t, 0), id);
      const uint32_t child1 = add(forest_.child(t, 1), id);
      const uint32_t end = refinement_end(type_of_level(tree_.tet[id].level));
      tree_.tet[id].child = {child0, child1};
      tree_.tet[id].node = tree_.tet[child0].node;  // with the midpoint in place of w[end]
      tree_.tet[id].node[end] = tree_.tet[child1].node[end - 1];
    }
    tree_.tet[id].end_leaf = static_cast<uint32_t>(tree_.mesh.tet.size());
    return id;
  }

  void measure() {
    const std::vector<Element> leaves = elements_of(tree_.mesh);
    for (TreeTet& tet : tree_.tet) {
      for (uint32_t i = tet.first_leaf; i < tet.end_leaf; ++i) tet.volume += leaves[i].volume;
    }
  }

  void collect_patches() {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> patch_of_edge;
    for (uint32_t t = 0; t < tree_.tet.size(); ++t) {
      if (tree_.is_leaf(t)) continue;
      TreeTet& tet = tree_.tet[t];
      const auto edge = std::minmax(tet.node[0], tet.node[refinement_end(type_of_level(tet.level))]);
      const auto next = static_cast<uint32_t>(tree_.patches.size());
      tet.patch = patch_of_edge.emplace(edge, next).first->second;
      if (tet.patch == next) tree_.patches.emplace_back();
      tree_.patches[tet.patch].push_back(t);
    }
  }

  const Forest<Profile>& forest_;
  std::vector<uint32_t> place_;
  BisectionTree tree_;
};

}  // namespace bisection_tree_detail

template <class Profile>
BisectionTree tree_of(const Forest<Profile>& forest, double edge_m) {
  return bisection_tree_detail::Builder<Profile>(forest, edge_m).build();
}

}  // namespace palpate::reference
