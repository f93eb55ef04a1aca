#include "timing_image.hpp"

#include <algorithm>
#include <numeric>

#include "report_rows.hpp"

namespace palpate::wcet::timing {
namespace {

// Of every firmware: the vector table's entry of the tick, what starts the background, and what both work on.
constexpr const char* kTickHandler = "palpate_tick_handler";
constexpr const char* kBackground = "palpate_reset_handler";
constexpr const char* kState = "g_storage";
constexpr size_t kHotBlocks = 12;
constexpr uint32_t kSmallPartBytes = 1024;

// The variants of a function, as templates make them, are one row.
void add_row(std::vector<PathRow>& rows, const PathRow& row) {
  const auto known =
      std::find_if(rows.begin(), rows.end(), [&](const PathRow& other) { return other.name == row.name; });
  if (known == rows.end()) return rows.push_back(row);
  known->calls += row.calls;
  known->own += row.own;
  known->with_callees += row.with_callees;
}

void sort_by_cost(std::vector<PathRow>& rows) {
  std::stable_sort(rows.begin(), rows.end(),
                   [](const PathRow& a, const PathRow& b) { return a.with_callees > b.with_callees; });
}

}  // namespace

uint32_t ImageFigures::ram_bytes() const {
  return std::accumulate(sections.begin(), sections.end(), 0u,
                         [](uint32_t sum, const SectionBytes& section) { return sum + section.ram; });
}

uint32_t ImageFigures::flash_bytes() const {
  return std::accumulate(sections.begin(), sections.end(), 0u,
                         [](uint32_t sum, const SectionBytes& section) { return sum + section.flash; });
}

TimingImage::TimingImage(const std::string& path, const std::string& profile, const std::string& core)
    : profile_(profile_shape(profile)),
      core_(core),
      program_(path),
      calls_(program_, program_.image().find_function(kTickHandler).start),
      model_(read_cost_model(core)) {
  const CostModel count = read_cost_model("instructions");
  figures_.instructions = BoundAnalysis(program_, calls_, count).bound();
  figures_.model = model_.description;
  figures_.interrupt = model_.interrupt_entry + model_.interrupt_exit;
  const BoundAnalysis analysis(program_, calls_, model_);
  figures_.cycles = analysis.bound() + figures_.interrupt;
  if (model_.mispredicted > 0) {
    CostModel predicted = model_;
    predicted.predictor = Predictor::kStatic;
    figures_.predicted_cycles = BoundAnalysis(program_, calls_, predicted).bound() + figures_.interrupt;
  }
  add_path(analysis);
  add_memory(path);
}

Cycles TimingImage::cycles_with(const std::map<uint32_t, uint32_t>& limits) const {
  return BoundAnalysis(program_, calls_, model_, limits).bound() + figures_.interrupt;
}

double TimingImage::calls_of(const std::string& function) const {
  double calls = 0;
  for (const PathRow& row : figures_.functions) {
    if (row.name == function) calls += row.calls;
  }
  return calls;
}

void TimingImage::add_path(const BoundAnalysis& analysis) {
  const WorstPath path = walk_worst_path(calls_, analysis);
  loops_ = measure_loops(program_, analysis, path);
  for (size_t i = 0; i < path.functions.size(); ++i) {
    const FunctionFigures& figures = path.functions[i];
    const FunctionGraph& graph = calls_.functions()[i];
    if (figures.calls == 0) continue;
    PathRow row{short_name(graph.name), program_.line_of(graph.entry), figures.calls, figures.own,
                figures.with_callees};
    add_row(figures_.functions, row);
    const std::optional<std::string> stage = stage_name(graph.name);
    if (!stage) continue;
    row.name = *stage;
    add_row(figures_.stages, row);
  }
  sort_by_cost(figures_.functions);
  sort_by_cost(figures_.stages);
  for (size_t i = 0; i < std::min(kHotBlocks, path.blocks.size()); ++i) {
    const BlockFigures& block = path.blocks[i];
    const FunctionGraph& graph = calls_.functions()[block.function];
    figures_.blocks.push_back({short_name(graph.name), program_.line_of(graph.blocks[block.block].address()),
                               block.count, block.own, block.own});
  }
}

void TimingImage::add_memory(const std::string& path) {
  figures_.stack = measure_interrupted_stack(program_, kBackground, kTickHandler);
  const std::vector<StackUse> stack = measure_stack(program_, calls_);
  for (const size_t i : deepest_chain(stack)) {
    figures_.stack_chain.push_back({short_name(calls_.functions()[i].name), "", 1,
                                    static_cast<double>(stack[i].own_bytes),
                                    static_cast<double>(stack[i].deepest_bytes)});
  }
  for (const FunctionGraph& graph : calls_.functions()) {
    const FunctionSymbol* symbol = program_.image().function_around(graph.entry);
    if (symbol != nullptr) figures_.tick_code_bytes += symbol->end - symbol->start;
  }
  for (const SectionUse& use : section_uses(program_.image()))
    figures_.sections.push_back({use.name, use.ram, use.flash});
  if (const std::optional<ObjectPart> state = read_object(path, kState))
    figures_.pools = list_pools(*state, kSmallPartBytes);
}

}  // namespace palpate::wcet::timing
