#include "placement.hpp"

#include <map>
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

}  // namespace

Layout layout_of(const std::string& board) {
  const auto found = layouts().find(board);
  if (found == layouts().end()) throw std::runtime_error("no board is called " + board);
  return found->second;
}

std::vector<const wcet::Instruction*> code_of(const wcet::Program& program,
                                              const wcet::FunctionSymbol& function) {
  std::vector<const wcet::Instruction*> code;
  const auto end = program.code().lower_bound(function.end);
  for (auto at = program.code().lower_bound(function.start); at != end; ++at) code.push_back(&at->second);
  return code;
}

std::vector<const wcet::FunctionSymbol*> reached_from(const wcet::Program& program, const std::string& root) {
  std::vector<const wcet::FunctionSymbol*> reached{&program.image().find_function(root)};
  std::set<const wcet::FunctionSymbol*> seen{reached.front()};
  for (size_t next = 0; next < reached.size(); ++next) {
    for (const wcet::Instruction* instruction : code_of(program, *reached[next])) {
      if (instruction->flow != wcet::Flow::kCall && instruction->flow != wcet::Flow::kJump) continue;
      const wcet::FunctionSymbol* callee = program.image().function_around(instruction->target);
      if (callee != nullptr && seen.insert(callee).second) reached.push_back(callee);
    }
  }
  return reached;
}

}  // namespace palpate::target
