#include "compiled_stages.hpp"

namespace palpate {

PALPATE_STAGES(, CuboidPaper)
PALPATE_STAGES(, CuboidDense)
PALPATE_STAGES(, Organ)
PALPATE_STAGES(, Small)
PALPATE_STAGES(, Tiny)
PALPATE_STAGES(, Workstation)

}  // namespace palpate
