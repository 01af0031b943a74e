#include "emit/implicit_step.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "emit/body.hpp"
#include "emit/layout.hpp"
#include "emit/templates.hpp"
#include "programs/steppers.hpp"

namespace jourdain::emit {

namespace {

/// For each velocity those before it that W couples it with: where M or a derivative of the residual has an
/// entry, where rotations mix columns, and what fills in when rows are eliminated from the last on.
std::vector<std::vector<std::size_t>> couplings(const programs::SceneFacts& scene,
                                                const ir::Program& derivatives) {
  const std::size_t n = scene.velocities.size();
  std::vector<std::set<std::size_t>> before(n);
  const auto couple = [&before](std::size_t i, std::size_t j) {
    if (i != j) before[std::max(i, j)].insert(std::min(i, j));
  };
  for (const ir::Output& output : derivatives.outputs) {
    if (output.name != "M" && output.name != "r_y" && output.name != "r_z") continue;
    const auto row = static_cast<std::size_t>(output.row), column = static_cast<std::size_t>(output.column);
    couple(row, column);
    for (const model::Tangent::Scalar& q : scene.tangent.quaternions)
      if (column >= q.velocity && column < q.velocity + 3)
        for (std::size_t k = 0; k < 3; ++k) couple(row, q.velocity + k);
  }
  for (std::size_t k = n; k-- > 0;)
    for (const std::size_t i : before[k])
      for (const std::size_t j : before[k]) couple(i, j);
  std::vector<std::vector<std::size_t>> lists;
  for (const auto& set : before) lists.emplace_back(set.begin(), set.end());
  return lists;
}

/// A run of scalar coordinates whose entries in y and z differ by the same number.
struct Run {
  std::size_t first = 0, last = 0, shift = 0;  ///< entries of z from first to last − 1; y is `shift` further
};

std::vector<Run> scalar_runs(const model::Tangent& tangent) {
  std::vector<Run> runs;
  for (const model::Tangent::Scalar& s : tangent.scalars) {
    const std::size_t shift = s.position - s.velocity;
    if (runs.empty() || runs.back().last != s.velocity || runs.back().shift != shift)
      runs.push_back({s.velocity, s.velocity, shift});
    ++runs.back().last;
  }
  return runs;
}

std::string shifted(std::size_t shift) { return shift == 0 ? "i" : fmt::format("i + {}", shift); }

std::string displace_text(const model::Tangent& tangent) {
  std::string text;
  for (const Run& run : scalar_runs(tangent))
    text += fmt::format("  for (int i = {}; i < {}; ++i) state.y[{}] = start.y[{}] + displacement[i];\n",
                        run.first, run.last, shifted(run.shift), shifted(run.shift));
  for (const model::Tangent::Scalar& q : tangent.quaternions)
    text +=
        fmt::format("  turn(start.y + {0}, displacement + {1}, state.y + {0});\n", q.position, q.velocity);
  return text;
}

/// Rates of local displacements: of a rotation those of twice the Gibbs vector.
std::string rotation_text(const programs::SceneFacts& scene) {
  const std::string n = fmt::format("{}", scene.velocities.size());
  std::string text;
  const bool turns = !scene.tangent.quaternions.empty();
  if (turns)
    text += R"(
// (1 + [e])^-1 x with e[3] = 1 / (1 + |e|^2); its transpose is that of -e.
template <class Real>
void rotate(const Real (&e)[4], Real* x) noexcept {
  const Real along = e[0] * x[0] + e[1] * x[1] + e[2] * x[2];
  const Real x0 = x[0] - (e[1] * x[2] - e[2] * x[1]) + along * e[0];
  const Real x1 = x[1] - (e[2] * x[0] - e[0] * x[2]) + along * e[1];
  const Real x2 = x[2] - (e[0] * x[1] - e[1] * x[0]) + along * e[2];
  x[0] = e[3] * x0;
  x[1] = e[3] * x1;
  x[2] = e[3] * x2;
}
)";
  text += fmt::format(
      "\ntemplate <class Real>\nvoid local_rate(const Real (&{1})[{0}], const Real (&z)[{0}], Real "
      "(&rate)[{0}]) noexcept "
      "{{\n  for (int i = 0; i < {0}; ++i) rate[i] = z[i];\n",
      n, turns ? "displacement" : "");
  for (const model::Tangent::Scalar& q : scene.tangent.quaternions)
    text += fmt::format("  turning_rate(displacement + {0}, z + {0}, rate + {0});\n", q.velocity);
  return text + "}\n";
}

constexpr const char* kTurns = R"(
// Unit quaternion `from` times (1, theta/2), brought to unit length.
template <class Real>
void turn(const Real* from, const Real* theta, Real* to) noexcept {
  const Real g0 = Real(0.5) * theta[0], g1 = Real(0.5) * theta[1], g2 = Real(0.5) * theta[2];
  to[0] = from[0] - from[1] * g0 - from[2] * g1 - from[3] * g2;
  to[1] = from[1] + from[0] * g0 + from[2] * g2 - from[3] * g1;
  to[2] = from[2] + from[0] * g1 + from[3] * g0 - from[1] * g2;
  to[3] = from[3] + from[0] * g2 + from[1] * g1 - from[2] * g0;
  normalise(to);
}

// Rate of theta: omega + g x omega + g (g . omega) with g = theta/2.
template <class Real>
void turning_rate(const Real* theta, const Real* omega, Real* rate) noexcept {
  const Real g0 = Real(0.5) * theta[0], g1 = Real(0.5) * theta[1], g2 = Real(0.5) * theta[2];
  const Real along = g0 * omega[0] + g1 * omega[1] + g2 * omega[2];
  rate[0] = omega[0] + (g1 * omega[2] - g2 * omega[1]) + along * g0;
  rate[1] = omega[1] + (g2 * omega[0] - g0 * omega[2]) + along * g1;
  rate[2] = omega[2] + (g0 * omega[1] - g1 * omega[0]) + along * g2;
}
)";

