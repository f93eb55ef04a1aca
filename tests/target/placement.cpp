#include "placement.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace palpate::target {
namespace {

constexpr uint32_t kKib = 1024;

const std::map<std::string, Layout>& layouts() {
  static const std::map<std::string, Layout> all = {
      {"mps2_an386",
       {{0x0000'0000, 64 * kKib}, {0x2000'0000, 64 * kKib}, {0x0010'0000, 1024 * kKib}, {}, 60 * kKib}},
      {"mps2_an500",
       {{0x0000'0000, 64 * kKib}, {0x2000'0000, 256 * kKib}, {0x0010'0000, 1024 * kKib}, {}, 256 * kKib}},
      {"stm32f4",
       {{0x0000'0000, 112 * kKib},
        {0x1000'0000, 64 * kKib},
        {0x0800'0000, 896 * kKib},
        {0x2001'C000, 16 * kKib},
        60 * kKib}},
      {"stm32h743",
       {{0x0000'0000, 64 * kKib},
        {0x2000'0000, 128 * kKib},
        {0x0800'0000, 1792 * kKib},
        {0x3000'0000, 128 * kKib},
        124 * kKib}},
      {"imxrt1062",
       {{0x0000'0000, 128 * kKib},
        {0x2000'0000, 128 * kKib},
        {0x6000'0000, 4096 * kKib},
        {0x2020'0000, 512 * kKib},
        124 * kKib}},
  };
  return all;
}

const Function* holder_of(const std::map<uint32_t, Function>& functions, uint32_t address) {
  const auto after = functions.upper_bound(address);
  return after == functions.begin() ? nullptr : &std::prev(after)->second;
}

}  // namespace

Layout layout_of(const std::string& board) {
  const auto found = layouts().find(board);
  if (found == layouts().end()) throw std::runtime_error("no board is called " + board);
  return found->second;
}

std::vector<const Function*> reached_from(const std::map<uint32_t, Function>& functions,
                                          const std::string& root) {
  const auto start = std::find_if(functions.begin(), functions.end(),
                                  [&](const auto& entry) { return entry.second.name == root; });
  if (start == functions.end()) return {};
  std::vector<const Function*> reached{&start->second};
  std::set<const Function*> seen{reached.front()};
  for (size_t next = 0; next < reached.size(); ++next) {
    for (const Instruction& instruction : reached[next]->code) {
      if (instruction.flow != Flow::kCall && instruction.flow != Flow::kJump) continue;
      const Function* callee = holder_of(functions, instruction.target);
      if (callee != nullptr && seen.insert(callee).second) reached.push_back(callee);
    }
  }
  return reached;
}

}  // namespace palpate::target
