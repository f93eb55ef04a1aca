#include "alignment.hpp"

#include "register_values.hpp"

namespace palpate::wcet {
namespace {

constexpr uint32_t kTagFile = 1;
constexpr uint32_t kTagRawName = 4;
constexpr uint32_t kTagName = 5;
constexpr uint32_t kTagCompatibility = 32;
constexpr uint32_t kTagUnalignedAccess = 34;

// Section .ARM.attributes: a letter, then parts {size, vendor, {tag, size, attributes}...}; of tags above 32
// the odd ones are strings.
class Attributes {
 public:
  explicit Attributes(const std::vector<uint8_t>& bytes) : bytes_(bytes) {}

  [[nodiscard]] bool allow_unaligned_access() {
    at_ = 1 + sizeof(uint32_t);
    skip_string();
    if (number() != kTagFile) return false;
    at_ += sizeof(uint32_t);
    bool allowed = false;
    while (at_ < bytes_.size()) {
      const uint32_t tag = number();
      if (tag == kTagCompatibility) number();
      const bool is_string = tag == kTagRawName || tag == kTagName || tag == kTagCompatibility ||
                             (tag > kTagCompatibility && tag % 2 != 0);
      if (is_string) {
        skip_string();
      } else if (const uint32_t value = number(); tag == kTagUnalignedAccess) {
        allowed = value != 0;
      }
    }
    return allowed;
  }

 private:
  void skip_string() {
    while (at_ < bytes_.size() && bytes_[at_] != 0) ++at_;
    ++at_;
  }

  // ULEB128
  uint32_t number() {
    uint32_t value = 0;
    for (uint32_t shift = 0; at_ < bytes_.size(); shift += 7) {
      const uint8_t byte = bytes_[at_++];
      value |= static_cast<uint32_t>(byte & 0x7f) << shift;
      if ((byte & 0x80) == 0) break;
    }
    return value;
  }

  const std::vector<uint8_t>& bytes_;
  size_t at_ = 0;
};

// sp is always a multiple of four.
bool is_unaligned(const Instruction& at, const RegisterValues& values) {
  const MemoryAccess& access = *at.memory;
  const uint32_t size = at.transfers == 0 ? access.bytes : access.bytes / at.transfers;
  if (size < 2 || access.has_index) return false;
  if (access.base == kSp) return access.offset % static_cast<int32_t>(size) != 0;
  const std::optional<AddressRange> where = values.range_of(at);
  return access.base != kPc && where && where->symbol == 0 && where->offset % size != 0;
}

}  // namespace

void refuse_unaligned(const Program& program, const CallGraph& calls) {
  const Section* attributes = program.image().find_section(".ARM.attributes");
  if (attributes != nullptr && Attributes(attributes->bytes).allow_unaligned_access()) {
    throw Refusal(program.place(calls.functions().back().entry),
                  "compiled with unaligned accesses allowed; -mno-unaligned-access is missing");
  }
  for (const FunctionGraph& graph : calls.functions()) {
    for (const Block& block : graph.blocks) {
      RegisterValues values;
      for (const Instruction* at : block.code) {
        if (at->memory && is_unaligned(*at, values))
          throw Refusal(program.place(at->address), "an unaligned access, " + at->text);
        values.execute(*at);
      }
    }
  }
}

}  // namespace palpate::wcet
