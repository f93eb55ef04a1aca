#include "program/firmware_image.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scenario/grasp_script.hpp"

namespace palpate::sim {
namespace {

template <int I, int F>
std::string spell(Q<I, F> q) {
  // The smallest number has no literal of its own: -2147483648 is minus applied to a number that is too
  // large.
  if (q == Q<I, F>::min()) return fmt::format("Q<{}, {}>::min()", I, F);
  return fmt::format("Q<{}, {}>::from_raw({})", I, F, q.raw());
}

template <class Items, class Spell>
std::string braces(const Items& items, Spell&& spell_one) {
  std::vector<std::string> parts;
  parts.reserve(std::size(items));
  for (const auto& item : items) parts.push_back(spell_one(item));
  return fmt::format("{{{}}}", fmt::join(parts, ", "));
}

std::string spell(LatticePoint p) { return fmt::format("{{{}, {}, {}}}", p.x, p.y, p.z); }

std::string spell(const RemeshRules& rules) {
  const auto levels = [](LevelRange range) { return fmt::format("{{{}, {}}}", range.least, range.most); };
  const RotationRules& r = rules.rotation;
  const StretchRules& s = rules.stretch;
  return fmt::format("    {{{{RotationCriterion({}), {}, {}, {}}},\n", static_cast<int>(r.criterion),
                     r.start_level, r.split_above, r.join_below) +
         fmt::format("     {{StretchCriterion({}), {}, {}, {{{}}}}}}},  // remesh\n",
                     static_cast<int>(s.criterion), spell(s.split_above), spell(s.merge_below),
                     braces(s.levels, levels));
}

std::string spell(const ContactRules& rules) {
  return fmt::format("{{{}, {}, {}, {},\n     {}, {}, {{{}, {}}}}}", spell(rules.radius),
                     spell(rules.stiffness), spell(rules.damping), spell(rules.friction),
                     spell(rules.force_limit), spell(rules.slew), rules.passivity.ceiling,
                     spell(rules.passivity.most_damping));
}

std::string spell(const Model& model) {
  const auto number = [](auto value) { return fmt::format("{}", value); };
  const auto material = [](const Material& m) {
    return fmt::format("\n     {{{}, {}}}", spell(m.shear), spell(m.bulk));
  };
  const auto box = [](const LatticeBox& b) { return fmt::format("{{{}, {}}}", spell(b.min), spell(b.max)); };
  const Dynamics& d = model.dynamics;
  return fmt::format("{{{{{}, {}}},  // block\n    {},  // level\n    {{{}}},\n    {{{}}},  // densities\n",
                     braces(model.block.cubes, number), braces(model.block.region, number), model.level,
                     braces(model.materials, material), braces(model.region_density, number)) +
         fmt::format("    {{{}, {}, {},\n     {}, {}}},  // dynamics\n", d.substeps, spell(d.mass_damping),
                     spell(d.stiffness_damping), spell(d.impulse_mantissa), d.impulse_exponent) +
         spell(model.remesh) +
         fmt::format("    {{{}}},  // held\n    {},\n    {}}}", braces(model.held, box),
                     spell(model.grasp_reach), spell(model.contact));
}

std::string spell(const firmware::Scene& scene) {
  const auto coordinate = [](Position x) { return spell(x); };
  const auto entry = [](RotationEntry x) { return spell(x); };
  return fmt::format("{{{},\n    {{{}}},\n    {{{}}},  // rotation\n    {}, {}}}",
                     spell(scene.edges_per_metre), braces(scene.device_origin, coordinate),
                     braces(scene.device_rotation, entry), spell(scene.newton_mantissa),
                     scene.newton_exponent);
}

std::string spell(const std::vector<firmware::ScriptRow>& rows) {
  std::string text;
  for (const firmware::ScriptRow& row : rows) {
    const auto& counts = row.encoder_counts;
    text += fmt::format("    {{{{{{{}, {}, {}}}}}, {}}},\n", counts[0], counts[1], counts[2], row.buttons);
  }
  return text;
}

}  // namespace

std::string firmware_image_source(const Scenario& scenario) {
  if (scenario.kind != ScenarioKind::kGrasp) {
    throw BadInput(
        fmt::format("{} moves the tool without a device, so there is nothing for the firmware to read; a "
                    "firmware image needs grasp or a file with scenario = \"grasp\"",
                    kind_name(scenario.kind)));
  }
  const Model body = compile_model(scenario.model);
  const firmware::Scene scene = compile_scene(scenario.scene, scenario.model);
  const auto rows = grasp_script(scenario);
  return fmt::format(
      "// Written by `palpate model {0} --firmware-image`; a change here is lost.\n"
      "#include \"palpate/firmware/scenario_image.hpp\"\n\n"
      "namespace palpate::firmware {{\nnamespace {{\n\n"
      "constexpr ScriptRow kRows[] = {{\n{1}}};\n\n"
      "}}  // namespace\n\n"
      "constexpr ScenarioImage kScenarioImage = {{\n   \"{0}\",\n   {{{2},\n   {3}}},\n   kRows, {4}}};\n\n"
      "}}  // namespace palpate::firmware\n",
      scenario.name, spell(rows), spell(body), spell(scene), rows.size());
}

}  // namespace palpate::sim
