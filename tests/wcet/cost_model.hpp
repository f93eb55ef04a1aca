// What instructions cost, read from a data file. Every model is a scoreboard: instructions issue in order,
// one at a time, and wait for their operands. A model without latencies just adds up.
#pragma once

#include <array>
#include <string>

#include "devices.hpp"
#include "flow_network.hpp"
#include "instruction.hpp"

namespace palpate::wcet {

struct CostRow {
  Cycles cycles = 0;     // until the next instruction may issue
  Cycles each = 0;       // more, for every register of a list
  Cycles each_pair = 0;  // more, for every two registers begun
  Cycles taken = 0;      // more, when the jump is taken
  Cycles indexed = 0;    // more, with an offset from a register
  // Of a single access right behind a single load whose result its address does not need; 0: as otherwise.
  Cycles behind_load = 0;
  // Further cycles until the result may be read plainly, for an address, and through the shifter.
  Cycles result = 0;
  Cycles address = 0;
  Cycles shift = 0;
};

/// What the processor thinks of a conditional branch.
enum class Predictor : uint8_t {
  kUnknown,  // it may be wrong every time
  kStatic    // backward is taken, forward is not
};

struct CostModel {
  std::string name;
  std::string unit;
  std::string description;
  std::array<CostRow, static_cast<size_t>(CostClass::kCount)> rows;
  Cycles store_to_load = 0;  // between a store and a load of the same word
  Cycles mispredicted = 0;
  Cycles interrupt_entry = 0;
  Cycles interrupt_exit = 0;
  // The board and its set-up.
  Predictor predictor = Predictor::kUnknown;
  Cycles wait_states = 0;  // of every 32-bit word fetched from code, without prefetch or cache
  Devices devices;

  [[nodiscard]] const CostRow& row(const Instruction& of) const { return rows[static_cast<size_t>(of.cost)]; }
};

/// `name`: of a model beside the program, or the path of a .toml file. Throws BadInput.
CostModel read_cost_model(const std::string& name);

/// Until the next instruction may issue. `before`: right before it in its block, or nothing.
Cycles issue_cycles(const CostModel& model, const Instruction* before, const Instruction& of);

/// Of leaving a block by its last instruction.
Cycles exit_cycles(const CostModel& model, const Instruction& last, bool taken);

}  // namespace palpate::wcet
