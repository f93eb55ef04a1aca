// What the processor reads at reset, where the memories that a program runs from are still empty.
#include "startup.hpp"

extern "C" [[noreturn]] void palpate_reset_handler();

namespace palpate::device {
namespace {

struct BootVectors {
  uint32_t* stack_top;
  void (*reset)();
};

[[gnu::used, gnu::section(".boot_vectors")]] constexpr BootVectors kBootVectors{palpate_stack_top,
                                                                                palpate_reset_handler};

}  // namespace
}  // namespace palpate::device
