// Where an instruction leads to.
#include <algorithm>

#include "control_flow.hpp"

namespace palpate::wcet {
namespace {

// What fills the last half-word before code: gcc leaves a zero byte, clang a nop, which as an offset would
// lead out of the function.
bool is_filler(const Program& program, const Instruction& at, uint32_t target, uint32_t offset) {
  constexpr uint32_t kNop = 0xbf00;
  return offset == kNop &&
         program.image().function_around(target) != program.image().function_around(at.address);
}

// tbb and tbh: offsets without sign, in half-words from the table's start. The table ends at the latest where
// the first of its targets begins, or where code begins. What would lead into the table itself is behind its
// end.
std::vector<uint32_t> table_targets(const Program& program, const Instruction& at) {
  const uint32_t width = at.text.rfind("tbb", 0) == 0 ? 1 : 2;
  const uint32_t table = at.next();
  uint32_t end = program.image().stretch_end(table);
  std::vector<uint32_t> targets;
  if (program.image().is_code(table)) throw Refusal(program.place(at.address), "a branch without its table");
  for (uint32_t entry = table; entry + width <= end; entry += width) {
    const std::optional<uint32_t> offset = program.image().read(entry, width);
    if (!offset) break;
    const uint32_t target = table + 2 * *offset;
    if (target <= entry || is_filler(program, at, target, *offset)) break;
    targets.push_back(target);
    end = std::min(end, target);
  }
  if (targets.empty()) throw Refusal(program.place(at.address), "an empty branch table");
  return targets;
}

const Instruction* previous(const Program& program, const Instruction& at) {
  for (const uint32_t size : {2u, 4u}) {
    const Instruction* found = program.at(at.address - size);
    if (found != nullptr && found->next() == at.address) return found;
  }
  return nullptr;
}

// "adr r0, table" and "ldr pc, [r0, r1, lsl #2]", which gcc always writes as a pair: addresses, as words
// among the code. The table ends where code begins, or where a word is no address of code.
std::vector<uint32_t> word_table_targets(const Program& program, const Instruction& at) {
  const Instruction* adr = previous(program, at);
  if (adr == nullptr || !at.memory || !at.memory->has_index || !adr->assignment) return {};
  if (adr->assignment->kind != Assignment::Kind::kConstant || adr->assignment->destination != at.memory->base)
    return {};
  const auto table = static_cast<uint32_t>(adr->assignment->value);
  if (program.image().is_code(table)) return {};
  std::vector<uint32_t> targets;
  for (uint32_t entry = table; entry < program.image().stretch_end(table); entry += 4) {
    const std::optional<uint32_t> word = program.image().read(entry, 4);
    const bool is_target = word && (*word & 1) != 0 && program.at(*word & ~1u) != nullptr;
    if (!is_target) break;
    targets.push_back(*word & ~1u);
  }
  return targets;
}

// "ldr pc, [pc, #offset]", as the linker's veneers have it: to the address among the code.
std::optional<uint32_t> literal_target(const Program& program, const Instruction& at) {
  if (!at.memory || at.memory->base != kPc || at.memory->has_index) return std::nullopt;
  const uint32_t place = ((at.address + 4) & ~3u) + static_cast<uint32_t>(at.memory->offset);
  const std::optional<uint32_t> word = program.image().read(place, 4);
  const bool is_target = word && (*word & 1) != 0 && !program.image().is_code(place);
  return is_target ? std::optional<uint32_t>(*word & ~1u) : std::nullopt;
}

void add_jump(const Program& program, uint32_t entry, uint32_t target, Successors& next) {
  if (target != entry && program.image().functions().count(target) != 0) {
    next.callees.push_back(target);
    next.returns = true;
  } else {
    next.taken.push_back(target);
  }
}

const std::vector<uint32_t>& listed_targets(const Program& program, const Instruction& at,
                                            const std::vector<uint32_t>& marked) {
  if (!marked.empty()) return marked;
  throw Refusal(program.place(at.address), "an indirect call or jump without listed targets");
}

void refuse_what_has_no_bound(const Program& program, const Instruction& at, Purpose purpose) {
  const auto refuse = [&](const std::string& why) { throw Refusal(program.place(at.address), why); };
  if (at.flow == Flow::kUndecodable) refuse("code that can't be decoded");
  if (at.flow == Flow::kFloat) refuse("a floating-point instruction, " + at.text);
  if (at.flow == Flow::kWait && purpose == Purpose::kTime)
    refuse("waits for something outside of the program, " + at.text);
}

}  // namespace

Successors successors_of(const Program& program, uint32_t entry, const Instruction& at, Purpose purpose,
                         const std::vector<uint32_t>& marked) {
  refuse_what_has_no_bound(program, at, purpose);
  Successors next;
  next.goes_on = at.is_conditional;
  switch (at.flow) {
    case Flow::kJump:
      add_jump(program, entry, at.target, next);
      break;
    case Flow::kCall:
      next.callees.push_back(at.target);
      next.goes_on = true;
      break;
    case Flow::kIndirectCall:
      next.callees = listed_targets(program, at, marked);
      next.goes_on = true;
      break;
    case Flow::kIndirectJump:
      if (const std::optional<uint32_t> target = literal_target(program, at)) {
        add_jump(program, entry, *target, next);
        break;
      }
      next.taken = word_table_targets(program, at);
      if (!next.taken.empty()) break;
      next.callees = listed_targets(program, at, marked);
      next.returns = true;
      break;
    case Flow::kTable:
      next.taken = table_targets(program, at);
      break;
    case Flow::kReturn:
      next.returns = true;
      break;
    case Flow::kTrap:
      break;
    default:
      next.goes_on = true;
      break;
  }
  return next;
}

}  // namespace palpate::wcet
