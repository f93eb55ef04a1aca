// Accesses to device registers, which take longer than those to memory.
//
// Where the code shows the address of an access, or of the object that an index goes into, that decides. The
// contract for the rest: only ports access registers, and a port's function holds the address, or one near
// it, as a constant. Then every access of that function whose address is not shown may be one. Stack and
// literals are none, and what a function is handed is no register's address.
#pragma once

#include <string>
#include <vector>

#include "control_flow.hpp"
#include "flow_network.hpp"

namespace palpate::wcet {

class CallGraph;

struct DeviceRange {
  std::string name;
  uint32_t first = 0;
  uint32_t last = 0;
  Cycles cycles = 0;  // more, for each access

  [[nodiscard]] bool holds(int64_t address) const { return first <= address && address <= last; }
};

/// What a port's header allows one call to do, and where this board's registers for it are.
struct PortContract {
  std::string function;
  uint32_t accesses = 0;  // at most
  Cycles cycles = 0;      // more, for each of them
};

struct Devices {
  std::vector<DeviceRange> ranges;
  std::vector<std::string> ports;  // parts of the names of functions
  std::vector<PortContract> contracts;
};

/// Throws BadInput.
Devices read_devices(const std::string& path);

/// By block.
std::vector<Cycles> device_cycles(const Devices& devices, const FunctionGraph& graph);

/// A loop that reads a device register waits for a device, whatever its flow fact says. Throws Refusal.
void refuse_polling(const Program& program, const CallGraph& calls, const Devices& devices);

}  // namespace palpate::wcet