bool has_change(const programs::SceneFacts& scene) { return scene.time.dynamics || !scene.inputs.empty(); }

/// Derivatives, and the residual's own change over the step.
std::string derivatives_text(const programs::SceneFacts& scene) {
  const bool inputs = !scene.inputs.empty();
  std::string text, more;
  if (inputs) {
    text += fmt::format("  Real r_u[{}][{}];\n", scene.velocities.size(), scene.inputs.size());
    more += ", r_u";
  }
  if (scene.time.dynamics) more += ", step.change";
  text += fmt::format(
      "  residual_derivatives(model, state, {}, accelerations.zdot, step.W, step.r_y, step.r_z{});\n",
      inputs ? "input_at(input, state)" : "input", more);
  if (has_change(scene))
    text += fmt::format("  for (int i = 0; i < {}; ++i) step.change[i] = {};\n", scene.velocities.size(),
                        scene.time.dynamics ? "h * step.change[i]" : "Real(0.0)");
  if (inputs) text += "  add_input_change(input, state, h, r_u, step.change);\n";
  return text;
}

std::string input_change_text(const programs::SceneFacts& scene) {
  if (scene.inputs.empty()) return "";
  return fmt::format(R"(
// Change of the residual over the step by that of the inputs, from the slope of a cubic through four samples.
template <class Real>
void add_input_change(const Input<Real>&, const State<Real>&, const Real&, const Real (&)[{0}][{1}], Real (&)[{0}]) noexcept {{}}
template <class Real, class InputAt>
void add_input_change(const InputAt& sampled, const State<Real>& state, const Real& h, const Real (&r_u)[{0}][{1}],
                      Real (&change)[{0}]) noexcept {{
  State<Real> at = state;
  Input<Real> samples[4];
  for (int k = 0; k < 4; ++k) {{
    at.t = state.t + Real(k) / Real(3.0) * h;
    samples[k] = sampled(at);
  }}
  for (int j = 0; j < {1}; ++j) {{
    const Real difference = Real(9.0) * (samples[1].u[j] - Real(0.5) * samples[2].u[j]) + samples[3].u[j] -
                            Real(5.5) * samples[0].u[j];
    for (int i = 0; i < {0}; ++i) change[i] = change[i] + r_u[i][j] * difference;
  }}
}}
)",
                     scene.velocities.size(), scene.inputs.size());
}

