#include "timing_report.hpp"

namespace palpate::wcet::timing {
namespace {

using nlohmann::json;

template <class Number>
json or_null(const std::optional<Number>& number) {
  return number ? json(*number) : json(nullptr);
}

json path_rows(const std::vector<PathRow>& rows) {
  json list = json::array();
  for (const PathRow& row : rows) {
    list.push_back({{"name", row.name},
                    {"line", row.line},
                    {"count", row.calls},
                    {"own_cycles", row.own},
                    {"cycles_with_callees", row.with_callees}});
  }
  return list;
}

json boards_of(const ProfileTiming& timing) {
  json list = json::array();
  for (const BoardTiming& board : timing.boards) {
    list.push_back({{"name", board.board.name},
                    {"clock_mhz", board.board.clock_mhz},
                    {"device_register_cycles", board.device_cycles},
                    {"bound_cycles", board.cycles},
                    {"bound_us", board.microseconds()},
                    {"slack_us", board.slack_us()}});
  }
  return list;
}

json formula_of(const ProfileTiming& timing) {
  if (!timing.formula) return nullptr;
  json terms = json::array();
  for (const FormulaTerm& term : timing.formula->terms)
    terms.push_back({{"quantity", term.quantity}, {"count", term.count}, {"cycles_each", term.each}});
  return {{"constant_cycles", timing.formula->constant},
          {"terms", terms},
          {"largest_relative_error", timing.formula_error}};
}

json memory_of(const ImageFigures& figures) {
  json sections = json::array();
  for (const SectionBytes& section : figures.sections)
    sections.push_back({{"name", section.name}, {"ram_bytes", section.ram}, {"flash_bytes", section.flash}});
  json pools = json::array();
  for (const PoolUse& pool : figures.pools)
    pools.push_back({{"name", pool.name}, {"type", pool.type}, {"bytes", pool.bytes}});
  json chain = json::array();
  for (const PathRow& row : figures.stack_chain) chain.push_back({{"name", row.name}, {"bytes", row.own}});
  return {{"sections", sections},
          {"pools", pools},
          {"flash_bytes", figures.flash_bytes()},
          {"stack",
           {{"background_bytes", figures.stack.background},
            {"exception_frame_bytes", figures.stack.frame},
            {"tick_bytes", figures.stack.interrupt},
            {"deepest_chain", chain}}}};
}

}  // namespace

json make_json(const std::vector<ProfileTiming>& timings) {
  json list = json::array();
  for (const ProfileTiming& timing : timings) {
    const CommittedFigures now = timing.now();
    const std::optional<Cycles>& design = timing.row.design.cycles;
    json row{{"profile", timing.name},
             {"core", timing.row.core},
             {"bound_instructions", now.instructions},
             {"bound_cycles", now.cycles},
             {"bound_cycles_static_predictor", or_null(timing.figures.predicted_cycles)},
             {"max_observed_instructions", nullptr},
             {"coverage_percent", nullptr},
             {"ratio", or_null(timing.ratio())},
             {"stack_bytes", now.stack_bytes},
             {"ram_bytes", now.ram_bytes},
             {"code_bytes", now.tick_code_bytes},
             {"design_cycles", or_null(design)},
             {"goal_cycles", or_null(timing.row.design.goal_cycles)},
             {"is_design_met", design ? json(now.cycles <= *design) : json(nullptr)},
             {"committed_instructions", timing.row.committed.instructions},
             {"committed_cycles", timing.row.committed.cycles},
             {"boards", boards_of(timing)},
             {"formula", formula_of(timing)},
             {"stages", path_rows(timing.figures.stages)},
             {"functions", path_rows(timing.figures.functions)},
             {"hot_blocks", path_rows(timing.figures.blocks)},
             {"memory", memory_of(timing.figures)}};
    if (timing.measured) {
      row["max_observed_instructions"] = timing.measured->max_observed_instructions;
      row["coverage_percent"] = or_null(timing.measured->coverage_percent);
    }
    list.push_back(row);
  }
  return list;
}

}  // namespace palpate::wcet::timing
