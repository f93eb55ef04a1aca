#include "loops.hpp"

#include <cxxabi.h>

#include <cstdlib>
#include <map>
#include <memory>

namespace palpate::wcet {
namespace {

// "Place" of palpate::kLoopId<Place, Max>, which is what a fact's id is the address of.
std::map<uint32_t, std::string> loop_places(const ElfImage& image) {
  constexpr std::string_view kBefore = "palpate::kLoopId<";
  std::map<uint32_t, std::string> places;
  for (const Symbol& symbol : image.symbols()) {
    if (symbol.name.find("kLoopId") == std::string::npos) continue;
    int status = 0;
    const std::unique_ptr<char, void (*)(void*)> text(
        abi::__cxa_demangle(symbol.name.c_str(), nullptr, nullptr, &status), std::free);
    const std::string name = status == 0 ? text.get() : "";
    if (name.rfind(kBefore, 0) != 0) continue;
    places[symbol.address] = name.substr(kBefore.size(), name.rfind(',') - kBefore.size());
  }
  return places;
}

struct MarkCounts {
  double entries = 0;
  double bodies = 0;
};

MarkCounts count_marks(const FunctionBound& bound, const LoopFact& fact) {
  MarkCounts counts;
  for (size_t i = 0; i < bound.network.arcs.size(); ++i) {
    for (const Mark& mark : bound.network.nodes[bound.network.arcs[i].from].marks) {
      if (mark.kind == FactKind::kEnter && mark.id == fact.enter) counts.entries += bound.solution.counts[i];
      if (mark.kind == FactKind::kBody && mark.id == fact.body) counts.bodies += bound.solution.counts[i];
    }
  }
  return counts;
}

}  // namespace

std::vector<LoopFigures> measure_loops(const Program& program, const BoundAnalysis& analysis,
                                       const WorstPath& path) {
  const std::map<uint32_t, std::string> places = loop_places(program.image());
  std::map<std::pair<uint32_t, uint32_t>, LoopFigures> loops;  // by body and enter
  for (size_t i = 0; i < analysis.functions().size(); ++i) {
    const FunctionBound& bound = analysis.functions()[i];
    const double calls = path.functions[i].calls;
    if (bound.is_open) continue;
    for (size_t j = 0; j < bound.facts.size(); ++j) {
      const LoopFact& fact = bound.facts[j];
      const MarkCounts counts = count_marks(bound, fact);
      LoopFigures& figures = loops[{fact.body, fact.enter}];
      figures.fact = fact;
      figures.entries += calls * counts.entries;
      figures.bodies += calls * counts.bodies;
      figures.per_round += calls * counts.entries * bound.solution.multipliers[j];
    }
  }
  std::vector<LoopFigures> list;
  for (auto& [ids, figures] : loops) {
    const auto place = places.find(figures.fact.body);
    if (place != places.end()) figures.place = place->second;
    list.push_back(figures);
  }
  return list;
}

}  // namespace palpate::wcet
