// What check_contact says of a coupling holds in runs: a ball that is pressed into a bar and held comes to
// rest just inside the refusal, and swings for good far beyond it.
#include <gtest/gtest.h>

#include "model_parameters.hpp"
#include "support/bodies.hpp"
#include "support/fronts.hpp"

namespace palpate::test {
namespace {

using FullBar = WithFullCorotation<CuboidDense>;

struct PressedBar {
  const char* name;
  double density_kg_m3;
  int substeps;
  int level;
  double youngs_modulus_pa = 500.0;
};

/// The paper's bar as light and as heavy as it gets, and one whose elastic step is near its own limit.
constexpr PressedBar kBars[] = {{"tissue, 1 substep", 1000.0, 1, 3, 5e3},
                                {"light, 4 substeps", 10.0, 4, 3},
                                {"light, 8 substeps", 10.0, 8, 3},
                                {"stiff, 1 substep", 1000.0, 1, 3, 22e3}};

/// Of the largest taken, with a damper or without.
sim::ModelParameters held_bar(const PressedBar& body, bool is_damped, double of_limit) {
  sim::ModelParameters parameters = coarse_bar(body.density_kg_m3, body.substeps);
  parameters.level = body.level;
  parameters.regions[0].youngs_modulus_pa = body.youngs_modulus_pa;
  parameters.held = sim::HeldEnds::kBoth;
  parameters.contact.tool_radius_m = 0.008;
  parameters.contact.friction = 0.0;
  const sim::ContactStability stability = contact_stability(parameters);
  // Where k T = b, the default; the largest k of all is near.
  double damping = is_damped ? stability.largest_damping_n_s_m() : 0.0;
  for (int i = 0; is_damped && i < 40; ++i) {
    damping = 0.5 * (damping + std::min(damping, stability.largest_stiffness_n_m(damping) * sim::kTickS));
  }
  parameters.contact.damping_n_s_m = damping * of_limit;
  parameters.contact.stiffness_n_m = of_limit * stability.largest_stiffness_n_m(damping);
  parameters.contact.slew_n_per_tick = 100.0;
  return parameters;
}

/// Where the ball is pressed in: a side, in no node's symmetry, and the edge beside it, whose nodes are
/// lighter, a little off its plane of symmetry: in the plane the ball would stand on a knife's edge.
struct Place {
  const char* name;
  Eigen::Vector3d surface, outwards;
};
const std::vector<Place>& places() {
  static const std::vector<Place> all = {
      {"side", Eigen::Vector3d(0.5, 0.03, 0.05), Eigen::Vector3d::UnitX()},
      {"edge", Eigen::Vector3d(0.5, 0.5, 0.02), Eigen::Vector3d(1.0, 1.01, 0.0).normalized()}};
  return all;
}

struct Swing {
  double early,
      late;  // most change of the force in a tick, over the mean force, in the first and last half second

  [[nodiscard]] bool has_decayed() const { return late < std::max(0.002, 0.01 * early); }
};

/// 8 mm into the bar within 0.2 s, then still until 4 s. NaN where the bar has left the ball for good.
Swing swing_of(const Model& model, const Place& place) {
  const auto state = started<FullBar>(model);
  constexpr int kPressed = 200;
  constexpr int kTicks = 4000;
  Swing swing{0.0, 0.0};
  double before = 0.0;
  double mean = 0.0;
  for (int i = 0; i < kTicks; ++i) {
    const double depth = 0.125 * std::min(1.0, i / double{kPressed});
    TickInput input = input_at_rest();
    input.tool = fixed_vector<Position>(Eigen::Vector3d(place.surface + (0.125 - depth) * place.outwards));
    tick_once(*state, input);
    const double force = doubles(state->contact.force).norm();
    const double change = std::abs(force - before);
    before = force;
    if (i > kPressed && i <= kPressed + 500) swing.early = std::max(swing.early, change);
    if (i < kTicks - 500) continue;
    swing.late = std::max(swing.late, change);
    mean += force / 500.0;
  }
  return {swing.early / mean, swing.late / mean};
}

/// `factor` on top of what the model's own coupling is.
void press_each(const sim::ModelParameters& parameters, double factor, const char* name, bool decays) {
  Model model = compile_model(parameters);
  for (Coupling* coupling : {&model.contact.stiffness, &model.contact.damping}) {
    *coupling = sim::to_fixed<Coupling>(factor * sim::to_double(*coupling));
  }
  for (const Place& place : places()) {
    const Swing swing = swing_of(model, place);
    std::printf("%s, %.3g N/m, %.2g N s/m, %s: changes by %.1e a tick, in the end %.1e\n", name,
                factor * parameters.contact.stiffness_n_m, factor * parameters.contact.damping_n_s_m,
                place.name, swing.early, swing.late);
    EXPECT_EQ(swing.has_decayed(), decays) << name;
  }
}

TEST(ContactStability, JustInsideTheRefusalTheBallComesToRest) {
  for (const PressedBar& body : kBars) {
    for (const bool is_damped : {false, true}) {
      press_each(held_bar(body, is_damped, 0.999), 1.0, body.name, true);
    }
  }
}

TEST(ContactStability, JustOutsideItIsRefusedWithTheLimit) {
  for (const PressedBar& body : kBars) {
    for (const bool is_damped : {false, true}) {
      sim::ModelParameters parameters = held_bar(body, is_damped, 1.0);
      const double limit = parameters.contact.stiffness_n_m;
      parameters.contact.stiffness_n_m *= 1.001;
      try {
        compile_model(parameters);
        FAIL() << body.name;
      } catch (const sim::BadInput& refusal) {
        const std::string text = refusal.what();
        const std::size_t to = text.find(" to ");
        ASSERT_NE(text.find("contact_stiffness_n_m"), std::string::npos) << text;
        EXPECT_NEAR(std::stod(text.substr(to + 4)), limit, 1e-4 * limit) << text;
        // What the message says is right.
        parameters.contact.stiffness_n_m = std::stod(text.substr(to + 4));
        EXPECT_NO_THROW(compile_model(parameters));
      }
    }
  }
}

/// 64 times the limit: a node under the ball has many times the mass that the limit is made for.
TEST(ContactStability, FarOutsideItSwingsForGood) {
  for (const PressedBar& body : kBars) {
    for (const bool is_damped : {false, true}) {
      press_each(held_bar(body, is_damped, 0.5), 128.0, body.name, false);
    }
  }
}

/// Any body may be touched by giving the tool a radius: what is automatic is taken.
TEST(ContactStability, DefaultsAreTaken) {
  for (const int substeps : {1, 2, 4, 8}) {
    for (const double density : {10.0, 100.0, 1000.0, 2000.0}) {
      for (const double modulus : {100.0, 500.0, 20e3, 1e6}) {
        for (const double edge : {0.016, 0.064, 0.128}) {
          for (const int level : {0, 3, 6, 9}) {
            sim::ModelParameters parameters;
            parameters.edge_m = edge;
            parameters.level = level;
            parameters.substeps = substeps;
            parameters.grasp_reach_m = 0.0;
            parameters.regions[0] = {modulus, 0.45, density};
            try {
              check_domain(parameters);
            } catch (const sim::BadInput&) {
              continue;  // not without contact either
            }
            parameters.contact.tool_radius_m = edge / 10.0;
            const ContactRules rules = compile_model(parameters).contact;
            EXPECT_GT(rules.stiffness.raw(), 0);
            EXPECT_GT(rules.slew.raw(), 0);
            EXPECT_GT(rules.passivity.ceiling, 0u);
            EXPECT_LE(rules.force_limit, kContactForceLimit);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace palpate::test
