// Puts the fields of a payload one after the other. Has the calls of FieldReader; names and ranges are the
// reader's matter.
#pragma once

#include "palpate/container/chunk_writer.hpp"
#include "palpate/numeric/q.hpp"

namespace palpate::container {

template <class Sink>
class FieldWriter {
 public:
  explicit FieldWriter(ChunkWriter<Sink>& writer) : writer_(writer) {}

  template <class Integer>
  void number(const char*, Integer value, std::common_type_t<Integer> = {},
              std::common_type_t<Integer> = {}) {
    uint8_t bytes[sizeof(Integer)]{};
    container::put(bytes, value);
    writer_.put(Bytes{bytes, static_cast<uint32_t>(sizeof(Integer))});
  }
  template <class Enum>
  void choice(const char* name, Enum value, Enum) {
    number(name, static_cast<uint8_t>(value));
  }
  template <int I, int F>
  void fixed(const char* name, Q<I, F> value, Q<I, F> = {}, Q<I, F> = {}) {
    number(name, value.raw());
  }
  template <int I, int F, std::size_t Count>
  void fixed_array(const char* name, const std::array<Q<I, F>, Count>& values, Q<I, F> = {}, Q<I, F> = {}) {
    for (const uint32_t i : bounded<Count>(Count, [] {})) fixed(name, values[i]);
  }
  template <class Integer, class Set>
  void bits(const char* name, Set set, Integer) {
    number(name, static_cast<Integer>(set.bits()));
  }
  void truth(const char* name, bool value) { number(name, static_cast<uint8_t>(value ? 1 : 0)); }
  void zeros(uint32_t count) {
    for ([[maybe_unused]] const uint32_t i : bounded<7>(count, [] {})) number("reserved", uint8_t{0});
  }

 private:
  ChunkWriter<Sink>& writer_;
};

}  // namespace palpate::container
