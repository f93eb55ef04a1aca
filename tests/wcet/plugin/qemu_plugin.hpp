// QEMU's interface for plugins, version 1 (QEMU 4.2 to 8.1), as far as it is used here: Debian packages no
// header. The functions have QEMU's names, the types have names of ours. From include/qemu/qemu-plugin.h of
// QEMU 7.2.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

using PluginId = uint64_t;

struct QemuInfo {
  const char* target_name;
  struct {
    int min;  // the oldest interface that this QEMU still has
    int cur;
  } version;
  bool system_emulation;
  struct {
    int smp_vcpus;
    int max_vcpus;
  } system;
};

struct TranslatedBlock;
struct TranslatedInstruction;

/// What a callback does with the processor's registers.
enum RegisterUse : int { kUsesNone, kReads, kReadsAndWrites };

using AtExit = void (*)(PluginId id, void* data);
using AtTranslation = void (*)(PluginId id, TranslatedBlock* block);
using AtExecution = void (*)(unsigned int processor, void* data);

void qemu_plugin_register_vcpu_tb_trans_cb(PluginId id, AtTranslation call);
void qemu_plugin_register_vcpu_insn_exec_cb(TranslatedInstruction* instruction, AtExecution call,
                                            RegisterUse use, void* data);
void qemu_plugin_register_atexit_cb(PluginId id, AtExit call, void* data);
size_t qemu_plugin_tb_n_insns(const TranslatedBlock* block);
TranslatedInstruction* qemu_plugin_tb_get_insn(const TranslatedBlock* block, size_t index);
uint64_t qemu_plugin_insn_vaddr(const TranslatedInstruction* instruction);
const void* qemu_plugin_insn_data(const TranslatedInstruction* instruction);

// What QEMU looks for in a plugin.
extern int qemu_plugin_version;
int qemu_plugin_install(PluginId id, const QemuInfo* info, int argc, char** argv);
}
