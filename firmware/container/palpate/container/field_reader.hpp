// Takes the fields of a payload one after the other, each with its name and its range. The first one that is
// out of its range, or beyond the payload, is what finish() returns; those after it are left as they are.
// Has the same calls as FieldWriter, so that one function can describe a payload to both.
#pragma once

#include "palpate/container/chunk_reader.hpp"
#include "palpate/numeric/q.hpp"

namespace palpate::container {

class FieldReader {
 public:
  explicit FieldReader(const Chunk& chunk) : chunk_(chunk), finding_(Finding::nothing()) {}

  /// Any integer of 8, 16 or 32 bits, or a u64 or i64 of any value.
  template <class Integer>
  void number(const char* name, Integer& value,
              std::common_type_t<Integer> least = std::numeric_limits<Integer>::min(),
              std::common_type_t<Integer> most = std::numeric_limits<Integer>::max()) {
    if (!has(sizeof(Integer))) return;
    const auto found = get<Integer>(chunk_.payload.data + at_);
    if (found < least || found > most) {
      return refuse(name, static_cast<int64_t>(least), static_cast<int64_t>(most),
                    static_cast<int64_t>(found));
    }
    at_ += static_cast<uint32_t>(sizeof(Integer));
    value = found;
  }
  /// An enum of 8 bits whose values are 0 .. last.
  template <class Enum>
  void choice(const char* name, Enum& value, Enum last) {
    static_assert(sizeof(Enum) == 1, "palpate: enums are stored in one byte");
    uint8_t found = 0;
    number<uint8_t>(name, found, 0, static_cast<uint8_t>(last));
    if (finding_.is_done()) value = static_cast<Enum>(found);
  }
  /// The raw value of a fixed-point number, 32 bits; its format belongs to the chunk's version.
  template <int I, int F>
  void fixed(const char* name, Q<I, F>& value, Q<I, F> least = Q<I, F>::min(),
             Q<I, F> most = Q<I, F>::max()) {
    int32_t raw = value.raw();
    number(name, raw, least.raw(), most.raw());
    if (finding_.is_done()) value = Q<I, F>::from_raw(raw);
  }
  template <int I, int F, std::size_t Count>
  void fixed_array(const char* name, std::array<Q<I, F>, Count>& values, Q<I, F> least = Q<I, F>::min(),
                   Q<I, F> most = Q<I, F>::max()) {
    for (const uint32_t i : bounded<Count>(Count, [] {})) fixed(name, values[i], least, most);
  }
  /// Some of a set of up to 32 bits, stored as an integer of this size.
  template <class Integer, class Set>
  void bits(const char* name, Set& set, Integer most) {
    Integer found = 0;
    number<Integer>(name, found, 0, most);
    if (finding_.is_done()) set = Set::of_bits(found);
  }
  /// A byte that is 0 or 1.
  void truth(const char* name, bool& value) {
    uint8_t found = 0;
    number<uint8_t>(name, found, 0, 1);
    if (finding_.is_done()) value = found != 0;
  }
  /// Bytes without a meaning yet, 0 to 7.
  void zeros(uint32_t count) {
    for ([[maybe_unused]] const uint32_t i : bounded<7>(count, [] {})) {
      uint8_t zero = 0;
      number<uint8_t>("reserved", zero, 0, 0);
    }
  }

  /// Every field so far was right.
  [[nodiscard]] bool is_right() const { return finding_.is_done(); }
  /// kDone when every field was right and none is left over.
  [[nodiscard]] Finding finish() const {
    if (!finding_.is_done() || at_ == chunk_.payload.size) return finding_;
    return Finding::at(ReadStatus::kWrongLength, chunk_.offset, chunk_.tag, at_, chunk_.payload.size);
  }

 private:
  [[nodiscard]] bool has(uint32_t size) {
    if (!finding_.is_done()) return false;
    if (chunk_.payload.size - at_ >= size) return true;
    finding_ = Finding::at(ReadStatus::kWrongLength, chunk_.offset, chunk_.tag, int64_t{at_} + size,
                           chunk_.payload.size);
    return false;
  }
  void refuse(const char* name, int64_t least, int64_t most, int64_t found) {
    finding_ =
        Finding{ReadStatus::kOutOfRange, chunk_.payload_offset() + at_, chunk_.tag, name, least, most, found};
  }

  Chunk chunk_;
  uint32_t at_ = 0;
  Finding finding_;
};

}  // namespace palpate::container
