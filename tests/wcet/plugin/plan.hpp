// What a measurement watches, and the file that tells the plugin. Lines of words, addresses in hexadecimal:
//
//   root ADDRESS                         measured from its first instruction to its return
//   function ADDRESS closed|open         of the root's graph; an open one has no bound of its own: what its
//                                        loops do counts for the closed one that calls it
//   transfer ADDRESS call|jump|return    an instruction that may lead elsewhere
//   fact NUMBER BOUND                    bodies <= BOUND x entries, in every call of a closed function
//   mark ADDRESS enter|body FACT         the instruction is an entry or a body of that fact
#pragma once

#include <cstdint>
#include <istream>
#include <map>
#include <ostream>
#include <vector>

namespace palpate::wcet {

enum class Transfer : uint8_t { kNone, kCall, kJump, kReturn };

struct PlannedMark {
  uint32_t address = 0;
  bool is_body = false;  // else an entry
  size_t fact = 0;
};

struct Plan {
  uint32_t root = 0;
  std::map<uint32_t, bool> functions;      // by entry; true: open
  std::map<uint32_t, Transfer> transfers;  // by address
  std::vector<uint32_t> bounds;            // of facts, by number
  std::vector<PlannedMark> marks;
};

void write_plan(const Plan& plan, std::ostream& to);
/// Throws std::runtime_error with the line that is none.
Plan read_plan(std::istream& from);

}  // namespace palpate::wcet
