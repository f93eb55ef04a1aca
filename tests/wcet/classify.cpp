#include "classify.hpp"

#include <algorithm>
#include <iterator>

#include "instruction_kind.hpp"

namespace palpate::wcet {
namespace {

constexpr uint8_t kNoRegister = 16;

uint8_t number_of(int reg) {
  constexpr int kNumbers[] = {ARM_REG_R0,  ARM_REG_R1, ARM_REG_R2, ARM_REG_R3, ARM_REG_R4,  ARM_REG_R5,
                              ARM_REG_R6,  ARM_REG_R7, ARM_REG_R8, ARM_REG_R9, ARM_REG_R10, ARM_REG_R11,
                              ARM_REG_R12, ARM_REG_SP, ARM_REG_LR, ARM_REG_PC};
  const auto* found = std::find(std::begin(kNumbers), std::end(kNumbers), reg);
  return static_cast<uint8_t>(found - std::begin(kNumbers));  // status registers: kNoRegister
}

class Classifier {
 public:
  explicit Classifier(const cs_insn& from) : from_(from), arm_(from.detail->arm), kind_(kind_of(from.id)) {
    out_.address = static_cast<uint32_t>(from.address);
    out_.size = static_cast<uint8_t>(from.size);
    out_.text = std::string(from.mnemonic) + (from.op_str[0] == 0 ? "" : " ") + from.op_str;
    out_.is_nop = from.id == ARM_INS_NOP;
    // The condition of an IT is that of its block; it is itself executed always.
    out_.is_conditional = arm_.cc != ARM_CC_AL && arm_.cc != ARM_CC_INVALID && from.id != ARM_INS_IT;
    out_.cost = is_multiply(from.mnemonic) ? CostClass::kMultiply : kind_.cost;
  }

  Instruction run() {
    for (uint8_t i = 0; i < arm_.op_count; ++i) add_operand(i);
    if (adds_to_pair(from_.mnemonic)) out_.reads |= out_.writes;
    add_list();
    add_assignment();
    add_flow();
    return out_;
  }

 private:
  [[nodiscard]] const cs_arm_op& operand(uint8_t i) const { return arm_.operands[i]; }
  [[nodiscard]] bool is_register(uint8_t i) const {
    return i < arm_.op_count && operand(i).type == ARM_OP_REG;
  }
  [[nodiscard]] bool is_constant(uint8_t i) const {
    return i < arm_.op_count && operand(i).type == ARM_OP_IMM;
  }

  void add_operand(uint8_t i) {
    const cs_arm_op& op = operand(i);
    if (op.type == ARM_OP_MEM) return add_memory(i);
    if (op.type != ARM_OP_REG) return;
    const uint8_t number = number_of(op.reg);
    if (number == kNoRegister) return;
    if ((op.access & CS_AC_WRITE) != 0) out_.writes |= only(number);
    if (op.access != CS_AC_WRITE) {
      const bool shifted = op.shift.type != ARM_SFT_INVALID || (uses_shifter(from_.id) && i > 0);
      (shifted ? out_.shifted_reads : out_.reads) |= only(number);
    }
    if (op.shift.type >= ARM_SFT_ASR_REG) {
      const uint8_t by = number_of(static_cast<int>(op.shift.value));
      if (by != kNoRegister) out_.shifted_reads |= only(by);
    }
  }

  void add_memory(uint8_t i) {
    const arm_op_mem& memory = operand(i).mem;
    const uint8_t base = number_of(static_cast<int>(memory.base));
    const bool has_index = memory.index != ARM_REG_INVALID;
    out_.address_reads |= only(base);
    if (has_index) out_.address_reads |= only(number_of(static_cast<int>(memory.index)));
    if (kind_.bytes == 0) return;
    const bool is_pair = from_.id == ARM_INS_LDRD || from_.id == ARM_INS_STRD;
    out_.transfers = is_pair ? 2 : 1;
    out_.memory = MemoryAccess{kind_.is_store, base, has_index, memory.disp, kind_.bytes * out_.transfers};
    if (base == kPc) out_.cost = CostClass::kLoadLiteral;
    if (!arm_.writeback) return;
    // "[r1], #4" has the step as a further operand, "[r1, #4]!" as its offset.
    const bool is_after = is_constant(static_cast<uint8_t>(i + 1));
    const int32_t step = is_after ? operand(static_cast<uint8_t>(i + 1)).imm : memory.disp;
    out_.writes |= only(base);
    out_.writeback = Assignment{Assignment::Kind::kSum, base, base, step};
  }

