#include "reference/front.hpp"

namespace palpate::reference {

Front::Front(const BisectionTree& tree) : tree_(&tree), is_in_(tree.tet.size(), false) {
  for (const uint32_t root : tree.roots) is_in_[root] = true;
  count_ = static_cast<uint32_t>(tree.roots.size());
}

Front Front::of_leaves(const BisectionTree& tree) {
  Front front(tree);
  for (uint32_t t = 0; t < tree.tet.size(); ++t) front.is_in_[t] = tree.is_leaf(t);
  front.count_ = static_cast<uint32_t>(tree.mesh.tet.size());
  return front;
}

std::vector<uint32_t> Front::tets() const {
  std::vector<uint32_t> tets;
  for (uint32_t t = 0; t < is_in_.size(); ++t) {
    if (is_in_[t]) tets.push_back(t);
  }
  return tets;
}

std::vector<uint32_t> Front::group_of_leaves() const {
  std::vector<uint32_t> group(tree_->mesh.tet.size());
  for (const uint32_t t : tets()) {
    std::fill(group.begin() + tree_->tet[t].first_leaf, group.begin() + tree_->tet[t].end_leaf, t);
  }
  return group;
}

void Front::split_alone(uint32_t tet) {
  is_in_[tet] = false;
  for (const uint32_t child : tree_->tet[tet].child) is_in_[child] = true;
  ++count_;
}

/// Splits ancestors, each with its closure, until `tet` is in the front. Nothing if it is split already.
void Front::split_down_to(uint32_t tet) {
  while (!is_in_[tet]) {
    uint32_t above = tree_->tet[tet].parent;
    while (above != kNoTet && !is_in_[above]) above = tree_->tet[above].parent;
    if (above == kNoTet) return;
    split(above, Closure::kConforming);
  }
}

void Front::split(uint32_t tet, Closure closure) {
  if (!can_split(tet)) return;
  if (closure == Closure::kNone) {
    split_alone(tet);
    return;
  }
  const std::vector<uint32_t>& patch = tree_->patches[tree_->tet[tet].patch];
  for (const uint32_t t : patch) split_down_to(t);
  for (const uint32_t t : patch) {
    if (is_in_[t]) split_alone(t);
  }
}

bool Front::can_merge(uint32_t parent) const {
  return !tree_->is_leaf(parent) && is_in_[tree_->tet[parent].child[0]] &&
         is_in_[tree_->tet[parent].child[1]];
}

void Front::merge(uint32_t parent) {
  for (const uint32_t child : tree_->tet[parent].child) is_in_[child] = false;
  is_in_[parent] = true;
  --count_;
}

}  // namespace palpate::reference
