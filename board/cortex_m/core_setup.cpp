#include "core_setup.hpp"

#include "startup.hpp"
#include "system_registers.hpp"

namespace palpate::cortex_m {

void trap_mistakes() {
  constexpr uint32_t kTrapUnaligned = 1u << 3;
  constexpr uint32_t kTrapDivisionByZero = 1u << 4;
  ConfigurationControl::set(kTrapUnaligned | kTrapDivisionByZero);
  // One region of the memory protection unit: below the stack no access at all.
  constexpr uint32_t kSizeShift = 1;  // log2(size) - 1, in bits 5 to 1
  constexpr uint32_t kNeverExecute = 1u << 28;
  constexpr uint32_t kEnable = 1u << 0;
  constexpr uint32_t kDefaultMapElsewhere = 1u << 2;
  const auto size_log2 = static_cast<uint32_t>(reinterpret_cast<uintptr_t>(palpate_guard_size_log2));
  MpuRegionNumber::write(0);
  MpuRegionBase::write(static_cast<uint32_t>(reinterpret_cast<uintptr_t>(palpate_guard_start)));
  MpuRegionAttributes::write(kNeverExecute | ((size_log2 - 1) << kSizeShift) | kEnable);
  MpuControl::write(kEnable | kDefaultMapElsewhere);
  synchronize();
}

void disable_branch_cache() {
  constexpr uint32_t kDisableBtacRead = 1u << 13;  // Cortex-M7 TRM, 3.3.1: ACTLR.DISBTACREAD
  AuxiliaryControl::set(kDisableBtacRead);
  synchronize();
}

void start_cycle_counter() {
  constexpr uint32_t kTraceEnable = 1u << 24;  // DEMCR.TRCENA
  constexpr uint32_t kUnlock = 0xC5AC'CE55;
  constexpr uint32_t kCount = 1u << 0;  // DWT_CTRL.CYCCNTENA
  DebugControl::set(kTraceEnable);
  DwtLockAccess::write(kUnlock);
  DwtCycleCount::write(0);
  DwtControl::set(kCount);
}

}  // namespace palpate::cortex_m
