// Damages an index pool from inside, to see its own check object.
#pragma once

#include "palpate/memory/index_pool.hpp"

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
  template <uint16_t Capacity>
  static uint16_t& used(IndexPool<Capacity>& pool) {
    return pool.used_;
  }
  template <uint16_t Capacity>
  static PoolCounters& counters(IndexPool<Capacity>& pool) {
    return pool.counters_;
  }
};

}  // namespace palpate
