#include "program/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <deque>
#include <optional>

#include "program/commands.hpp"
#include "scenario/parameter_table.hpp"

namespace palpate::sim {
namespace {

std::string flag_of(const std::string& key) {
  std::string flag = "--" + key;
  std::replace(flag.begin(), flag.end(), '_', '-');
  return flag;
}

/// A command that takes a scenario and its parameters as flags.
class ScenarioCommand {
 public:
  ScenarioCommand(CLI::App& app, const char* name, const char* meaning, unsigned kinds, bool records,
                  const char* example)
      : command_(app.add_subcommand(name, meaning)), kinds_(kinds) {
    command_->allow_extras();
    command_->footer(
        fmt::format("A flag is a key of the .toml file, with dashes for underscores.\nExample: {}", example));
    command_->add_option("scenario", name_, fmt::format("one of {}, or a path that ends in .toml", names()))
        ->option_text(" ")
        ->required();
    for (const Parameter& parameter : parameter_table()) {
      if ((parameter.kinds & kinds) != 0 && (records || !parameter.is_output)) add_flag(parameter);
    }
  }

  [[nodiscard]] CLI::App* app() const { return command_; }

  [[nodiscard]] Scenario scenario() const {
    Scenario scenario = load_scenario(name_);
    for (const Flag& flag : flags_) {
      if (flag.option->count() == 0) continue;
      if ((flag.parameter->kinds & kind_bit(scenario.kind)) == 0) {
        throw BadInput(fmt::format("{} has no {}", kind_name(scenario.kind), flag_of(flag.parameter->key)));
      }
      set_parameter(scenario, *flag.parameter, flag.text, "");
    }
    return scenario;
  }

 private:
  struct Flag {
    const Parameter* parameter;
    std::string text;
    CLI::Option* option;
  };

  /// Built-in scenarios that this command can run.
  [[nodiscard]] std::string names() const {
    std::vector<std::string> fitting;
    for (const std::string& name : scenario_names()) {
      if ((kind_bit(built_in_scenario(name).kind) & kinds_) != 0) fitting.push_back(name);
    }
    return fmt::format("{}", fmt::join(fitting, ", "));
  }

  void add_flag(const Parameter& parameter) {
    flags_.push_back(Flag{&parameter, "", nullptr});
    Flag& flag = flags_.back();
    std::string spelling = flag_of(parameter.key);
    if (!parameter.alias.empty()) spelling += "," + flag_of(parameter.alias);
    const std::string meaning = fmt::format("{}; {}; default {}", parameter.meaning,
                                            describe_range(parameter), describe_default(parameter));
    flag.option = command_->add_option(spelling, flag.text, meaning)->type_name("VALUE")->option_text(" ");
  }

  CLI::App* command_;
  unsigned kinds_;
  std::string name_;
  std::deque<Flag> flags_;  // options point into it
};

/// `table1`, whose flags are those of cuboid-bend.
class Table1Command {
 public:
  explicit Table1Command(CLI::App& app)
      : command_(app.add_subcommand("table1", "the paper's Table 1 and Figure 6, in fixed point")) {
    command_->allow_extras();
    command_->footer("Example: palpate table1 --twist 90 --out out/twist");
    add_flag("angle", angle_);
    add_flag("twist", twist_);
    add_flag("out", out_);
    add_flag("plots", plots_);
    command_->add_flag("--quick", is_quick_, "two rows only");
  }

  [[nodiscard]] CLI::App* app() const { return command_; }

  [[nodiscard]] Table1Request request() const {
    if (angle_ && twist_) {
      throw BadInput("table1 takes --angle or --twist, not both: the bar is bent or twisted");
    }
    Scenario scenario = built_in_scenario("cuboid-bend");
    scenario.bend.angle_deg = twist_ ? 0.0 : Table1Options{}.bend_deg;
    scenario.out = Table1Request{}.out;
    set("angle", angle_, scenario);
    set("twist", twist_, scenario);
    set("out", out_, scenario);
    set("plots", plots_, scenario);
    return Table1Request{
        {scenario.bend.angle_deg, scenario.bend.twist_deg, is_quick_}, scenario.out, scenario.plots};
  }

 private:
  void add_flag(const char* key, std::optional<std::string>& text) {
    const Parameter& parameter = *find_parameter(key);
    command_
        ->add_option(fmt::format("--{}", key), text,
                     fmt::format("{}; {}", parameter.meaning, describe_range(parameter)))
        ->type_name("VALUE")
        ->option_text(" ");
  }
  static void set(const char* key, const std::optional<std::string>& text, Scenario& scenario) {
    if (text) set_parameter(scenario, *find_parameter(key), *text, "");
  }

