#include "instruction_kind.hpp"

#include <capstone/capstone.h>

namespace palpate::wcet {
namespace {

bool begins(std::string_view text, std::string_view start) { return text.substr(0, start.size()) == start; }

}  // namespace

InstructionKind kind_of(unsigned id) {
  switch (id) {
    case ARM_INS_LDR:
    case ARM_INS_LDREX:
      return {CostClass::kLoad, 4, false};
    case ARM_INS_LDRB:
    case ARM_INS_LDRSB:
    case ARM_INS_LDREXB:
      return {CostClass::kLoadNarrow, 1, false};
    case ARM_INS_LDRH:
    case ARM_INS_LDRSH:
    case ARM_INS_LDREXH:
      return {CostClass::kLoadNarrow, 2, false};
    case ARM_INS_LDRD:
    case ARM_INS_LDM:
    case ARM_INS_LDMDB:
    case ARM_INS_POP:
      return {CostClass::kLoadMultiple, 4, false};
    case ARM_INS_STR:
    case ARM_INS_STREX:
      return {CostClass::kStore, 4, true};
    case ARM_INS_STRB:
    case ARM_INS_STREXB:
      return {CostClass::kStoreNarrow, 1, true};
    case ARM_INS_STRH:
    case ARM_INS_STREXH:
      return {CostClass::kStoreNarrow, 2, true};
    case ARM_INS_STRD:
    case ARM_INS_STM:
    case ARM_INS_STMDB:
    case ARM_INS_PUSH:
      return {CostClass::kStoreMultiple, 4, true};
    case ARM_INS_SDIV:
    case ARM_INS_UDIV:
      return {CostClass::kDivide, 0, false};
    case ARM_INS_DMB:
    case ARM_INS_DSB:
    case ARM_INS_ISB:
      return {CostClass::kBarrier, 0, false};
    case ARM_INS_CPS:
    case ARM_INS_MRS:
    case ARM_INS_MSR:
      return {CostClass::kSystem, 0, false};
    default:
      return {CostClass::kAlu, 0, false};
  }
}

bool is_multiply(std::string_view name) {
  for (const std::string_view start : {"mul", "mla", "mls", "smul", "umul", "smla", "umla", "umaal", "smls",
                                       "smm", "smua", "smus", "usad"}) {
    if (begins(name, start)) return true;
  }
  return false;
}

bool adds_to_pair(std::string_view name) {
  return begins(name, "smlal") || begins(name, "umlal") || begins(name, "umaal") || begins(name, "smlsld");
}

bool uses_shifter(unsigned id) {
  switch (id) {
    case ARM_INS_LSL:
    case ARM_INS_LSR:
    case ARM_INS_ASR:
    case ARM_INS_ROR:
    case ARM_INS_RRX:
    case ARM_INS_UBFX:
    case ARM_INS_SBFX:
    case ARM_INS_BFI:
    case ARM_INS_UXTB:
    case ARM_INS_UXTH:
    case ARM_INS_SXTB:
    case ARM_INS_SXTH:
    case ARM_INS_SSAT:
    case ARM_INS_USAT:
      return true;
    default:
      return false;
  }
}

}  // namespace palpate::wcet
