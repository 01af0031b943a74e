#include "compile/omissions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "model/snap.hpp"
#include "programs/tree_functions.hpp"

namespace jourdain {

namespace {

struct Switch {
  const char* name;
  const char* what;
  std::function<void(model::Mechanism&, CompileOptions&)> off;
  bool only_pass = false;  ///< needs no other derivation
};

/// Simplifications that can be switched off one by one.
const std::vector<Switch>& switches() {
  static const std::vector<Switch> list = {
      {"base inertial parameters", "what a joint's motion does not feel is counted with the parent",
       [](model::Mechanism&, CompileOptions& o) { o.derivation.link_tree.regroup = false; }},
      {"parallel axes",
       "consecutive parallel joints share one frame and the sine and cosine of the summed angle",
       [](model::Mechanism&, CompileOptions& o) { o.derivation.link_tree.share_parallel = false; }},
      {"snapped rotations", "rotations by multiples of a right angle are permutations",
       [](model::Mechanism& m, CompileOptions&) { m = model::with_directions_as_read(std::move(m)); }},
      {"common factors", "factors that several terms of a sum share are multiplied once",
       [](model::Mechanism&, CompileOptions& o) { o.passes_off.push_back("factor"); }, true},
      {"constant factors", "constant factors of a product are multiplied with each other first",
       [](model::Mechanism&, CompileOptions& o) { o.passes_off.push_back("group_constants"); }, true},
      {"parameter-only values", "values that depend on parameters alone are computed once, with the model",
       [](model::Mechanism&, CompileOptions& o) { o.passes_off.push_back("hoist"); }, true},
  };
  return list;
}

std::size_t forward_operations(const ir::Module& module) {
  const ir::Program* program = ir::find_program(module, ir::FunctionId::kForwardDynamics);
  return program ? ir::count_operations(*program).arithmetic() : 0;
}

/// forward_dynamics on its own, before any pass.
ir::Module forward_module(const dynamics::Equations& equations, const programs::SceneFacts& scene) {
  return programs::lower_functions(
      equations, programs::with_needed({ir::name_of(ir::FunctionId::kForwardDynamics)}, scene));
}

/// Without dear passes, on both sides of a comparison.
std::size_t optimised_operations(const ir::Module& module, const CompileOptions& options) {
  std::vector<std::string> passes_off = passes::uncompared_pass_names();
  passes_off.insert(passes_off.end(), options.passes_off.begin(), options.passes_off.end());
  return forward_operations(passes::optimise(module, passes_off).module);
}

const Switch kElimination = {"elimination from M",
                             "joints are eliminated through articulated bodies where that is cheaper",
                             [](model::Mechanism&, CompileOptions& o) {
                               o.derivation.articulated.assign(o.derivation.articulated.size(), false);
                             }};

/// The operations that the scene would have with gravity.
void add_gravity(model::Mechanism& mechanism, CompileOptions&) { mechanism.gravity = {0.0, 0.0, -9.81}; }

bool is_zero(const model::Vector3& v) { return v[0].is_zero() && v[1].is_zero() && v[2].is_zero(); }

/// What the mass matrix does not need.
void describe_mass_matrix(const CompiledModel& compiled, std::vector<Omission>& list) {
  const ir::Program* program = ir::find_program(compiled.module, ir::FunctionId::kMassMatrix);
  if (!program) return;
  bool constant = true, diagonal = true;
  for (const ir::Output& output : program->outputs) {
    const ir::Node& node = (*program)[output.value];
    const bool literal = node.op == ir::Op::kLiteral;
    constant =
        constant && (literal || node.leaf == ir::LeafKind::kConstant) && ir::operand_count(node.op) == 0;
    diagonal = diagonal && (output.row == output.column || (literal && node.literal == 0));
  }
  if (diagonal) list.push_back({"coupling", "M is diagonal, nothing is factored", 0});
  if (constant)
    list.push_back({"factorisation", "M is constant, its factors are computed with the model", 0});
}

/// Elements that the scene does not have: nothing to count, they never came in.
std::vector<Omission> absent(const model::Mechanism& mechanism, const CompiledModel& compiled) {
  std::vector<Omission> list;
  if (!compiled.facts.has_rate()) list.push_back({"Z", "dy/dt = z, so there is no position_rate", 0});
  if (!compiled.facts.time.any())
    list.push_back({"t",
                    compiled.facts.clock ? "nothing depends on time but what the caller gives"
                                         : "nothing depends on time, states hold none",
                    0});
  const auto none = [&](auto member) {
    return std::all_of(mechanism.joints.begin(), mechanism.joints.end(), [member](const model::Joint& joint) {
      return std::all_of(joint.coordinates.begin(), joint.coordinates.end(),
                         [member](const model::Coordinate& c) { return (c.*member).is_zero(); });
    });
  };
  if (none(&model::Coordinate::stiffness)) list.push_back({"joint springs", "none", 0});
  if (none(&model::Coordinate::damping)) list.push_back({"joint dampers", "none", 0});
  if (compiled.facts.inputs.empty()) list.push_back({"inputs", "none", 0});
  if (model::has_inputs_alone(mechanism)) list.push_back({"frame forces", "none", 0});
  if (mechanism.outputs.empty()) list.push_back({"outputs", "none asked for", 0});
  describe_mass_matrix(compiled, list);
  if (mechanism.parameters.empty()) list.push_back({"parameters", "all numbers are baked in", 0});
  std::string missing;
  for (const programs::FunctionInfo& function : programs::all_functions()) {
    const bool emitted =
        std::any_of(compiled.functions.begin(), compiled.functions.end(),
                    [&](const programs::FunctionInfo& f) { return f.name == function.name; });
    if (!emitted && programs::has_function(function, compiled.facts))
      missing += (missing.empty() ? "" : ", ") + function.name;
  }
  if (!missing.empty()) list.push_back({"functions not asked for", missing, 0});
  return list;
}

}  // namespace

std::vector<Omission> find_omissions(const model::Mechanism& mechanism, const CompileOptions& options,
                                     const dynamics::Equations& equations, const CompiledModel& compiled) {
  if (options.loops) return absent(mechanism, compiled);
  const ir::Module lowered = forward_module(equations, compiled.facts);
  const long with = static_cast<long>(optimised_operations(lowered, options));
  std::vector<Omission> list;
  std::vector<Switch> all = switches();
  if (compiled.articulation.factorised > 0) all.push_back(kElimination);
  if (is_zero(mechanism.gravity)) all.push_back({"gravity", "zero", add_gravity});
  for (const Switch& s : all) {
    model::Mechanism other = mechanism;
    CompileOptions changed = options;
    s.off(other, changed);
    const ir::Module module =
        s.only_pass
            ? lowered
            : forward_module(
                  dynamics::AccelerationWays(other, changed.derivation.link_tree).by(changed.derivation),
                  compiled.facts);
    const long without = static_cast<long>(optimised_operations(module, changed));
    if (without != with) list.push_back({s.name, s.what, without - with});
  }
  for (const Omission& omission : absent(mechanism, compiled)) list.push_back(omission);
  return list;
}

}  // namespace jourdain
