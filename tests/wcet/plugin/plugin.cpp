// The QEMU plugin: every instruction that the emulated processor executes goes to a Trace. Arguments:
//   plan=FILE     what to watch
//   counts=FILE   where the counts go when QEMU ends
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>

#include "qemu_plugin.hpp"
#include "trace.hpp"

extern "C" {
// The version of the interface that was written down in qemu_plugin.hpp.
__attribute__((visibility("default"))) int qemu_plugin_version = 1;
}

namespace palpate::wcet {
namespace {

struct Plugin {
  Trace trace;
  std::string counts_path;
};

// Never destroyed: QEMU asks for the counts after the destructors of static objects.
Plugin* g_plugin = nullptr;

void execute(unsigned int, void* spot) { g_plugin->trace.execute(*static_cast<Spot*>(spot)); }

// Of Thumb code. At a page's end qemu_plugin_insn_size counts bytes of the next instruction too.
uint32_t bytes_of(const TranslatedInstruction* instruction) {
  constexpr unsigned kFirstOfTwo = 0x1d;
  const auto* data = static_cast<const uint8_t*>(qemu_plugin_insn_data(instruction));
  return data[1] >> 3 >= kFirstOfTwo ? 4 : 2;
}

void translate(PluginId, TranslatedBlock* block) {
  for (size_t i = 0; i < qemu_plugin_tb_n_insns(block); ++i) {
    TranslatedInstruction* instruction = qemu_plugin_tb_get_insn(block, i);
    const auto address = static_cast<uint32_t>(qemu_plugin_insn_vaddr(instruction));
    Spot& spot = g_plugin->trace.spot(address, bytes_of(instruction));
    qemu_plugin_register_vcpu_insn_exec_cb(instruction, execute, kUsesNone, &spot);
  }
}

void leave_counts(PluginId, void*) {
  std::ofstream file(g_plugin->counts_path);
  write_counts(g_plugin->trace.counts(), file);
  if (!file) std::fprintf(stderr, "palpate: can't write %s\n", g_plugin->counts_path.c_str());
}

std::string argument(int argc, char** argv, const std::string& name) {
  for (int i = 0; i < argc; ++i) {
    const std::string given = argv[i];
    if (given.rfind(name + "=", 0) == 0) return given.substr(name.size() + 1);
  }
  throw std::runtime_error("the plugin needs " + name + "=FILE");
}

void refuse_others(const QemuInfo& qemu) {
  if (qemu.version.min > qemu_plugin_version || qemu.version.cur < qemu_plugin_version) {
    throw std::runtime_error("this QEMU's plugins have interface " + std::to_string(qemu.version.min) +
                             " to " + std::to_string(qemu.version.cur) + ", and not " +
                             std::to_string(qemu_plugin_version));
  }
  if (std::string(qemu.target_name) != "arm" || !qemu.system_emulation || qemu.system.smp_vcpus != 1)
    throw std::runtime_error("a system of one Arm processor is counted, and no other");
}

void install(PluginId id, const QemuInfo& qemu, int argc, char** argv) {
  refuse_others(qemu);
  const std::string path = argument(argc, argv, "plan");
  std::ifstream file(path);
  if (!file) throw std::runtime_error("can't read " + path);
  g_plugin = new Plugin{Trace(read_plan(file)), argument(argc, argv, "counts")};
  qemu_plugin_register_vcpu_tb_trans_cb(id, translate);
  qemu_plugin_register_atexit_cb(id, leave_counts, nullptr);
}

}  // namespace
}  // namespace palpate::wcet

extern "C" __attribute__((visibility("default"))) int qemu_plugin_install(PluginId id, const QemuInfo* info,
                                                                          int argc, char** argv) {
  try {
    palpate::wcet::install(id, *info, argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "palpate: %s\n", error.what());
    return 1;
  }
  return 0;
}
