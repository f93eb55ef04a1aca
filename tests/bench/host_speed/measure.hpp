// What the host-speed program measures.
#pragma once

#include "report.hpp"

namespace palpate::bench {

using Show = std::function<void(const std::string&)>;  // is told what is being done

/// At 1152 tets: rows, goals and whether both builds of the core make the same bits.
void measure_bar(uint32_t rounds, const Show& show, Report& report);

/// At 288 to 9216 tets: costs.
void measure_sizes(uint32_t rounds, const Show& show, Report& report);

}  // namespace palpate::bench
