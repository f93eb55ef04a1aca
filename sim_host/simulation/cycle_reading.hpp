// What a simulation of the whole cycle shows of its state.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "palpate/firmware/cycle.hpp"
#include "simulation/body_reading.hpp"
#include "simulation/simulation.hpp"

namespace palpate::sim {

template <class Profile>
Sample cycle_sample(const firmware::CycleState<Profile>& state, const ModelParameters& model,
                    uint16_t watched_node) {
  return Sample{state.core.tick,
                to_mm(state.input.tool, model),
                displacement_mm(state.core, watched_node, model.edge_m),
                to_doubles(state.force),
                state.motor_codes,
                state.output.flags,
                state.core.forest.leaf_count,
                state.core.front.groups.used()};
}

inline std::vector<std::string> cycle_hash_names() {
  std::vector<std::string> names;
  for (uint32_t i = 0; i < firmware::kStageCount; ++i) {
    names.emplace_back(firmware::stage_name(static_cast<firmware::Stage>(i)));
  }
  names.emplace_back("state");
  return names;
}

template <class Profile>
std::vector<uint64_t> cycle_hashes(const firmware::CycleState<Profile>& state) {
  std::vector<uint64_t> values;
  for (uint32_t i = 0; i < firmware::kStageCount; ++i) {
    values.push_back(firmware::stage_hash(state, static_cast<firmware::Stage>(i)));
  }
  values.push_back(firmware::state_hash(state));
  return values;
}

inline std::string conditions_text(safety::ConditionSet conditions) {
  std::vector<std::string> names;
  for (uint32_t i = 0; i < safety::kConditionCount; ++i) {
    const auto condition = static_cast<safety::Condition>(i);
    if (conditions.has(condition)) names.emplace_back(safety::condition_name(condition));
  }
  return names.empty() ? "no condition" : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace palpate::sim
