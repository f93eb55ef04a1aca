// Bounded loops. Every loop that a tick can reach is written as
//
//   for (const uint32_t leaf : bounded<kMaxLeaves>(leaf_count, [] {})) ...
//
// It runs min(count, Max) times, so Max is a fact and not a hope. On the target the range leaves two kinds of
// 16-byte records in the non-loaded section .wcet.flowfacts, each beside one real nop: {1, id, pc, Max} where
// the loop is entered and {2, id, pc, Max} in its body. In every function, the bodies run at most
// Max x entries times; that stays true when the compiler unrolls, peels or inlines.
// The empty lambda gives the loop its identity: its type is unique to this place in the source.
#pragma once

#include "palpate/numeric/check.hpp"
#include "palpate/numeric/platform.hpp"

namespace palpate {

/// Its address is the id of a loop's flow facts.
template <class Place, uint32_t Max>
inline constexpr char kLoopId = 0;

enum class FlowFact : uint32_t { kEnter = 1, kBody = 2 };

template <FlowFact Kind, class Place, uint32_t Max>
PALPATE_ALWAYS_INLINE void leave_flow_fact() {
#ifdef PALPATE_TARGET
  asm volatile(
      "1:\tnop\n\t"
      ".pushsection .wcet.flowfacts,\"?\",%%progbits\n\t"
      ".word %c0, %c1, 1b, %c2\n\t"
      ".popsection"
      :
      : "i"(static_cast<uint32_t>(Kind)), "i"(&kLoopId<Place, Max>), "i"(Max));
#endif
}

/// Goes through numbers, or through the elements of an array by their addresses.
template <uint32_t Max, class Place, class At>
class BoundedIterator {
 public:
  constexpr explicit BoundedIterator(At at) : at_(at) {}
  PALPATE_ALWAYS_INLINE At operator*() const {
    leave_flow_fact<FlowFact::kBody, Place, Max>();
    return at_;
  }
  constexpr BoundedIterator& operator++() {
    ++at_;
    return *this;
  }
  constexpr bool operator!=(BoundedIterator other) const { return at_ != other.at_; }

 private:
  At at_;
};

/// The numbers 0 .. min(count, Max) - 1, each visited once, in order.
template <uint32_t Max, class Place>
class BoundedRange {
 public:
  using Iterator = BoundedIterator<Max, Place, uint32_t>;

  constexpr explicit BoundedRange(uint32_t count) : count_(count < Max ? count : Max) {
    check(count <= Max, "a bounded loop was asked for more than its maximum");
  }
  [[nodiscard]] PALPATE_ALWAYS_INLINE Iterator begin() const {
    leave_flow_fact<FlowFact::kEnter, Place, Max>();
    return Iterator(0);
  }
  [[nodiscard]] constexpr Iterator end() const { return Iterator(count_); }

 private:
  uint32_t count_;
};

template <uint32_t Max, class Place>
constexpr BoundedRange<Max, Place> bounded(uint32_t count, Place) {
  return BoundedRange<Max, Place>(count);
}

/// What nested loops may do together: all loops over ranges taken from one BoundedTotal run at most Max times
/// in all, as leaves of groups do whatever group they are in. Its flow fact is entered where the total is
/// made. A function that makes a total takes from no other one of the same place: what it makes is all that
/// its flow facts can tell.
template <uint32_t Max, class Place>
class BoundedTotal {
 public:
  template <class At>
  class Range {
   public:
    using Iterator = BoundedIterator<Max, Place, At>;
    constexpr Range(At first, uint32_t count) : first_(first), end_(first + count) {}
    [[nodiscard]] constexpr Iterator begin() const { return Iterator(first_); }
    [[nodiscard]] constexpr Iterator end() const { return Iterator(end_); }

   private:
    At first_, end_;
  };

  PALPATE_ALWAYS_INLINE explicit BoundedTotal(Place) : left_(Max) {
    leave_flow_fact<FlowFact::kEnter, Place, Max>();
  }
  /// first .. first + count - 1, cut where the total ends.
  [[nodiscard]] constexpr Range<uint32_t> take(uint32_t first, uint32_t count) {
    return Range<uint32_t>(first, grant(count));
  }
  /// The same of an array's elements, by their addresses: the loop needs no counter beside its pointer.
  template <class Element>
  [[nodiscard]] constexpr Range<Element*> take(Element* first, uint32_t count) {
    return Range<Element*>(first, grant(count));
  }
  [[nodiscard]] constexpr uint32_t left() const { return left_; }
  /// Counts so many off, as take does; for a range that the called function makes.
  [[nodiscard]] constexpr uint32_t grant(uint32_t count) {
    check(count <= left_, "nested loops were asked for more than their total");
    const uint32_t granted = count < left_ ? count : left_;
    left_ -= granted;
    return granted;
  }

 private:
  uint32_t left_;
};

template <uint32_t Max, class Place>
PALPATE_ALWAYS_INLINE BoundedTotal<Max, Place> bounded_total(Place place) {
  return BoundedTotal<Max, Place>(place);
}

}  // namespace palpate
