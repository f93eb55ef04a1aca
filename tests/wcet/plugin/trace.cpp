#include "trace.hpp"

#include <algorithm>

namespace palpate::wcet {

Trace::Trace(const Plan& plan) : root_(plan.root), bounds_(plan.bounds) {
  for (const auto& [entry, is_open] : plan.functions) {
    spots_[entry].function = functions_.size();
    Function function;
    function.entry = entry;
    function.is_open = is_open;
    function.loops.resize(bounds_.size());
    function.all.resize(bounds_.size());
    functions_.push_back(std::move(function));
  }
  for (const auto& [address, transfer] : plan.transfers) spots_[address].transfer = transfer;
  for (const PlannedMark& mark : plan.marks) spots_[mark.address].marks.push_back(mark);
}

Spot& Trace::spot(uint32_t address, uint32_t bytes) {
  Spot& found = spots_[address];
  found.address = address;
  found.next = address + bytes;
  return found;
}

void Trace::begin(Spot& at) {
  instructions_ = 0;
  open_frame(at.function, 0);
  count(at);
}

void Trace::end() {
  last_ = nullptr;
  invocations_.push_back(instructions_);
  const bool is_longest = instructions_ > longest_;
  longest_ = std::max(longest_, instructions_);
  for (auto& [address, spot] : spots_) {
    spot.all += spot.in_invocation;
    if (is_longest) spot.in_longest = spot.in_invocation;
    spot.in_invocation = 0;
  }
  for (Function& function : functions_) {
    FunctionCounts& counts = function.counts;
    counts.most_in_invocation = std::max(counts.most_in_invocation, function.in_invocation);
    if (is_longest) counts.in_longest = function.in_invocation;
    function.in_invocation = 0;
  }
}

void Trace::follow(Spot& at) {
  const Spot& from = *last_;
  const bool is_taken = at.address != from.next;
  const auto is_to = [&](const Spot::Edge& edge) { return edge.to == at.address; };
  const auto known = std::find_if(last_->edges.begin(), last_->edges.end(), is_to);
  const bool leaves_root = is_taken && from.transfer == Transfer::kReturn && frames_.back().return_to == 0;
  if (leaves_root) {
    close_frames();
    return end();
  }
  if (from.transfer == Transfer::kNone) return stray(at);
  if (known == last_->edges.end()) {
    last_->edges.push_back({at.address, 1});
  } else {
    ++known->count;
  }
  if (!is_taken) return;
  if (from.transfer == Transfer::kCall) {
    if (at.function == SIZE_MAX) return stray(at);
    open_frame(at.function, from.next);
  } else if (from.transfer == Transfer::kReturn) {
    if (frames_.back().return_to != at.address) return stray(at);
    close_frames();
  } else if (at.function != SIZE_MAX && at.function != frames_.back().function) {
    frames_.back().has_gone_on = true;
    open_frame(at.function, frames_.back().return_to);
  }
}

void Trace::open_frame(size_t function, uint32_t return_to) {
  const bool has_caller = functions_[function].is_open && !frames_.empty();
  const size_t owner = has_caller ? frames_.back().owner : function;
  frames_.push_back({function, owner, instructions_, return_to, false});
}

void Trace::close_frame() {
  const Frame frame = frames_.back();
  frames_.pop_back();
  Function& function = functions_[frame.function];
  const uint64_t instructions = instructions_ - frame.begin;
  ++function.counts.calls;
  function.counts.most = std::max(function.counts.most, instructions);
  function.in_invocation += instructions;
  if (frame.owner == frame.function) end_loops(function);
}

// The uppermost, and those that went on to it.
void Trace::close_frames() {
  do {
    close_frame();
  } while (!frames_.empty() && frames_.back().has_gone_on);
}

void Trace::end_loops(Function& function) {
  for (const size_t fact : function.touched) {
    const Loop& loop = function.loops[fact];
    LoopCounts& all = function.all[fact];
    all.entries += loop.entries;
    all.bodies += loop.bodies;
    const uint64_t most = bounds_[fact] * loop.entries;
    all.most_excess =
        std::max(all.most_excess, static_cast<int64_t>(loop.bodies) - static_cast<int64_t>(most));
    function.loops[fact] = {};
  }
  function.touched.clear();
}

void Trace::add_mark(const PlannedMark& mark) {
  Function& owner = functions_[frames_.back().owner];
  Loop& loop = owner.loops[mark.fact];
  if (loop.entries == 0 && loop.bodies == 0) owner.touched.push_back(mark.fact);
  if (!mark.is_body) {
    ++loop.entries;
    loop.rounds = 0;
    return;
  }
  ++loop.bodies;
  ++loop.rounds;
  LoopCounts& all = owner.all[mark.fact];
  all.most_rounds = std::max(all.most_rounds, loop.rounds);
}

// What was counted of this invocation is forgotten.
void Trace::stray(const Spot& at) {
  if (!stray_) stray_ = Way{last_->address, at.address};
  last_ = nullptr;
  frames_.clear();
  for (auto& [address, spot] : spots_) spot.in_invocation = 0;
  for (Function& function : functions_) {
    function.in_invocation = 0;
    for (const size_t fact : function.touched) function.loops[fact] = {};
    function.touched.clear();
  }
}

Counts Trace::counts() const {
  Counts counts;
  counts.invocations = invocations_;
  for (const auto& [address, spot] : spots_) {
    if (spot.all > 0) counts.spots[address] = {spot.all, spot.in_longest};
    for (const Spot::Edge& edge : spot.edges) counts.edges[{address, edge.to}] = edge.count;
  }
  for (const Function& function : functions_) {
    if (function.counts.calls > 0) counts.functions[function.entry] = function.counts;
    for (size_t fact = 0; fact < bounds_.size(); ++fact) {
      if (function.all[fact].entries + function.all[fact].bodies == 0) continue;
      counts.loops[{function.entry, fact}] = function.all[fact];
    }
  }
  counts.stray = stray_;
  counts.is_unfinished = last_ != nullptr;
  return counts;
}

}  // namespace palpate::wcet