std::string spin_text(const programs::SceneFacts& scene) {
  const auto& quaternions = scene.tangent.quaternions;
  if (quaternions.empty()) return "";
  std::string text = fmt::format(
      "  Real turned[{0}][{0}];  // r_y E\n  for (int i = 0; i < {0}; ++i)\n    for (int j = 0; j < {0}; "
      "++j) turned[i][j] = "
      "step.r_y[i][j];\n  const Real half = Real(0.5) * s;\n",
      scene.velocities.size());
  for (std::size_t k = 0; k < quaternions.size(); ++k)
    text += fmt::format(
        "  {{\n    Real(&e)[4] = step.spin[{0}];\n    for (int i = 0; i < 3; ++i) e[i] = half * state.z[i + "
        "{1}];\n"
        "    e[3] = Real(1.0) / (Real(1.0) + (e[0] * e[0] + e[1] * e[1] + e[2] * e[2]));\n"
        "    const Real back[4] = {{-e[0], -e[1], -e[2], e[3]}};\n"
        "    for (int i = 0; i < {2}; ++i) rotate(back, turned[i] + {1});\n  }}\n",
        k, quaternions[k].velocity, scene.velocities.size());
  return text;
}

std::string rotate_text(const programs::SceneFacts& scene, const std::string& what) {
  std::string text;
  for (std::size_t k = 0; k < scene.tangent.quaternions.size(); ++k)
    text +=
        fmt::format("  rotate(step.spin[{}], {} + {});\n", k, what, scene.tangent.quaternions[k].velocity);
  return text;
}

/// Σ factor[j] u_j.member[i], j < count; empty where all factors are zero.
std::string combination(const std::vector<double>& factors, double scale, std::size_t count,
                        const char* member) {
  std::string text;
  for (std::size_t j = 0; j < count; ++j)
    if (factors[j] != 0) {
      const double factor = scale * factors[j];
      text += factor < 0 ? (text.empty() ? "-" : " - ") : (text.empty() ? "" : " + ");
      const std::string value = fmt::format("u{}.{}[i]", j + 1, member);
      text += std::fabs(factor) == 1 ? value : literal_text(std::fabs(factor)) + " * " + value;
    }
  return text;
}

long combination_operations(const std::vector<double>& factors, double scale, std::size_t count) {
  long operations = 0, terms = 0;
  for (std::size_t j = 0; j < count; ++j)
    if (factors[j] != 0) {
      ++terms;
      operations += std::fabs(scale * factors[j]) != 1;
    }
  return operations + std::max(0L, terms - 1);
}

/// "base + combination", "base − …". Several increments are added to each other first: rounding at the size of
/// the base is the largest there is.
std::string plus(const std::string& base, const std::string& terms) {
  if (terms.empty()) return base;
  if (terms.find(" + ") != std::string::npos || terms.find(" - ") != std::string::npos)
    return fmt::format("{} + ({})", base, terms);
  return terms[0] == '-' ? base + " - " + terms.substr(1) : base + " + " + terms;
}

std::string or_zero(const std::string& terms) { return terms.empty() ? "Real(0.0)" : terms; }

std::string stage_text(const programs::SceneFacts& scene, const Rosenbrock& method, std::size_t i) {
  const std::vector<double>&A = method.A[i], &C = method.C[i];
  const auto line = [](const std::string& target, const std::string& value) {
    return wrapped(target + " = " + value + ";", 4);
  };
  const auto at = [&](const char* member) { return combination(A, 1, i, member); };
  std::string text = fmt::format("  for (int i = 0; i < {}; ++i) {{\n", scene.velocities.size());
  text += line("stage.y[i]", or_zero(at("y")));
  const std::string moved = at("z");
  if (!moved.empty()) text += line("stage.z[i]", moved);
  text += line("stage.state.z[i]", moved.empty() ? "state.z[i]" : "state.z[i] + stage.z[i]");
  text += line("stage.a[i]", plus("accelerations.zdot[i]", at("a")));
  text += line("stage.sum_y[i]", or_zero(combination(C, method.gamma, i, "y")));
  text += line("stage.sum_z[i]", or_zero(combination(C, method.gamma, i, "z")));
  text += "  }\n";
  if (i > 0) {
    if (scene.clock && method.nodes[i] != 0)
      text += fmt::format("  stage.state.t = state.t + {}h;\n",
                          method.nodes[i] == 1 ? "" : literal_text(method.nodes[i]) + " * ");
    text += "  detail::displace(state, stage.y, stage.state);\n";
    for (int k = 0; k < scene.closings && scene.is_reduced; ++k)
      text += "  close_loops(model, stage.state);\n";
  }
  text += fmt::format("  detail::solve_stage(model, step, stage, input, {}u{});\n",
                      has_change(scene) ? literal_text(method.shares[i]) + ", " : "", i + 1);
  return text;
}

