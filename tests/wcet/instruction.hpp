// A Thumb-2 instruction, as far as timing, stack and flow of control need it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace palpate::wcet {

enum class Flow : uint8_t {
  kNext,          // on to the next instruction
  kJump,          // to the target; when conditional, or to the next instruction
  kCall,          // to the target and back
  kReturn,        // to the caller
  kTable,         // to an entry of the table behind it (tbb, tbh)
  kIndirectJump,  // to an address from a register or from memory
  kIndirectCall,
  kTrap,        // udf: it does not go on
  kWait,        // its time is not the program's: wfi, wfe, svc, bkpt
  kFloat,       // of the floating-point unit
  kUndecodable  // no instruction
};

/// The rows of a cost model.
enum class CostClass : uint8_t {
  kAlu,
  kMultiply,
  kDivide,
  kLoad,
  kLoadNarrow,  // bytes and half-words
  kLoadLiteral,
  kLoadMultiple,
  kStore,
  kStoreNarrow,
  kStoreMultiple,
  kConditionalBranch,
  kBranch,
  kCall,
  kBranchRegister,  // bx, blx, mov pc
  kLoadPc,          // a load or pop whose list has pc
  kTableBranch,
  kBarrier,
  kSystem,  // cps, mrs, msr
  kCount
};

using RegisterSet = uint16_t;  // bit n: rn
inline constexpr uint8_t kSp = 13;
inline constexpr uint8_t kLr = 14;
inline constexpr uint8_t kPc = 15;
constexpr RegisterSet only(uint8_t number) { return static_cast<RegisterSet>(1u << number); }
constexpr bool has(RegisterSet set, uint8_t number) { return ((set >> number) & 1u) != 0; }

constexpr uint8_t lowest_of(RegisterSet set) {
  uint8_t number = 0;
  while (number < kPc && !has(set, number)) ++number;
  return number;
}

struct MemoryAccess {
  bool is_store = false;
  uint8_t base = 0;
  bool has_index = false;  // then the offset is not all
  int32_t offset = 0;
  uint32_t bytes = 0;
};

/// What an instruction gives a register, where that is simple.
struct Assignment {
  enum class Kind : uint8_t { kSum, kConstant, kUpperHalf } kind;  // source + value, value, value << 16
  uint8_t destination = 0;
  uint8_t source = 0;
  int32_t value = 0;
};

struct Instruction {
  uint32_t address = 0;
  uint8_t size = 0;
  Flow flow = Flow::kNext;
  bool is_conditional = false;  // by IT, by its own condition, or cbz
  CostClass cost = CostClass::kAlu;
  uint8_t transfers = 0;  // registers of a load or store multiple
  uint32_t target = 0;    // of a jump or a call
  bool is_nop = false;
  RegisterSet reads = 0;          // plainly
  RegisterSet address_reads = 0;  // for an address
  RegisterSet shifted_reads = 0;  // through the shifter
  RegisterSet writes = 0;
  std::optional<MemoryAccess> memory;
  std::optional<Assignment> assignment;
  std::optional<Assignment> writeback;  // of the base of a memory access
  std::string text;

  [[nodiscard]] uint32_t next() const { return address + size; }
};

}  // namespace palpate::wcet
