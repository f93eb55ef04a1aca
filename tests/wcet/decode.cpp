#include "decode.hpp"

#include <capstone/capstone.h>

#include <algorithm>
#include <stdexcept>

#include "classify.hpp"

namespace palpate::wcet {
namespace {

class Disassembler {
 public:
  Disassembler() {
    constexpr auto kMode = static_cast<cs_mode>(CS_MODE_THUMB | CS_MODE_MCLASS);
    if (cs_open(CS_ARCH_ARM, kMode, &handle_) != CS_ERR_OK) throw std::runtime_error("Capstone knows no Arm");
    cs_option(handle_, CS_OPT_DETAIL, CS_OPT_ON);
  }
  ~Disassembler() { cs_close(&handle_); }
  Disassembler(const Disassembler&) = delete;
  Disassembler(Disassembler&&) = delete;
  Disassembler& operator=(const Disassembler&) = delete;
  Disassembler& operator=(Disassembler&&) = delete;

  /// As far as it goes. One run, so that Capstone follows IT blocks. Returns the first address that is left.
  uint32_t run(const uint8_t* bytes, size_t size, uint32_t address, std::map<uint32_t, Instruction>& out) {
    cs_insn* found = nullptr;
    const size_t count = cs_disasm(handle_, bytes, size, address, 0, &found);
    for (size_t i = 0; i < count; ++i) {
      const Instruction instruction = classify(found[i]);
      out[instruction.address] = instruction;
      address = instruction.next();
    }
    if (count > 0) cs_free(found, count);
    return address;
  }

 private:
  csh handle_ = 0;
};

// What a literal gives its register is known: it lies in code.
void resolve_literals(const ElfImage& image, std::map<uint32_t, Instruction>& code) {
  for (auto& [address, instruction] : code) {
    const bool is_word = instruction.cost == CostClass::kLoadLiteral && !instruction.memory->has_index &&
                         instruction.memory->bytes == 4 && !instruction.is_conditional;
    if (!is_word) continue;
    const uint32_t at = ((address + 4) & ~3u) + static_cast<uint32_t>(instruction.memory->offset);
    const std::optional<uint32_t> value = image.read(at, 4);
    const auto destination = lowest_of(instruction.writes);
    if (!value) continue;
    instruction.assignment =
        Assignment{Assignment::Kind::kConstant, destination, 0, static_cast<int32_t>(*value)};
  }
}

Instruction undecodable(const uint8_t* bytes, uint32_t address) {
  Instruction instruction;
  instruction.address = address;
  // 32-bit encodings start with 11101, 11110 or 11111 (Armv7-M manual, A5.1).
  instruction.size = bytes[1] >= 0xe8 ? 4 : 2;
  instruction.flow = Flow::kUndecodable;
  return instruction;
}

}  // namespace

std::map<uint32_t, Instruction> decode(const ElfImage& image) {
  Disassembler disassembler;
  std::map<uint32_t, Instruction> code;
  for (const Section& section : image.sections()) {
    if (!section.loaded || !section.executable || section.bytes.empty()) continue;
    const uint32_t end = section.address + static_cast<uint32_t>(section.bytes.size());
    for (uint32_t at = section.address; at < end;) {
      const uint32_t stretch_end = std::min(image.stretch_end(at), end);
      if (!image.is_code(at)) {
        at = stretch_end;
        continue;
      }
      const uint8_t* bytes = section.bytes.data() + (at - section.address);
      at = disassembler.run(bytes, stretch_end - at, at, code);
      if (at + 1 < stretch_end) {
        code[at] = undecodable(section.bytes.data() + (at - section.address), at);
        at = code[at].next();
      } else {
        at = stretch_end;
      }
    }
  }
  resolve_literals(image, code);
  return code;
}

}  // namespace palpate::wcet
