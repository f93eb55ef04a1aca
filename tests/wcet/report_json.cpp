#include "report.hpp"

namespace palpate::wcet {
namespace {

using nlohmann::json;

json functions_of(const Findings& findings) {
  json rows = json::array();
  for (size_t i = 0; i < findings.path.functions.size(); ++i) {
    const FunctionFigures& figures = findings.path.functions[i];
    const FunctionGraph& graph = findings.calls.functions()[i];
    json row{
        {"name", graph.name},     {"address", graph.entry}, {"line", findings.program.line_of(graph.entry)},
        {"count", figures.calls}, {"own", figures.own},     {"with_callees", figures.with_callees}};
    if (const auto stage = stage_name(graph.name)) row["stage"] = *stage;
    if (findings.stack) {
      row["stack_bytes"] = (*findings.stack)[i].own_bytes;
      row["stack_bytes_with_callees"] = (*findings.stack)[i].deepest_bytes;
    }
    rows.push_back(row);
  }
  return rows;
}

json blocks_of(const Findings& findings) {
  json rows = json::array();
  for (const BlockFigures& block : findings.path.blocks) {
    const FunctionGraph& graph = findings.calls.functions()[block.function];
    const uint32_t address = graph.blocks[block.block].address();
    rows.push_back({{"function", graph.name},
                    {"address", address},
                    {"line", findings.program.line_of(address)},
                    {"count", block.count},
                    {"own", block.own}});
  }
  return rows;
}

}  // namespace

json to_json(const Findings& findings) {
  json sections = json::array();
  for (const SectionUse& use : section_uses(findings.program.image())) {
    sections.push_back({{"name", use.name}, {"ram_bytes", use.ram}, {"flash_bytes", use.flash}});
  }
  json ends = json::array();
  for (const uint32_t end : findings.calls.path_ends()) ends.push_back(findings.program.function_name(end));
  json document{{"root", findings.calls.functions().back().name},
                {"model", findings.model.name},
                {"unit", findings.model.unit},
                {"static_predictor", findings.model.predictor == Predictor::kStatic},
                {"wait_states", findings.model.wait_states},
                {"bound", findings.total()},
                {"interrupt", findings.interrupt()},
                {"functions", functions_of(findings)},
                {"blocks", blocks_of(findings)},
                {"path_ends", ends},
                {"sections", sections}};
  for (const PoolUse& pool : findings.pools)
    document["pools"].push_back({{"name", pool.name}, {"type", pool.type}, {"ram_bytes", pool.bytes}});
  if (findings.stack) {
    json chain = json::array();
    for (const size_t i : deepest_chain(*findings.stack)) chain.push_back(findings.calls.functions()[i].name);
    document["stack"] = {{"bytes", findings.stack->back().deepest_bytes}, {"deepest_chain", chain}};
  }
  return document;
}

}  // namespace palpate::wcet
