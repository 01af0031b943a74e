// Velocities that follow from independent ones where rows bind velocities alone: proven to do so, against multipliers,
// and differentiated.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "agreement/shared_data.hpp"
#include "loops/closed_programs.hpp"
#include "loops/plan/plan.hpp"
#include "model/read/read.hpp"
#include "passes/pipeline.hpp"
#include "programs/closed_system.hpp"
#include "properties/effort.hpp"
#include "properties/random_rolling.hpp"
#include "validate/loops/validation.hpp"

namespace jourdain::tests {
namespace {

using State = std::vector<double>;  ///< y, then z

model::Mechanism treated(model::Mechanism mechanism, model::LoopTreatment treatment) {
  mechanism.loop_options = {};
  mechanism.loop_options.treatment = treatment;
  return mechanism;
}

model::Mechanism of_model(const std::string& name, model::LoopTreatment treatment) {
  return treated(read_model(model_path(name + ".toml")), treatment);
}

struct Planned {
  std::optional<loops::LoopPlan> plan;
  std::string messages;
};

Planned planned(const model::Mechanism& mechanism) {
  support::Diagnostics diagnostics("model", "");
  Planned result;
  result.plan = loops::plan_loops(mechanism, diagnostics);
  result.messages = diagnostics.format();
  return result;
}

/// The derivatives of a mechanism with independent velocities, and what validates them.
struct Differentiated {
  Differentiated(model::Mechanism of, const loops::LoopPlan& closed_by)
      : mechanism(std::move(of)), plan(closed_by) {
    const programs::ClosedSystem closed(mechanism, {}, plan);
    module.functions = programs::derivative_programs(
        closed.derivative_sources(),
        programs::with_needed({"linearize", "forward_dynamics_derivatives", "residual_derivatives"},
                              programs::scene_facts(mechanism, &plan)),
        programs::DerivativeTerms::kAll);
    module = passes::optimise(std::move(module)).module;
  }

  bool is_refused() const {
    return !validate::validate_closed(mechanism, dynamics::derive_equations(mechanism, {}), module, plan)
                .failures.empty();
  }