bool any_implicit(const std::vector<programs::FunctionInfo>& functions) {
  return std::any_of(functions.begin(), functions.end(),
                     [](const programs::FunctionInfo& f) { return f.stepper && f.stepper->implicit; });
}

}  // namespace

std::string implicit_support(const programs::SceneFacts& scene,
                             const std::vector<programs::FunctionInfo>& functions,
                             const ir::Program* derivatives) {
  if (!any_implicit(functions) || scene.velocities.empty()) return "";
  std::vector<std::size_t> first = {0}, entries;
  for (const std::vector<std::size_t>& list : couplings(scene, *derivatives)) {
    entries.insert(entries.end(), list.begin(), list.end());
    first.push_back(entries.size());
  }
  if (entries.empty()) entries.push_back(0);  // an array has an entry
  const bool inputs = !scene.inputs.empty(), change = has_change(scene);
  const std::size_t n = scene.velocities.size(), quaternions = scene.tangent.quaternions.size();
  const std::string turns = quaternions == 0 ? "" : kTurns;
  return turns + fill(template_text("implicit_step.in"),
                      {{"NZ", fmt::format("{}", n)},
                       {"CHANGE_MEMBER", change ? fmt::format("\n  Real change[{}];  // h dr/dt", n) : ""},
                       {"SPIN_MEMBER",
                        quaternions == 0 ? "" : fmt::format("\n  Real spin[{}][4];  // of E", quaternions)},
                       {"FIRST_COUPLED", fmt::format("{}", fmt::join(first, ", "))},
                       {"COUPLED", fmt::format("{}", fmt::join(entries, ", "))},
                       {"DISPLACE", displace_text(scene.tangent)},
                       {"ROTATION", rotation_text(scene)},
                       {"INPUT_CHANGE", input_change_text(scene)},
                       {"TEMPLATE", inputs ? "template <class Real, class Inputs>" : "template <class Real>"},
                       {"INPUTS", inputs ? "const Inputs&" : "const Input<Real>&"},
                       {"INPUT_AT_START", inputs ? "input_at(input, state)" : "input"},
                       {"INPUT_AT_STAGE", inputs ? "input_at(input, stage.state)" : "input"},
                       {"H_PARAMETER", change ? " const Real& h," : ""},
                       {"SHARE_PARAMETER", change ? " const Real& share," : ""},
                       {"DERIVATIVES", derivatives_text(scene)},
                       {"SPIN", spin_text(scene)},
                       {"R_Y", quaternions == 0 ? "step.r_y" : "turned"},
                       {"CHANGE", change ? " + share * step.change[k]" : ""},
                       {"ROTATE_V", rotate_text(scene, "v")},
                       {"ROTATE_U", rotate_text(scene, "u.y")}});
}

std::string accelerations_struct(const programs::SceneFacts& scene,
                                 const std::vector<programs::FunctionInfo>& functions) {
  if (!any_implicit(functions)) return "";
  std::string text = wrapped_doc(
      "What linearly implicit methods remember: accelerations at the end of the last step. One trajectory "
      "has one; a fresh "
      "one starts from forward_dynamics.",
      0);
  text += "template <class Real = double>\nstruct Accelerations {\n  int count = 0;  ///< 0: fresh\n";
  if (!scene.velocities.empty()) text += fmt::format("  Real zdot[{}] = {{}};\n", scene.velocities.size());
  return text + "};\n\n";
}

