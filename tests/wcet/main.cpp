// palpate-wcet: bounds the time and the stack of everything below a function of a linked target program.
#include "command_line.hpp"
#include "output/output_file.hpp"
#include "report.hpp"

namespace palpate::wcet {
namespace {

struct Options {
  std::string elf;
  std::string root;
  std::string model;
  std::string json;
  std::string devices;
  std::string object;
  bool stack = false;
  bool interrupt = false;
  bool static_predictor = false;
  uint32_t wait_states = 0;
};

void add_options(CLI::App& app, Options& options) {
  app.add_option("ELF", options.elf, "the linked program")->required();
  app.add_option("--root", options.root,
                 "the function: its name, or a part that no other function's name has")
      ->required();
  app.add_option("--model", options.model, "instructions, m4, m7, or the path of a .toml file")->required();
  app.add_flag("--stack", options.stack, "also the worst stack");
  app.add_flag("--interrupt", options.interrupt, "adds interrupt entry and exit");
  app.add_flag("--static-predictor", options.static_predictor,
               "the core takes backward branches and no forward ones (m7: ACTLR.DISBTACREAD)");
  app.add_option("--wait-states", options.wait_states, "cycles more for every word fetched from code");
  app.add_option("--devices", options.devices, "a .toml file: what accesses to device registers cost more");
  app.add_option("--object", options.object,
                 "a static object, to be listed by its parts; it takes DWARF (-g)");
  app.add_option("--json", options.json, "writes all figures to this file");
}

CostModel make_model(const Options& options) {
  CostModel model = read_cost_model(options.model);
  if (options.static_predictor) model.predictor = Predictor::kStatic;
  model.wait_states = options.wait_states;
  if (!options.devices.empty()) model.devices = read_devices(options.devices);
  return model;
}

std::vector<PoolUse> read_pools(const Options& options) {
  constexpr uint32_t kSmallPartBytes = 1024;
  if (options.object.empty()) return {};
  const std::optional<ObjectPart> object = read_object(options.elf, options.object);
  if (!object) throw BadInput(options.elf + " has no object " + options.object + ", or no DWARF (-g)");
  return list_pools(*object, kSmallPartBytes);
}

void analyse(const Options& options) {
  const CostModel model = make_model(options);
  const Program program(options.elf);
  const CallGraph calls(program, program.image().find_function(options.root).start);
  // A frame of unknown size is refused even when nobody asks for the stack: what follows it can't be trusted.
  std::vector<StackUse> stack = measure_stack(program, calls);
  const BoundAnalysis bounds(program, calls, model);
  Findings findings{program,
                    calls,
                    model,
                    bounds,
                    walk_worst_path(calls, bounds),
                    options.interrupt,
                    std::nullopt,
                    read_pools(options)};
  if (options.stack) findings.stack = std::move(stack);
  print(findings);
  if (!options.json.empty()) sim::write_whole_file(options.json, to_json(findings).dump(1) + "\n");
}

int run(int argc, char** argv) {
  CLI::App app(
      "Bounds the worst-case time of everything below a function of a linked Cortex-M program.\n"
      "Exit codes: 0 fine, 1 there is no bound, 2 bad input, 3 the environment.\n"
      "This program links GLPK and is therefore distributed under the GPL, version 3 or later.",
      "palpate-wcet");
  Options options;
  add_options(app, options);
  return run_program(app, argc, argv, [&] {
    analyse(options);
    return kFine;
  });
}

}  // namespace
}  // namespace palpate::wcet

int main(int argc, char** argv) { return palpate::wcet::run(argc, argv); }
