#include "registers.hpp"

namespace palpate::mps2 {

void initialize_core() {
  // Static branch prediction: the model behind the timing bound knows no branch target cache.
  constexpr uint32_t kDisableBtacRead = 1u << 13;
  AuxiliaryControl::write(AuxiliaryControl::read() | kDisableBtacRead);
  synchronize();
}

}  // namespace palpate::mps2