  CLI::App* command_;
  std::optional<std::string> angle_, twist_, out_, plots_;  // options point here
  bool is_quick_ = false;
};

void refuse_extras(const CLI::App& command) {
  const auto extras = command.remaining();
  if (extras.empty()) return;
  std::vector<std::string> flags;
  for (const CLI::Option* option : command.get_options()) {
    if (option->nonpositional()) flags.push_back(option->get_name());
  }
  throw BadInput(fmt::format("{} does not take '{}'; it takes {}", command.get_name(), extras[0],
                             fmt::join(flags, ", ")));
}

/// Everything but help and version, which CLI11 answers itself.
void parse(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success&) {
    throw;
  } catch (const CLI::ParseError& error) {
    std::string line = error.what();
    std::replace(line.begin(), line.end(), '\n', ' ');
    throw BadInput(line + "; see palpate --help");
  }
}

void configure(CLI::App& app) {
  constexpr std::size_t kColumn = 38;
  app.set_version_flag("--version", "palpate " PALPATE_VERSION, "print the version");
  app.set_help_flag("--help", "print this help");
  app.footer(
      "Example: palpate hil grasp --out out/grasp\n"
      "Exit codes: 0 fine, 1 a check failed, 2 bad input, 3 the environment.");
  app.allow_extras();
  app.get_formatter()->column_width(kColumn);
}

/// The command that the user chose, all of its arguments known.
const CLI::App* chosen_command(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  if (chosen.empty()) {
    const auto extras = app.remaining();
    throw BadInput(fmt::format(
        "{}; the commands are compare, hil, inspect, model, paper, record, replay, run and table1, see "
        "palpate "
        "--help",
        extras.empty() ? "no command is given" : fmt::format("there is no command '{}'", extras[0])));
  }
  refuse_extras(*chosen[0]);
  return chosen[0];
}

int dispatch(CLI::App& app, int argc, const char* const* argv) {
  configure(app);
  const ScenarioCommand run(app, "run", "move the tool directly, without a device", kToolKinds, true,
                            "palpate run cuboid-sine --slow 2 --out out/sine");
  const ScenarioCommand hil(app, "hil", "the firmware's cycle, fed with the encoder counts of a PHANToM",
                            kDeviceKinds, true, "palpate hil grasp --force-scale 20 --out out/grasp");
  ScenarioCommand model(app, "model", "describe a scenario's model, or write it for the firmware", kAllKinds,
                        false, "palpate model grasp --firmware-image scenario_image.cpp");
  const Table1Command table1(app);
  std::string image;
  model.app()
      ->add_option("--firmware-image", image, "write the model and the script as C++ for the firmware")
      ->option_text("FILE");
  std::string container;
  model.app()
      ->add_option("--container", container, "write the model as a container, which the firmware reads")
      ->option_text("FILE");
  CLI::App* compare =
      app.add_subcommand("compare", "whether two runs have the same bits; if not, where they part");
  std::string first;
  std::string second;
  compare->add_option("A", first, "run folder, or a folder with the console.csv of a target")->required();
  compare->add_option("B", second, "the other one")->required();
  compare->footer("Example: palpate compare out/demo/host out/demo/target");
  compare->allow_extras();

  CLI::App* paper =
      app.add_subcommand("paper", "the paper's experiments, with a report of figures beside its own");
  std::string report_folder = "out/paper";
  bool is_quick = false;
  paper->add_option("--out", report_folder, "folder to write; default out/paper")->option_text("FOLDER");
  paper->add_flag("--quick", is_quick,
                  "only a few ticks of each run: shows that it works, the figures mean nothing");
  paper->footer("Example: palpate paper --out out/paper, then open out/paper/report.html");
  paper->allow_extras();

  CLI::App* record =
      app.add_subcommand("record", "record a device on a bench, from its firmware's telemetry");
  RecordRequest recorded{"", "", "cuboid-paper", "recording.plp", 0};
  record->add_option("--port", recorded.port, "serial line to the board")->option_text("LINE")->required();
  record->add_option("--model", recorded.model, "container that the board was given")
      ->option_text("FILE")
      ->required();
  record->add_option("--profile", recorded.profile, "profile of its firmware; default cuboid-paper")
      ->option_text("NAME")
      ->check(CLI::IsMember({"cuboid-paper", "cuboid-dense", "organ", "small", "tiny"}));
  record->add_option("--out", recorded.out, "file to write; default recording.plp")->option_text("FILE");
  record->add_option("--ticks", recorded.ticks, "when to stop; 0: at Ctrl-C")->option_text("TICKS");
  record->footer("Example: palpate record --port /dev/ttyACM0 --model model.palpate --profile small");
  record->allow_extras();

  CLI::App* replay = app.add_subcommand("replay", "run a recording again, and say where it differs");
  CLI::App* inspect = app.add_subcommand("inspect", "what a recording holds");
  std::string recording_path;
  std::string inspection_folder;
  bool as_json = false;
  uint32_t from_tick = 0;
  for (CLI::App* command : {replay, inspect}) {
    command->add_option("FILE", recording_path, "recording")->required();
    command->allow_extras();
  }
  replay->add_option("--from-tick", from_tick, "begin with the last snapshot at or before it")
      ->option_text("TICK");
  replay->footer("Example: palpate replay out/touch/recording.plp");
  inspect->add_option("--out", inspection_folder, "also write it, with pictures, into a folder")
      ->option_text("FOLDER");
  inspect->add_flag("--json", as_json, "print it for a program");
  inspect->footer("Example: palpate inspect out/touch/recording.plp --out out/inspect");

  parse(app, argc, argv);
  const CLI::App* chosen = chosen_command(app);
  if (chosen == run.app()) return run_scenario(run.scenario(), "run");
  if (chosen == hil.app()) return run_scenario(hil.scenario(), "hil");
  if (chosen == table1.app()) return make_table1(table1.request());
  if (chosen == paper) return run_paper(report_folder, is_quick);
  if (chosen == compare) return compare_runs(first, second);
  if (chosen == record) return record_device(recorded);
  if (chosen == replay) return replay_recording(recording_path, from_tick);
  if (chosen == inspect) return inspect_recording(recording_path, inspection_folder, as_json);
  return describe_model(model.scenario(), image, container);
}

}  // namespace

int run_command_line(int argc, const char* const* argv) {
  CLI::App app("Soft tissue inside a haptic controller", "palpate");
  try {
    return dispatch(app, argc, argv);
  } catch (const CLI::Success& asked) {
    return app.exit(asked);
  }
}

}  // namespace palpate::sim
