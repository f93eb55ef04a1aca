// Registers of the Cortex-M system space (Armv7-M Architecture Reference Manual, chapters B3 and C1), as far
// as they are used here.
#pragma once

#include "register.hpp"

namespace palpate::cortex_m {

using AuxiliaryControl = Register<0xE000'E008>;  // ACTLR
using SysTickControl = Register<0xE000'E010>;    // SYST_CSR, B3.3.3
using SysTickReload = Register<0xE000'E014>;     // SYST_RVR: 24 bits
using SysTickValue = Register<0xE000'E018>;      // SYST_CVR: any write clears it
using NvicSetEnable = Register<0xE000'E100>;
using NvicClearPending = Register<0xE000'E280>;
using InterruptControl = Register<0xE000'ED04>;  // ICSR, B3.2.4
using VectorTableOffset = Register<0xE000'ED08>;
using ConfigurationControl = Register<0xE000'ED14>;  // CCR, B3.2.8
using ConfigurableFaultStatus = Register<0xE000'ED28>;
using HardFaultStatus = Register<0xE000'ED2C>;
using MemoryFaultAddress = Register<0xE000'ED34>;
using BusFaultAddress = Register<0xE000'ED38>;
using MpuControl = Register<0xE000'ED94>;  // B3.5
using MpuRegionNumber = Register<0xE000'ED98>;
using MpuRegionBase = Register<0xE000'ED9C>;
using MpuRegionAttributes = Register<0xE000'EDA0>;
using DebugControl = Register<0xE000'EDFC>;  // DEMCR, C1.6.5

using DwtControl = Register<0xE000'1000>;  // C1.8.7
using DwtCycleCount = Register<0xE000'1004>;
using DwtLockAccess = Register<0xE000'1FB0>;  // on a Cortex-M7 the unit is locked for software at reset

}  // namespace palpate::cortex_m
