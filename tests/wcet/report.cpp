#include "report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace palpate::wcet {
namespace {

constexpr size_t kHotBlocks = 12;

std::string assumptions(const CostModel& model) {
  const char* predictor = model.predictor == Predictor::kStatic ? "backward branches are predicted as taken"
                                                                : "every conditional branch is mispredicted";
  std::string text = model.mispredicted == 0 ? "" : predictor;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (model.wait_states > 0) add(fmt::format("{} wait states", model.wait_states));
  for (const DeviceRange& range : model.devices.ranges)
    add(fmt::format("{}: {} more", range.name, range.cycles));
  return text;
}

void print_row(const Findings& findings, const FunctionFigures& figures, const std::string& name) {
  const auto total = static_cast<double>(findings.total());
  fmt::print("{:>12.0f} {:>12.0f} {:>6.1f}% {:>10.0f}  {}\n", figures.with_callees, figures.own,
             100 * figures.with_callees / total, figures.calls, shortened(name));
}

std::vector<size_t> by_cost(const Findings& findings) {
  std::vector<size_t> order(findings.path.functions.size());
  std::iota(order.begin(), order.end(), size_t{0});
  const auto& functions = findings.path.functions;
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return functions[a].with_callees > functions[b].with_callees; });
  return order;
}

void print_functions(const Findings& findings, bool stages) {
  fmt::print("\n{:>12} {:>12} {:>7} {:>10}  {}\n", "with callees", "own", "share", "count",
             stages ? "stage" : "function");
  for (const size_t i : by_cost(findings)) {
    const FunctionFigures& figures = findings.path.functions[i];
    const std::string& name = findings.calls.functions()[i].name;
    const std::optional<std::string> stage = stage_name(name);
    if (figures.calls == 0 || (stages && !stage)) continue;
    print_row(findings, figures, stages ? *stage : name);
  }
  if (findings.with_interrupt) {
    const auto cycles = static_cast<double>(findings.interrupt());
    print_row(findings, {1, cycles, cycles}, "interrupt entry and exit");
  }
}

std::string place_text(Place place) {
  place.function = shortened(place.function);
  return to_string(place);
}

void print_hot_blocks(const Findings& findings) {
  fmt::print("\n{:>12} {:>7} {:>10} {:>8}  {}\n", "own", "share", "count", "each",
             "hottest blocks of the worst path");
  for (size_t i = 0; i < std::min(kHotBlocks, findings.path.blocks.size()); ++i) {
    const BlockFigures& block = findings.path.blocks[i];
    const uint32_t address = findings.calls.functions()[block.function].blocks[block.block].address();
    fmt::print("{:>12.0f} {:>6.1f}% {:>10.0f} {:>8.1f}  {}\n", block.own,
               100 * block.own / static_cast<double>(findings.total()), block.count, block.own / block.count,
               place_text(findings.program.place(address)));
  }
}

void print_stack(const Findings& findings, const std::vector<StackUse>& stack) {
  fmt::print("\nstack: at most {} bytes\n{:>12} {:>12}  {}\n", stack.back().deepest_bytes, "with callees",
             "own", "deepest chain of calls");
  for (const size_t i : deepest_chain(stack)) {
    fmt::print("{:>12} {:>12}  {}\n", stack[i].deepest_bytes, stack[i].own_bytes,
               shortened(findings.calls.functions()[i].name));
  }
}

void print_sections(const Findings& findings) {
  fmt::print("\n{:>12} {:>12}  section\n", "RAM bytes", "flash bytes");
  SectionUse sum{"all", 0, 0};
  for (const SectionUse& use : section_uses(findings.program.image())) {
    fmt::print("{:>12} {:>12}  {}\n", use.ram, use.flash, use.name);
    sum.ram += use.ram;
    sum.flash += use.flash;
  }
  fmt::print("{:>12} {:>12}  {}\n", sum.ram, sum.flash, sum.name);
}

}  // namespace

std::vector<SectionUse> section_uses(const ElfImage& image) {
  std::vector<SectionUse> uses;
  for (const Section& section : image.sections()) {
    if (!section.loaded || section.size == 0) continue;
    uses.push_back(
        {section.name, section.writable ? section.size : 0, section.bytes.empty() ? 0 : section.size});
  }
  return uses;
}

std::vector<size_t> deepest_chain(const std::vector<StackUse>& stack) {
  std::vector<size_t> chain{stack.size() - 1};
  while (stack[chain.back()].next_deepest) chain.push_back(*stack[chain.back()].next_deepest);
  return chain;
}

void print(const Findings& findings) {
  const std::string& root = findings.calls.functions().back().name;
  fmt::print("{}: at most {} {}\n", root, findings.total(), findings.model.unit);
  fmt::print("model {}: {}\n", findings.model.name, findings.model.description);
  if (const std::string text = assumptions(findings.model); !text.empty()) fmt::print("with: {}\n", text);
  for (const uint32_t end : findings.calls.path_ends()) {
    fmt::print("a path that calls {} ends there\n", findings.program.function_name(end));
  }
  print_functions(findings, true);
  print_functions(findings, false);
  print_hot_blocks(findings);
  if (findings.stack) print_stack(findings, *findings.stack);
  print_sections(findings);
}

}  // namespace palpate::wcet
