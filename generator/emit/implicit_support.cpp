// What linearly implicit steps share.
#include <algorithm>
#include <set>

#include "emit/implicit_step.hpp"
#include "emit/parameters.hpp"
#include "emit/rotations.hpp"

namespace jourdain::emit {

namespace {

using Access = Parameter::Access;

const Expression h = name("h"), s = name("s"), i = name("i"), j = name("j"), k = name("k"), p = name("p"),
                 model = name("model"), state = name("state"), step = name("step"), stage = name("stage"),
                 accelerations = name("accelerations"), first_coupled = name(kFirstCoupled),
                 coupled = name(kCoupled);

/// For each velocity those before it that W couples it with: where M or a derivative of the residual has an
/// entry, where rotations mix columns, and what fills in when rows are eliminated from the last on.
std::vector<std::vector<std::size_t>> couplings(const programs::SceneFacts& scene,
                                                const ir::Program& derivatives) {
  const std::size_t n = scene.velocities.size();
  std::vector<std::set<std::size_t>> before(n);
  const auto couple = [&before](std::size_t a, std::size_t b) {
    if (a != b) before[std::max(a, b)].insert(std::min(a, b));
  };
  for (const ir::Output& output : derivatives.outputs) {
    if (output.name != "M" && output.name != "r_y" && output.name != "r_z") continue;
    const auto row = static_cast<std::size_t>(output.row), column = static_cast<std::size_t>(output.column);
    if (column >= n) continue;  // of what is carried along, which stages know before they solve
    couple(row, column);
    for (const model::Tangent::Scalar& q : scene.tangent.quaternions)
      if (column >= q.velocity && column < q.velocity + 3)
        for (std::size_t axis = 0; axis < 3; ++axis) couple(row, q.velocity + axis);
  }
  for (std::size_t last = n; last-- > 0;)
    for (const std::size_t a : before[last])
      for (const std::size_t b : before[last]) couple(a, b);
  std::vector<std::vector<std::size_t>> lists;
  for (const auto& set : before) lists.emplace_back(set.begin(), set.end());
  return lists;
}

std::vector<Table> coupling_tables(const programs::SceneFacts& scene, const ir::Program& derivatives) {
  Table first{
      "first_coupled",
      "Where in `coupled` the velocities before k that W couples with k begin; they end where those of "
      "k + 1 begin.",
      {0}},
      entries{kCoupled, "", {}};
  for (const std::vector<std::size_t>& list : couplings(scene, derivatives)) {
    entries.entries.insert(entries.entries.end(), list.begin(), list.end());
    first.entries.push_back(entries.entries.size());
  }
  if (entries.entries.empty()) entries.entries.push_back(0);  // an array has an entry
  return {first, entries};
}

/// Over the velocities that are coupled with k.
Statement coupled_loop(const std::string& variable, Statements body) {
  return {Loop{variable, first_coupled[k], first_coupled[k + 1], false, std::move(body)}};
}

Statement add_to(const Expression& target, const Expression& value) { return set(target, target + value); }

std::vector<Struct> structs(const programs::SceneFacts& scene) {
  const std::size_t n = scene.velocities.size(), quaternions = scene.tangent.quaternions.size(),
                    carried = scene.carried.size();
  const auto vectors = [n, carried](std::initializer_list<const char*> names,
                                    std::initializer_list<const char*> of_carried) {
    Members members;
    for (const char* name : names) members.variables.push_back({name, {n}});
    for (const char* name : of_carried)
      if (carried > 0) members.variables.push_back({name, {carried}});
    return members;
  };
  Struct implicit{"ImplicitStep",
                  "What a linearly implicit step solves with, from the state that it starts at. W = M + s "
                  "r_z + s^2 r_y E, "
                  "factored; s = gamma h.",
                  {{{{"s"}, {"W", {n, n}}, {"r_y", {n, n + carried}}, {"r_z", {n, n}}}}}};
  if (residual_changes(scene)) implicit.members.push_back({{{"change", {n}}}, {}, "h dr/dt"});
  if (quaternions > 0) implicit.members.push_back({{{"spin", {quaternions, 4}}}, {}, "of E"});
  return {implicit,
          {"ImplicitStage",
           "Where a stage evaluates: local displacement from the start, change of z, accelerations, sums "
           "over earlier "
           "stages; state.",
           {vectors({"y", "z", "a", "sum_y", "sum_z"}, {"carried", "sum_carried"}),
            {{{"state"}}, struct_type("State")}}},
          {"Increment", "", {vectors({"y", "z", "a"}, {"carried"})}}};
}

/// A run of scalar coordinates whose entries in y and z differ by the same number.
struct Run {
  std::size_t first = 0, end = 0, shift = 0;  ///< entries of z from first to end − 1; y is `shift` further
};

std::vector<Run> scalar_runs(const model::Tangent& tangent) {
  std::vector<Run> runs;
  for (const model::Tangent::Scalar& scalar : tangent.scalars) {
    const std::size_t shift = scalar.position - scalar.velocity;
    if (runs.empty() || runs.back().end != scalar.velocity || runs.back().shift != shift)
      runs.push_back({scalar.velocity, scalar.velocity, shift});
    ++runs.back().end;
  }
  return runs;
}

Function displace(const programs::SceneFacts& scene) {
  const std::size_t n = scene.velocities.size();
  const Expression start = name("start"), displacement = name("displacement");
  Statements body;
  for (const Run& run : scalar_runs(scene.tangent)) {
    const Expression entry = run.shift == 0 ? i : i + run.shift;
    body.push_back({Loop{"i",
                         run.first,
                         run.end,
                         false,
                         {set(state.dot("y")[entry], start.dot("y")[entry] + displacement[i])}}});
  }
  for (const model::Tangent::Scalar& q : scene.tangent.quaternions)
    body.push_back({Call{
        "turn",
        {start.dot("y").from(q.position), displacement.from(q.velocity), state.dot("y").from(q.position)},
        true}});
  return {"displace",
          "`state` moved by `displacement`, which is local to `start`.",
          {{struct_type("State"), "start"},
           {kRealType, "displacement", Access::kRead, {n}},
           {struct_type("State"), "state", Access::kWrite}},
          {},
          body};
}

/// Rates of local displacements: of a rotation those of twice the Gibbs vector.
Function local_rate(const programs::SceneFacts& scene) {
  const std::size_t n = scene.velocities.size();
  const Expression displacement = name("displacement"), z = name("z"), rate = name("rate");
  Statements body = {loop("i", n, {set(rate[i], z[i])})};
  for (const model::Tangent::Scalar& q : scene.tangent.quaternions)
    body.push_back({Call{
        "turning_rate", {displacement.from(q.velocity), z.from(q.velocity), rate.from(q.velocity)}, true}});
  return {"local_rate",
          "",
          {{kRealType, "displacement", Access::kRead, {n}},
           {kRealType, "z", Access::kRead, {n}},
           {kRealType, "rate", Access::kWrite, {n}}},
          {},
          body};
}

Function factorise(std::size_t n) {
  const Expression W = name("W"), q = name("q");
  return {"factorise",
          "W = L D U from its last row on, where only entries between coupled velocities are not zero; D "
          "holds the inverse "
          "pivots.",
          {{kRealType, "W", Access::kWrite, {n, n}}},
          {},
          {{Loop{"k",
                 0,
                 n,
                 true,
                 {set(W[k][k], 1.0 / W[k][k]),
                  coupled_loop(
                      "p", {{Declare{kIntegerType, Declare::Change::kConstant, {{"i", {}, coupled[p]}}}},
                            set(W[i][k], W[i][k] * W[k][k]),
                            coupled_loop("q", {set(W[i][coupled[q]],
                                                   W[i][coupled[q]] - W[i][k] * W[k][coupled[q]])})})}}}}};
}

Function solve(std::size_t n) {
  const Expression W = name("W"), x = name("x"), other = coupled[p];
  return {"solve",
          "",
          {{kRealType, "W", Access::kRead, {n, n}}, {kRealType, "x", Access::kWrite, {n}}},
          {},
          {{Loop{"k", 0, n, true, {coupled_loop("p", {set(x[other], x[other] - W[other][k] * x[k])})}}},
           loop("k", n,
                {coupled_loop("p", {set(x[k], x[k] - W[k][other] * x[other])}), set(x[k], x[k] * W[k][k])})}};
}

Function add_input_change(const programs::SceneFacts& scene) {
  const std::size_t n = scene.velocities.size(), inputs = scene.inputs.size();
  const Expression at = name("at"), samples = name("samples"), r_u = name("r_u"), change = name("change");
  const auto sample = [&](int number) { return samples[number].dot("u")[j]; };
  return {"add_input_change",
          "Change of the residual over the step by that of the inputs, from the slope of a cubic through "
          "four samples.",
          {{struct_type("Input"), "input", Access::kRead, {}, false, true},
           {struct_type("State"), "state"},
           {kRealType, "h"},
           {kRealType, "r_u", Access::kRead, {n, inputs}},
           {kRealType, "change", Access::kWrite, {n}}},
          {},
          {{Declare{struct_type("State"), Declare::Change::kFree, {{"at", {}, state}}}},
           {Declare{struct_type("Input"), Declare::Change::kFree, {{"samples", {4}}}}},
           loop("k", 4,
                {set(at.dot("t"), state.dot("t") + to_real(k) / 3.0 * h), set(samples[k], inputs_at(at))}),
           loop("j", inputs,
                {constant("difference", 9.0 * (sample(1) - 0.5 * sample(2)) + sample(3) - 5.5 * sample(0)),
                 loop("i", n, {add_to(change[i], r_u[i][j] * name("difference"))})})},
          true};
}

/// Derivatives, and the residual's own change over the step.
void add_derivatives(const programs::SceneFacts& scene, Statements& body) {
  const std::size_t n = scene.velocities.size();
  const bool inputs = !scene.inputs.empty();
  const Expression change = step.dot("change"), r_u = name("r_u");
  std::vector<Expression> arguments = {
      model,         state,           inputs_at(state), accelerations.dot("zdot"),
      step.dot("W"), step.dot("r_y"), step.dot("r_z")};
  if (inputs) {
    body.push_back({Declare{kRealType, Declare::Change::kFree, {{"r_u", {n, scene.inputs.size()}}}}});
    arguments.push_back(r_u);
  }
  if (scene.time.dynamics) arguments.push_back(change);
  body.push_back({Call{"residual_derivatives", arguments}});
  if (residual_changes(scene))
    body.push_back(loop("i", n, {set(change[i], scene.time.dynamics ? h * change[i] : Expression(0.0))}));
  if (inputs) body.push_back({Call{"add_input_change", {name("input"), state, h, r_u, change}, true}});
}

/// r_y E, where rotations make E differ from the identity; otherwise r_y. Fills the step's spins.
Expression turned_derivatives(const programs::SceneFacts& scene, Statements& body) {
  const auto& quaternions = scene.tangent.quaternions;
  if (quaternions.empty()) return step.dot("r_y");
  const std::size_t n = scene.velocities.size();
  Expression turned = name("turned");
  body.push_back({Declare{kRealType, Declare::Change::kFree, {{"turned", {n, n}}}, "r_y E"}});
  body.push_back(loop("i", n, {loop("j", n, {set(turned[i][j], step.dot("r_y")[i][j])})}));
  body.push_back(constant("half", 0.5 * s));
  for (std::size_t number = 0; number < quaternions.size(); ++number) {
    const Expression spin = step.dot("spin")[number];
    const std::size_t velocity = quaternions[number].velocity;
    body.push_back({Call{"half_rotation", {name("half"), state.dot("z").from(velocity), spin}, true}});
    body.push_back(loop("i", n, {{Call{"rotate_back", {spin, turned[i].from(velocity)}, true}}}));
  }
  return turned;
}

Parameter inputs_parameter(const programs::SceneFacts& scene) {
  return {struct_type("Input"), "input", Access::kRead, {}, false, !scene.inputs.empty()};
}

Function begin_step(const programs::SceneFacts& scene) {
  const Expression W = step.dot("W"), r_z = step.dot("r_z"), square = name("square");
  Statements body = {
      {AtStart{accelerations.dot("count"),
               0,
               false,
               {{Call{"forward_dynamics", {model, state, inputs_at(state), accelerations.dot("zdot")}}}},
               {}}},
      set(accelerations.dot("count"), 1),
      set(step.dot("s"), s)};
  add_derivatives(scene, body);
  body.push_back(constant("square", s * s));
  const Expression r_y = turned_derivatives(scene, body);
  const auto add = [&](const Expression& row, const Expression& column) {
    return set(W[row][column], W[row][column] + s * r_z[row][column] + square * r_y[row][column]);
  };
  body.push_back(
      loop("k", scene.velocities.size(),
           {add(k, k),
            coupled_loop("p", {{Declare{kIntegerType, Declare::Change::kConstant, {{"i", {}, coupled[p]}}}},
                               add(i, k),
                               add(k, i)})}));
  body.push_back({Call{"factorise", {W}, true}});
  std::vector<Parameter> parameters = {
      {struct_type("Model"), "model"}, {struct_type("State"), "state"}, inputs_parameter(scene)};
  if (residual_changes(scene)) parameters.push_back({kRealType, "h"});
  parameters.push_back({kRealType, "s"});
  parameters.push_back({struct_type("Accelerations"), "accelerations", Access::kWrite});
  parameters.push_back({struct_type("ImplicitStep"), "step", Access::kWrite});
  return {"begin_step", "", parameters, {}, body};
}

/// Increments of what is carried along are explicit: its own derivatives are left out, as W-methods may, so that they
/// are known before the others, on which they act as displacements.
void add_carried(const programs::SceneFacts& scene, const ir::Program& derivatives, Statements& body) {
  if (scene.carried.empty()) return;
  const std::size_t n = scene.velocities.size();
  const Expression ydot = name("ydot"), moved = name("u").dot("carried"), r = name("r");
  body.push_back({Declare{kRealType, Declare::Change::kFree, {{"ydot", {scene.positions.size()}}}}});
  body.push_back({Call{"position_rate", {model, stage.dot("state"), ydot}}});
  for (std::size_t c = 0; c < scene.carried.size(); ++c)
    body.push_back(set(moved[c], step.dot("s") * ydot[scene.carried[c]] + stage.dot("sum_carried")[c]));
  for (const ir::Output& output : derivatives.outputs) {
    const auto row = static_cast<std::size_t>(output.row), column = static_cast<std::size_t>(output.column);
    if (output.name == "r_y" && column >= n)
      body.push_back(add_to(r[row], step.dot("r_y")[row][column] * moved[column - n]));
  }
}

Function solve_stage(const programs::SceneFacts& scene, const ir::Program& derivatives) {
  const Expression nz = name("nz"), r = name("r"), rate = name("rate"), c = name("c"), v = name("v"),
                   u = name("u"), step_s = step.dot("s"), r_y = step.dot("r_y"), r_z = step.dot("r_z");
  const auto rotate_entries = [&](const Expression& vector, Statements& body) {
    for (std::size_t number = 0; number < scene.tangent.quaternions.size(); ++number)
      body.push_back(
          {Call{"rotate",
                {step.dot("spin")[number], vector.from(scene.tangent.quaternions[number].velocity)},
                true}});
  };
  const auto with = [&](const Expression& row, const Expression& column) {
    return set(r[row], r[row] + r_z[row][column] * c[column] + r_y[row][column] * v[column]);
  };
  Statements body = {
      {Declare{kIntegerType, Declare::Change::kNever, {{"nz", {}, velocity_count()}}}},
      {Declare{kRealType, Declare::Change::kFree, {{"r", {nz}}, {"rate", {nz}}, {"c", {nz}}, {"v", {nz}}}}},
      {Call{"residual", {model, stage.dot("state"), inputs_at(stage.dot("state")), stage.dot("a"), r}}},
      {Call{"local_rate", {stage.dot("y"), stage.dot("state").dot("z"), rate}, true}},
      loop("i", nz,
           {set(c[i], step_s * stage.dot("a")[i] + stage.dot("sum_z")[i]),
            set(rate[i], step_s * rate[i] + stage.dot("sum_y")[i]), set(v[i], rate[i] + step_s * c[i])})};
  rotate_entries(v, body);
  add_carried(scene, derivatives, body);
  const Expression own = r[k] + r_z[k][k] * c[k] + r_y[k][k] * v[k];
  body.push_back(
      loop("k", nz,
           {set(r[k], residual_changes(scene) ? own + name("share") * step.dot("change")[k] : own),
            coupled_loop("p", {{Declare{kIntegerType, Declare::Change::kConstant, {{"i", {}, coupled[p]}}}},
                               with(i, k),
                               with(k, i)})}));
  body.push_back({Call{"solve", {step.dot("W"), r}, true}});
  body.push_back(loop("i", nz,
                      {set(u.dot("a")[i], -r[i]), set(u.dot("z")[i], c[i] + step_s * u.dot("a")[i]),
                       set(u.dot("y")[i], rate[i] + step_s * u.dot("z")[i])}));
  rotate_entries(u.dot("y"), body);
  std::vector<Parameter> parameters = {{struct_type("Model"), "model"},
                                       {struct_type("ImplicitStep"), "step"},
                                       {struct_type("ImplicitStage"), "stage"},
                                       inputs_parameter(scene)};
  if (residual_changes(scene)) parameters.push_back({kRealType, "share"});
  parameters.push_back({struct_type("Increment"), "u", Access::kWrite});
  return {
      "solve_stage",
      "Solves for the increments of one stage: with u the increments, S their sums and E the rotation's "
      "part,\n"
      "u_z = s a + S_z + s u_a, u_y = E (s dy/dt + S_y + s u_z), r + r_y u_y + r_z u_z + M u_a + share h "
      "r_t = 0." +
          std::string(scene.carried.empty() ? ""
                                            : "\nWhat is carried along has u = s dy/dt + S, which moves the "
                                              "others, and nothing moves it within the stage."),
      parameters,
      {},
      body};
}

}  // namespace

void add_implicit_support(const programs::SceneFacts& scene, const ir::Program& derivatives,
                          Support& support) {
  const std::size_t n = scene.velocities.size();
  const auto add = [&support](Function function) { support.functions.push_back(std::move(function)); };
  support.structs = structs(scene);
  support.tables = coupling_tables(scene, derivatives);
  if (!scene.tangent.quaternions.empty())
    for (Function& function : rotation_functions()) add(std::move(function));
  add(displace(scene));
  add(local_rate(scene));
  add(factorise(n));
  add(solve(n));
  if (!scene.inputs.empty()) add(add_input_change(scene));
  add(begin_step(scene));
  add(solve_stage(scene, derivatives));
}

}  // namespace jourdain::emit