std::string rosenbrock_body(const programs::SceneFacts& scene, const Rosenbrock& method) {
  std::string text = fmt::format(
      "  detail::ImplicitStep<Real> step;\n  detail::begin_step(model, state, input, {}{}h, accelerations, "
      "step);\n",
      has_change(scene) ? "h, " : "", method.gamma == 1 ? "" : literal_text(method.gamma) + " * ");
  text += "  detail::Increment<Real> u1";
  for (std::size_t i = 1; i < method.m.size(); ++i) text += fmt::format(", u{}", i + 1);
  text += ";\n  detail::ImplicitStage<Real> stage;\n  stage.state = state;\n";
  for (std::size_t i = 0; i < method.m.size(); ++i) text += stage_text(scene, method, i);
  const bool at_last = ends_at_last_stage(method);
  const auto line = [&](const std::string& target, const std::string& base, const char* member) {
    const std::string increment = at_last ? fmt::format("u{}.{}[i]", method.m.size(), member)
                                          : combination(method.m, 1, method.m.size(), member);
    return wrapped(target + " = " + (base.empty() ? increment : plus(base, increment)) + ";", 4);
  };
  text += fmt::format("  for (int i = 0; i < {}; ++i) {{\n", scene.velocities.size());
  text += line("stage.y[i]", at_last ? "stage.y[i]" : "", "y");
  if (at_last)
    text += wrapped(fmt::format("state.z[i] = state.z[i] + (stage.z[i] + u{}.z[i]);", method.m.size()), 4);
  else
    text += line("state.z[i]", "state.z[i]", "z");
  text += line("accelerations.zdot[i]", at_last ? "stage.a[i]" : "accelerations.zdot[i]", "a");
  text += "  }\n";
  const bool turns = !scene.tangent.quaternions.empty();
  for (const std::size_t entry : scene.dependents)
    text += fmt::format("  state.y[{0}] = stage.state.y[{0}];\n", entry);
  if (turns) text += "  stage.state = state;\n";
  text += fmt::format("  detail::displace({}, stage.y, state);\n", turns ? "stage.state" : "state");
  return scene.clock ? text + "  state.t = state.t + h;\n" : text;
}

long closings_of(const programs::SceneFacts& scene, const Rosenbrock& method) {
  return scene.is_reduced ? scene.closings * static_cast<long>(method.m.size()) - 1 : 0;
}

long rosenbrock_operations(const programs::SceneFacts& scene, const Rosenbrock& method,
                           const ir::Program& derivatives) {
  const long n = static_cast<long>(scene.velocities.size()),
             quaternions = static_cast<long>(scene.tangent.quaternions.size());
  const long scalars = static_cast<long>(scene.tangent.scalars.size());
  const bool change = has_change(scene);
  long pairs = 0, squares = 0;
  for (const auto& list : couplings(scene, derivatives)) {
    pairs += static_cast<long>(list.size());
    squares += static_cast<long>(list.size() * list.size());
  }
  constexpr long kRotate = 26, kTurn = 3 + 24 + programs::kNormaliseOperations, kTurningRate = 26;
  const long displace = scalars + quaternions * kTurn;
  long total = 1 + (method.gamma != 1) + 4 * (n + 2 * pairs) + n + pairs + 2 * squares;
  if (scene.time.dynamics) total += n;
  if (quaternions > 0) total += 1 + quaternions * (3 + 5 + 2 + n * kRotate);
  for (std::size_t i = 0; i < method.m.size(); ++i) {
    const auto own = [&](const std::vector<double>& factors, double scale) {
      return combination_operations(factors, scale, i);
    };
    total += n * (3 * own(method.A[i], 1) + 2 * own(method.C[i], method.gamma));
    if (i > 0) total += displace;
    const bool moves = std::any_of(method.A[i].begin(), method.A[i].end(), [](double a) { return a != 0; });
    if (moves) total += 2 * n;
    if (scene.clock && i > 0 && method.nodes[i] != 0)
      total += programs::kClockOperations + (method.nodes[i] != 1);
    total += 6 * n + quaternions * (kTurningRate + 2 * kRotate);  // c, rate, v
    total +=
        (change ? 6 : 4) * n + 8 * pairs + 4 * pairs + n + 4 * n;  // right-hand side, solution, increments
  }
  total +=
      n * (ends_at_last_stage(method) ? 4 : 3 * combination_operations(method.m, 1, method.m.size()) + 2);
  return total + displace + scene.clock * programs::kClockOperations;
}

}  // namespace jourdain::emit