  // push, pop, ldm, stm: a base and a list.
  void add_list() {
    if (kind_.bytes == 0 || out_.memory) return;
    const bool on_stack = from_.id == ARM_INS_PUSH || from_.id == ARM_INS_POP;
    const uint8_t base = on_stack ? kSp : number_of(operand(0).reg);
    out_.transfers = static_cast<uint8_t>(on_stack ? arm_.op_count : arm_.op_count - 1);
    const auto bytes = static_cast<int32_t>(out_.transfers) * 4;
    const bool down = from_.id == ARM_INS_PUSH || from_.id == ARM_INS_STMDB || from_.id == ARM_INS_LDMDB;
    out_.reads = static_cast<RegisterSet>(out_.reads & ~only(base));
    out_.address_reads |= only(base);
    out_.memory = MemoryAccess{kind_.is_store, base, false, down ? -bytes : 0, static_cast<uint32_t>(bytes)};
    if (on_stack || arm_.writeback) {
      out_.writes |= only(base);
      out_.writeback = Assignment{Assignment::Kind::kSum, base, base, down ? -bytes : bytes};
    }
  }

  void add_assignment() {
    if (!is_register(0) || out_.memory || out_.is_conditional) return;
    const uint8_t destination = number_of(operand(0).reg);
    const auto id = from_.id;
    if ((id == ARM_INS_MOV || id == ARM_INS_MOVW) && is_constant(1)) {
      out_.assignment = Assignment{Assignment::Kind::kConstant, destination, 0, operand(1).imm};
    } else if (id == ARM_INS_ADR && is_constant(1)) {
      add_address(destination, operand(1).imm);
    } else if (id == ARM_INS_MOVT && is_constant(1)) {
      out_.assignment = Assignment{Assignment::Kind::kUpperHalf, destination, destination, operand(1).imm};
    } else if (id == ARM_INS_MOV && is_register(1) && operand(1).shift.type == ARM_SFT_INVALID) {
      out_.assignment = Assignment{Assignment::Kind::kSum, destination, number_of(operand(1).reg), 0};
    } else if (id == ARM_INS_ADD || id == ARM_INS_ADDW || id == ARM_INS_SUB || id == ARM_INS_SUBW) {
      const bool with_source = is_register(1) && is_constant(2);
      if (!with_source && !is_constant(1)) return;
      const int32_t value = operand(with_source ? 2 : 1).imm;
      const bool minus = id == ARM_INS_SUB || id == ARM_INS_SUBW;
      if (with_source && number_of(operand(1).reg) == kPc)
        return add_address(destination, minus ? -value : value);
      out_.assignment =
          Assignment{Assignment::Kind::kSum, destination,
                     with_source ? number_of(operand(1).reg) : destination, minus ? -value : value};
    }
  }

  // Relative to pc, which is 4 ahead and is taken at a whole word.
  void add_address(uint8_t destination, int32_t offset) {
    const auto pc = static_cast<int32_t>((out_.address + 4) & ~3u);
    out_.assignment = Assignment{Assignment::Kind::kConstant, destination, 0, pc + offset};
  }

  void jump(Flow flow, CostClass cost, uint8_t target_operand) {
    out_.flow = flow;
    out_.cost = cost;
    out_.target = static_cast<uint32_t>(operand(target_operand).imm);
  }

  void add_flow() {
    switch (from_.id) {
      case ARM_INS_B:
        return jump(Flow::kJump, out_.is_conditional ? CostClass::kConditionalBranch : CostClass::kBranch, 0);
      case ARM_INS_CBZ:
      case ARM_INS_CBNZ:
        out_.is_conditional = true;
        return jump(Flow::kJump, CostClass::kConditionalBranch, 1);
      case ARM_INS_BL:
        return jump(Flow::kCall, CostClass::kCall, 0);
      case ARM_INS_TBB:
      case ARM_INS_TBH:
        out_.flow = Flow::kTable;
        out_.cost = CostClass::kTableBranch;
        return;
      case ARM_INS_BX:
        out_.flow = number_of(operand(0).reg) == kLr ? Flow::kReturn : Flow::kIndirectJump;
        out_.cost = CostClass::kBranchRegister;
        return;
      case ARM_INS_BLX:
        out_.flow = Flow::kIndirectCall;
        out_.cost = CostClass::kBranchRegister;
        return;
      case ARM_INS_UDF:
        out_.flow = Flow::kTrap;
        return;
      case ARM_INS_WFI:
      case ARM_INS_WFE:
      case ARM_INS_SVC:
      case ARM_INS_BKPT:
        out_.flow = Flow::kWait;
        return;
      default:
        break;
    }
    if (from_.mnemonic[0] == 'v') out_.flow = Flow::kFloat;
    if (has(out_.writes, kPc)) add_write_of_pc();
  }

  // Only a return takes pc from the stack or from lr.
  void add_write_of_pc() {
    const bool from_stack = out_.memory && out_.memory->base == kSp && !out_.memory->has_index;
    const bool from_lr = from_.id == ARM_INS_MOV && is_register(1) && number_of(operand(1).reg) == kLr;
    out_.flow = from_stack || from_lr ? Flow::kReturn : Flow::kIndirectJump;
    out_.cost = out_.memory ? CostClass::kLoadPc : CostClass::kBranchRegister;
  }

  const cs_insn& from_;
  const cs_arm& arm_;
  InstructionKind kind_;
  Instruction out_;
};

}  // namespace

Instruction classify(const cs_insn& from) { return Classifier(from).run(); }

}  // namespace palpate::wcet
