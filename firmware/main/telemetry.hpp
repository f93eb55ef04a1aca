// What the background prints, as comma-separated lines that start with their kind:
//   stages,<name>,...                        once, the stages in the order of the hash columns
//   hash,<tick>,<hex of each stage>,<hex>    state hashes after this many ticks; the last one is over all
//   summary,<key>,<value>                    at the end
//   end                                      the run is complete
#pragma once

#include "run.hpp"

namespace palpate::firmware {

void print_stage_names();
void print_hash_row(const Run& run);
void print_summary(const Run& run);

}  // namespace palpate::firmware
