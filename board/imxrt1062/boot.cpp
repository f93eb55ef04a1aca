// What the boot ROM reads from the flash, and the first instructions (IMXRT1060RM, chapter System Boot).
#include "palpate/numeric/platform.hpp"

extern "C" {
extern const uint8_t palpate_image_bytes[];
[[noreturn]] void palpate_divide_memory();
}

namespace palpate::imxrt {
namespace {

constexpr uint32_t kFlashStart = 0x6000'0000;

/// Serial NOR configuration block: 512 bytes at the flash's start. What is not named here is 0.
struct FlashSettings {
  uint32_t tag = 0x4246'4346;  // "FCFB"
  uint32_t version = 0x5601'0000;
  uint32_t reserved_8 = 0;
  uint32_t sampling = 0x0003'0301;  // hold and setup 3 cycles; the strobe comes back from its pad
  std::array<uint32_t, 13> reserved_10{};
  uint32_t device = 0x0008'0401;  // serial NOR on four lines at 133 MHz
  std::array<uint32_t, 2> reserved_48{};
  uint32_t flash_bytes = 8 * 1024 * 1024;
  std::array<uint32_t, 11> reserved_54{};
  std::array<uint32_t, 64> sequences{};  // four words each
  std::array<uint32_t, 16> reserved_180{};
  uint32_t page_bytes = 256;
  uint32_t sector_bytes = 4096;
  uint32_t command_clock = 1;  // 30 MHz
  uint32_t reserved_1cc = 0;
  uint32_t block_bytes = 64 * 1024;
  std::array<uint32_t, 11> reserved_1d4{};
};
static_assert(sizeof(FlashSettings) == 512);

constexpr FlashSettings make_flash_settings() {
  FlashSettings settings;
  const auto set = [&settings](uint32_t sequence, uint32_t word_0, uint32_t word_1, uint32_t word_2) {
    settings.sequences[4 * sequence] = word_0;
    settings.sequences[4 * sequence + 1] = word_1;
    settings.sequences[4 * sequence + 2] = word_2;
  };
  // Read: 0xEB, 24 address bits on four lines; mode bits 0xF0 (none follows without its command), four cycles
  // of nothing; data on four lines.
  set(0, 0x0A18'04EB, 0x3204'1EF0, 0x0000'2604);
  set(1, 0x2404'0405, 0, 0);            // status
  set(3, 0x0000'0406, 0, 0);            // write enable
  set(5, 0x0818'0420, 0, 0);            // erase a sector
  set(8, 0x0818'04D8, 0, 0);            // erase a block
  set(9, 0x0818'0402, 0x0000'2004, 0);  // program a page
  set(11, 0x0000'0460, 0, 0);           // erase all
  return settings;
}

[[gnu::used, gnu::section(".boot_flash_settings")]] constexpr FlashSettings kFlashSettings =
    make_flash_settings();

struct ImageVectorTable {
  uint32_t header;
  void (*entry)();
  uint32_t reserved;
  uint32_t device_configuration;
  const void* boot_data;
  const void* self;
  uint32_t signature;
  uint32_t reserved_end;
  uint32_t image_start;  // the boot data
  const void* image_bytes;
  uint32_t is_plugin;
};

extern const ImageVectorTable kImageVectorTable;
[[gnu::used, gnu::section(".boot_image_vector_table")]] constexpr ImageVectorTable kImageVectorTable{
    0x4320'00D1,  // tag D1, 32 bytes, version 4.3
    palpate_divide_memory, 0, 0, &kImageVectorTable.image_start, &kImageVectorTable, 0, 0, kFlashStart,
    palpate_image_bytes,   0};

}  // namespace
}  // namespace palpate::imxrt

/// Divides the FlexRAM's 16 banks of 32 KB: 4 for the ITCM, 12 for the DTCM (IOMUXC_GPR_GPR17: a bank has two
/// bits, 11 and 10), both units open for 512 KB (GPR14), and this division instead of the fuses' (GPR16, bit
/// 2). Only then is there a stack.
extern "C" [[gnu::naked, gnu::used, gnu::section(".boot_entry")]] void palpate_divide_memory() {
  asm volatile(
      "cpsid i\n\t"
      "movw r0, #0xC000\n\t"
      "movt r0, #0x400A\n\t"  // IOMUXC_GPR
      "movw r1, #0xAAFF\n\t"
      "movt r1, #0xAAAA\n\t"
      "str r1, [r0, #0x44]\n\t"  // GPR17
      "movw r1, #0x0007\n\t"
      "movt r1, #0x0020\n\t"
      "str r1, [r0, #0x40]\n\t"  // GPR16
      "movw r1, #0x0000\n\t"
      "movt r1, #0x00AA\n\t"
      "str r1, [r0, #0x38]\n\t"  // GPR14
      "dsb\n\t"
      "isb\n\t"
      "movw r1, #:lower16:palpate_stack_top\n\t"
      "movt r1, #:upper16:palpate_stack_top\n\t"
      "mov sp, r1\n\t"
      "cpsie i\n\t"
      "b.w palpate_reset_handler");
}