  model::Mechanism mechanism;
  loops::LoopPlan plan;
  ir::Module module;
};

TEST(IndependentVelocities, TakeFewerOperations) {
  const auto operations = [](const char* model, model::LoopTreatment treatment, const char* function) {
    return ClosedPrograms(of_model(model, treatment), true).operations(function);
  };
  using model::LoopTreatment;
  EXPECT_EQ(operations("differential_drive", LoopTreatment::kMultipliers, "forward_dynamics"), 152u);
  EXPECT_EQ(operations("differential_drive", LoopTreatment::kMultipliers, "project"), 108u);
  EXPECT_EQ(operations("differential_drive", LoopTreatment::kMultipliers, "linearize"), 361u);
  EXPECT_EQ(operations("differential_drive", LoopTreatment::kExplicit, "forward_dynamics"), 44u);
  EXPECT_EQ(operations("differential_drive", LoopTreatment::kExplicit, "close_loops"), 0u);
  EXPECT_EQ(operations("differential_drive", LoopTreatment::kExplicit, "linearize"), 39u);
  EXPECT_EQ(operations("rolling_disc", LoopTreatment::kMultipliers, "forward_dynamics"), 316u);
  EXPECT_EQ(operations("rolling_disc", LoopTreatment::kExplicit, "forward_dynamics"), 254u);
}

/// A step of the classical Runge-Kutta method, interpreted, without what steps end with.
State rk4_step(const ClosedPrograms& programs, const State& x, double h) {
  const auto ny = std::ptrdiff_t(programs.layout().position_count());
  const auto rate = [&](const State& at) {
    const State y(at.begin(), at.begin() + ny), z(at.begin() + ny, at.end());
    State result(at.size());
    const auto put = [&](const char* function, const char* name, std::size_t first) {
      for (const auto& [entry, value] : programs.values(function, 0, y, z, {}))
        result[first + std::stoul(entry.substr(std::string(name).size() + 1))] = value;
    };
    put("position_rate", "ydot", 0);
    put("forward_dynamics", "zdot", std::size_t(ny));
    return result;
  };
  const auto moved = [&](const State& by, double length) {
    State to = x;
    for (std::size_t k = 0; k < to.size(); ++k) to[k] += length * by[k];
    return to;
  };
  const State a = rate(x), b = rate(moved(a, h / 2)), c = rate(moved(b, h / 2)), d = rate(moved(c, h));
  State next = x;
  for (std::size_t k = 0; k < next.size(); ++k) next[k] += h / 6 * (a[k] + 2 * b[k] + 2 * c[k] + d[k]);
  return next;
}

/// With all coordinates the velocities of what is carried along are in the state.
TEST(IndependentVelocities, ADiscRollsAsWithMultipliers) {
  const ClosedPrograms all(of_model("rolling_disc", model::LoopTreatment::kMultipliers)),
      reduced(of_model("rolling_disc", model::LoopTreatment::kExplicit));
  const std::size_t ny = all.layout().position_count();
  State x = all.plan().y, r = x;
  x.insert(x.end(), all.plan().z.begin(), all.plan().z.end());
  for (const std::size_t k : reduced.plan().independent) r.push_back(all.plan().z[k]);
  for (int i = 0; i < 1000; ++i) {
    x = rk4_step(all, x, 1e-3);
    r = rk4_step(reduced, r, 1e-3);
  }
  double worst = 0;
  for (std::size_t k = 0; k < ny; ++k) worst = std::max(worst, std::fabs(x[k] - r[k]));
  for (std::size_t j = 0; j < reduced.plan().independent.size(); ++j)
    worst = std::max(worst, std::fabs(x[ny + reduced.plan().independent[j]] - r[ny + j]));
  fmt::print("rolling disc after 1 s: independent velocities and multipliers {:.1e} apart\n", worst);
  EXPECT_LE(worst, 1e-10);
}

TEST(IndependentVelocities, AreDifferentiatedWithWhatIsCarriedAlong) {
  std::size_t count = 0;
  for (std::uint64_t seed = 0; seed < cases(200); ++seed) {
    const model::Mechanism mechanism = asking_for_independent_velocities(random_rolling(seed));
    const Planned found = planned(mechanism);
    if (!found.plan) continue;
    ++count;
    EXPECT_FALSE(found.plan->carried().empty()) << "seed " << seed;
    EXPECT_FALSE(Differentiated(mechanism, *found.plan).is_refused()) << "seed " << seed;
  }
  fmt::print("{} of {} random mechanisms that roll have independent velocities\n", count, cases(200));
  EXPECT_GE(count, cases(200) / 12);
}

/// A trailer hitched to a plate, on a blade; its hitch is carried along, and a state of its own displaces nothing.
TEST(IndependentVelocities, AreDifferentiatedBesideStates) {
  const std::string text = R"([model]
name = "trailer"
[loops]
treatment = "explicit"
[[state]]
name = "filter"
rate = "hitch.rate - 2*filter"
[[body]]
name = "base"
mass = 4
inertia = [0.1, 0.15, 0.2]
[[body]]
name = "trailer"
mass = 2
inertia = [0.05, 0.06, 0.08]
[[joint]]
name = "floor"
type = "planar"
parent = "world"
child = "base"
[[joint]]
name = "hitch"
type = "revolute"
parent = "base"
child = "trailer"
position = [-0.3, 0, 0]
[[frame]]
name = "axle"
body = "trailer"
position = [-0.6, 0, 0]
[[constraint]]
name = "blade"
type = "knife_edge"
frame = "axle"
[[force]]
joint = "hitch"
value = "filter - 3*hitch"
)";
  support::Diagnostics diagnostics("trailer.toml", text);
  const model::Mechanism mechanism = model::read_mechanism(diagnostics, {}).value();
  const loops::LoopPlan plan = planned(mechanism).plan.value();
  EXPECT_EQ(plan.carried().size(), 1u);
  EXPECT_FALSE(Differentiated(mechanism, plan).is_refused());
}

/// A wheel on a fork, by a chain of slides and turns: one position is closed, two are carried along.
model::Mechanism unicycle() {
  const auto joint = [](const char* type, const char* name, const char* axis, const char* parent,
                        const char* child, const char* rest) {
    return fmt::format(
        "[[joint]]\nname = \"{}\"\ntype = \"{}\"\naxis = {}\nparent = \"{}\"\nchild = \"{}\"\n{}\n", name,
        type, axis, parent, child, rest);
  };
  std::string text = "[model]\nname = \"unicycle\"\n[loops]\ntreatment = \"explicit\"\n";
  for (const char* massless : {"a", "b", "c", "yawed"})
    text += fmt::format("[[body]]\nname = \"{}\"\nmass = 0\n", massless);
  text +=
      "[[body]]\nname = \"fork\"\nmass = 1\ncenter_of_mass = [0.1, 0, 0.2]\ninertia = [0.05, 0.06, 0.03]\n"
      "[[body]]\nname = \"wheel\"\nmass = 2\ninertia = [0.1, 0.2, 0.1]\n"
      "[[actuator]]\njoint = \"spin\"\n"
      "[[constraint]]\nname = \"ground\"\ntype = \"rolling_wheel\"\nframe = \"wheel\"\naxis = [0, 1, 0]\n"
      "radius = 0.5\n";
  text += joint("prismatic", "x", "[1, 0, 0]", "world", "a", "") +
          joint("prismatic", "y", "[0, 1, 0]", "a", "b", "") +
          joint("prismatic", "z", "[0, 0, 1]", "b", "c", "initial_position = 0.5") +
          joint("revolute", "yaw", "[0, 0, 1]", "c", "yawed", "initial_velocity = 0.3") +
          joint("revolute", "lean", "[1, 0, 0]", "yawed", "fork", "range = [-1, 1]") +
          joint("revolute", "spin", "[0, 1, 0]", "fork", "wheel", "initial_velocity = 6");
  support::Diagnostics diagnostics("unicycle.toml", text);
  const auto mechanism = model::read_mechanism(diagnostics, {});
  EXPECT_TRUE(mechanism) << diagnostics.format();
  return mechanism.value();
}

TEST(IndependentVelocities, DerivativesWithPlantedFaultsAreRefused) {
  constexpr std::size_t kFaults = 12;
  for (const auto& [name, mechanism] :
       {std::pair("differential_drive", of_model("differential_drive", model::LoopTreatment::kExplicit)),
        {"unicycle", unicycle()}}) {
    Differentiated correct(mechanism, planned(mechanism).plan.value());
    ASSERT_FALSE(correct.is_refused());
    ir::Program* const linearize =
        &*std::find_if(correct.module.functions.begin(), correct.module.functions.end(),
                       [](const ir::Program& program) { return program.name == "linearize"; });
    const std::size_t count = linearize->nodes.size();
    std::size_t planted = 0;
    for (std::size_t k = 0; k < kFaults; ++k)
      for (std::size_t i = (2 * k + 1) * count / (2 * kFaults); i < count; ++i) {
        ir::Node& node = linearize->nodes[i];
        const ir::Node before = node;
        if (node.op == ir::Op::kAdd)
          node.op = ir::Op::kSubtract;
        else if (node.op == ir::Op::kMultiply && node.a != node.b)
          node.b = node.a;
        else
          continue;
        EXPECT_TRUE(correct.is_refused()) << name << ", value " << i;
        node = before;
        ++planted;
        break;
      }
    EXPECT_GE(planted, kFaults - 2) << name;
    // A column of what is carried along, left out.
    const auto ny = static_cast<int>(correct.plan.independent.size());
    const auto entry =
        std::find_if(linearize->outputs.begin(), linearize->outputs.end(), [ny](const ir::Output& output) {
          return output.name == "A" && output.column >= ny && output.row >= ny && output.row < ny + 2;
        });
    ASSERT_NE(entry, linearize->outputs.end());
    linearize->outputs.erase(entry);
    EXPECT_TRUE(correct.is_refused()) << name;
  }
}

/// The sleigh's blade, -sin(a) x' + cos(a) y' = 0: y' follows from x' where the cosine keeps off zero.
std::string sleigh(const std::string& range) {
  return "[model]\nname = \"sleigh\"\ngravity = [0, 0, 0]\n[[body]]\nname = \"body\"\nmass = 5\n"
         "center_of_mass = [0.3, 0, 0]\ninertia = [0.1, 0.4, 0.4]\n[[joint]]\nname = \"x\"\n"
         "type = \"prismatic\"\naxis = [1, 0, 0]\nparent = \"world\"\nchild = \"a\"\n"
         "[[joint]]\nname = \"y\"\ntype = \"prismatic\"\naxis = [0, 1, 0]\nparent = \"a\"\nchild = \"b\"\n"
         "[[joint]]\nname = \"angle\"\ntype = \"revolute\"\nparent = \"b\"\nchild = \"body\"\n" +
         range +
         "[[body]]\nname = \"a\"\nmass = 0\n[[body]]\nname = \"b\"\nmass = 0\n[[constraint]]\nname = "
         "\"blade\"\ntype = \"knife_edge\"\nframe = \"body\"\n[loops]\ntreatment = \"explicit\"\n";
}

Planned planned(const std::string& text) {
  support::Diagnostics diagnostics("sleigh.toml", text);
  const auto mechanism = model::read_mechanism(diagnostics, {});
  EXPECT_TRUE(mechanism) << diagnostics.format();
  Planned result;
  if (mechanism) result.plan = loops::plan_loops(*mechanism, diagnostics);
  result.messages = diagnostics.format();
  return result;
}

TEST(IndependentVelocities, AreProvenOverDeclaredRanges) {
  const Planned within = planned(sleigh("range = [-1, 1]\n"));
  ASSERT_TRUE(within.plan) << within.messages;
  const loops::ClosedForm& form = within.plan->closed_form.value();
  EXPECT_LE(form.least_determinant,
            std::cos(1.0));  // a lower bound, of the square half of the least or better
  EXPECT_GE(form.least_determinant, std::cos(1.0) / std::sqrt(2.0) - 1e-9);
  ASSERT_EQ(form.box.positions.size(), 1u);
  EXPECT_EQ(form.box.positions[0].index, 2u);
  EXPECT_EQ(form.box.positions[0].low, -1);
  EXPECT_EQ(form.box.positions[0].high, 1);
}

/// Where the start is not where they are most regular others are more so than it.
TEST(IndependentVelocities, AreValidatedFromAnyStart) {
  for (const char* start : {"0", "0.3", "1.1", "-0.9"}) {
    const std::string text = sleigh(fmt::format("range = [-1.2, 1.2]\ninitial_position = {}\n", start));
    support::Diagnostics diagnostics("sleigh.toml", text);
    const auto mechanism = model::read_mechanism(diagnostics, {});
    ASSERT_TRUE(mechanism) << diagnostics.format();
    const loops::LoopPlan plan = loops::plan_loops(*mechanism, diagnostics).value();
    CompileOptions options;
    options.loops = plan;
    EXPECT_EQ(compile(*mechanism, options).verdict.failures, std::vector<std::string>()) << start;
  }
}

TEST(IndependentVelocities, AreRefusedWhereTheyAreSingular) {
  for (const char* range : {"", "range = [-1.6, 1.6]\n", "range = [-1.5707963267948966, 0.3]\n"}) {
    const Planned found = planned(sleigh(range));
    EXPECT_FALSE(found.plan) << range;
    EXPECT_NE(found.messages.find("not proven to follow from independent ones"), std::string::npos)
        << found.messages;
  }
}

}  // namespace
}  // namespace jourdain::tests
