// Damages a pool from inside, to see its own check object.
#pragma once

#include "palpate/mesh/sibling_pairs.hpp"

namespace palpate {

struct PoolCorruptor {
  template <uint16_t Capacity>
  static uint16_t& order(IndexPool<Capacity>& pool, uint32_t i) {
    return pool.order_[i];
  }
  template <uint16_t Capacity>
  static uint16_t& place(IndexPool<Capacity>& pool, uint32_t i) {
    return pool.place_[i];
  }
  /// Of a free pair: the next one.
  template <uint16_t Capacity>
  static uint16_t& parent(SiblingPairs<Capacity>& pairs, uint32_t i) {
    return pairs.parent_or_next_[i];
  }
  template <uint16_t Capacity>
  static uint8_t& level(SiblingPairs<Capacity>& pairs, uint32_t i) {
    return pairs.level_[i];
  }
  template <class Pool>
  static uint16_t& used(Pool& pool) {
    return pool.used_;
  }
  template <class Pool>
  static PoolCounters& counters(Pool& pool) {
    return pool.counters_;
  }
};

}  // namespace palpate
