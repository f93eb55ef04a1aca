// What the background prints, as comma-separated lines that start with their kind:
//   stages,<name>,...                        once, the stages in the order of the hash columns
//   hash,<tick>,<hex of each stage>,<hex>    state hashes after this many ticks; the last one is over all
//   broken,<tick>,<mesh>,<front>,<tethers>   what no longer holds (Violation, FrontViolation, 1: tethers
//                                            hold); a script stops here and fails, a device goes on in Fault
//   pool,<name>,<peak>,<capacity>,<refused>  at the end, of each pool
//   summary,<key>,<value>                    at the end
//   refused,<what>,<status>,<place>          a device without a model: container (ReadStatus, byte), model
//                                            (Status) or parameters
//   end                                      the run is complete
#pragma once

#include "palpate/firmware/condition.hpp"
#include "run.hpp"

namespace palpate::firmware {

void print_stage_names();
void print_hash_row(const Run& run);
void print_broken(uint32_t tick, const Integrity& integrity);
void print_pools(const Run& run);
void print_summary(const Run& run, const char* scenario);

}  // namespace palpate::firmware
