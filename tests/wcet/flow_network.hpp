// The paths of a function as a flow: a unit enters at the first node, and every edge carries how often it is
// taken.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "flow_facts.hpp"

namespace palpate::wcet {

using Cycles = int64_t;

inline constexpr size_t kExit = SIZE_MAX;

/// Where in the program a node is. A callee that is spliced in brings its blocks along: `via` is the node of
/// the call.
struct Node {
  size_t function = 0;  // in the call graph's order
  size_t block = 0;
  std::optional<size_t> via;
  std::vector<Mark> marks;  // in the order of the code
};

struct Arc {
  size_t from = 0;
  size_t to = kExit;
  bool ends_path = false;        // it leaves for good and not for the caller
  Cycles own = 0;                // of the block that it leaves and of the way it leaves it
  std::optional<size_t> callee;  // a function whose bound is part of the cost
  Cycles below = 0;              // that bound

  [[nodiscard]] Cycles cost() const { return own + below; }
};

struct Network {
  std::vector<Node> nodes;  // the first is the entry
  std::vector<Arc> arcs;
};

/// A fact's part in a node's count: bodies - bound x entries, which must be 0 or less in sum.
Cycles fact_weight(const Node& node, const LoopFact& fact);

/// A body that can be reached without an entry before it: the fact says nothing about this network alone. The
/// place of such a body, if there is one.
std::optional<uint32_t> find_body_without_entry(const Network& network, const LoopFact& fact);

/// The facts that a network holds bodies of.
std::vector<LoopFact> facts_within(const Network& network, const std::vector<LoopFact>& all);

}  // namespace palpate::wcet
