#include "counts.hpp"

#include <sstream>
#include <stdexcept>

namespace palpate::wcet {
namespace {

void read_line(std::istream& words, Counts& counts) {
  std::string kind;
  uint32_t address = 0;
  words >> kind;
  if (kind == "invocation") {
    words >> counts.invocations.emplace_back();
  } else if (kind == "spot") {
    words >> std::hex >> address >> std::dec;
    SpotCounts& spot = counts.spots[address];
    words >> spot.all >> spot.in_longest;
  } else if (kind == "edge") {
    uint32_t to = 0;
    words >> std::hex >> address >> to >> std::dec >> counts.edges[{address, to}];
  } else if (kind == "function") {
    words >> std::hex >> address >> std::dec;
    FunctionCounts& function = counts.functions[address];
    words >> function.calls >> function.most >> function.most_in_invocation >> function.in_longest;
  } else if (kind == "loop") {
    size_t fact = 0;
    words >> std::hex >> address >> std::dec >> fact;
    LoopCounts& loop = counts.loops[{address, fact}];
    words >> loop.entries >> loop.bodies >> loop.most_rounds >> loop.most_excess;
  } else if (kind == "stray") {
    Way& way = counts.stray.emplace();
    words >> std::hex >> way.first >> way.second;
  } else if (kind == "unfinished") {
    counts.is_unfinished = true;
  } else {
    words.setstate(std::ios::failbit);
  }
}

}  // namespace

void write_counts(const Counts& counts, std::ostream& to) {
  for (const uint64_t instructions : counts.invocations) to << "invocation " << instructions << "\n";
  for (const auto& [address, spot] : counts.spots) {
    to << "spot " << std::hex << address << std::dec << " " << spot.all << " " << spot.in_longest << "\n";
  }
  for (const auto& [way, count] : counts.edges) {
    to << "edge " << std::hex << way.first << " " << way.second << std::dec << " " << count << "\n";
  }
  for (const auto& [entry, function] : counts.functions) {
    to << "function " << std::hex << entry << std::dec << " " << function.calls << " " << function.most << " "
       << function.most_in_invocation << " " << function.in_longest << "\n";
  }
  for (const auto& [key, loop] : counts.loops) {
    to << "loop " << std::hex << key.first << std::dec << " " << key.second << " " << loop.entries << " "
       << loop.bodies << " " << loop.most_rounds << " " << loop.most_excess << "\n";
  }
  if (counts.stray) {
    to << "stray " << std::hex << counts.stray->first << " " << counts.stray->second << std::dec << "\n";
  }
  if (counts.is_unfinished) to << "unfinished\n";
}

Counts read_counts(std::istream& from) {
  Counts counts;
  for (std::string line; std::getline(from, line);) {
    std::istringstream words(line);
    read_line(words, counts);
    if (words.fail()) throw std::runtime_error("no line of counts: " + line);
  }
  return counts;
}

}  // namespace palpate::wcet
