#include "compile/expected_text.hpp"

#include "loops/plan/plan_text.hpp"
#include "loops/record/loop_plan.hpp"
#include "model/coordinates.hpp"
#include "model/names.hpp"
#include "model/time_dependence.hpp"
#include "programs/closed_system.hpp"
#include "programs/loop_outputs.hpp"

namespace jourdain {

namespace {

std::vector<readback::ExpectedTangent> entries_of(const std::vector<model::Tangent::Scalar>& list) {
  std::vector<readback::ExpectedTangent> entries;
  for (const model::Tangent::Scalar& entry : list) entries.push_back({entry.position, entry.velocity});
  return entries;
}

std::vector<readback::ExpectedRange> ranges_of(const std::vector<loops::ProvenRange>& list) {
  std::vector<readback::ExpectedRange> ranges;
  for (const loops::ProvenRange& range : list) ranges.push_back({range.index, range.low, range.high});
  return ranges;
}

void expect_loops(const model::Mechanism& mechanism, const loops::LoopPlan& plan, const model::Tangent& tree,
                  readback::Expected& expected) {
  expected.constraints = loops::row_names(mechanism);
  expected.dependents = programs::dependent_positions(plan, tree);
  expected.closings = plan.closings();
  for (const std::string& sentence : loops::sentences(mechanism, plan))
    expected.sentences.push_back(sentence);
  expected.least_regularity = plan.least_regularity();
  expected.greatest_opening = plan.greatest_opening();
  if (const loops::ProvenBox* box = plan.proven()) {
    expected.proven_positions = ranges_of(box->positions);
    expected.proven_parameters = ranges_of(box->parameters);
  }
  if (!plan.is_reduced()) return;
  std::vector<std::string> independent;
  for (const std::size_t k : plan.independent) independent.push_back(expected.velocities.at(k));
  expected.velocities = independent;
}

void expect_outputs(const model::Mechanism& mechanism, const CompileOptions& options,
                    const dynamics::Equations& equations, readback::Expected& expected) {
  const auto outputs = options.loops ? programs::resized_outputs(mechanism, *options.loops, equations.outputs)
                                     : equations.outputs;
  for (std::size_t k = 0; k < mechanism.outputs.size(); ++k) {
    readback::ExpectedOutput& output = expected.outputs.emplace_back();
    output.name = mechanism.outputs[k].name;
    for (const dynamics::OutputValues& member : outputs[k])
      output.members.push_back({member.member, member.rows, member.columns, member.is_matrix});
  }
}

}  // namespace

readback::Expected expected_text(const model::Mechanism& mechanism, const CompileOptions& options,
                                 const dynamics::Equations& equations, const CompiledModel& compiled) {
  readback::Expected expected;
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  const model::Tangent tree = model::tangent_of(mechanism, layout);
  expected.name = options.name.empty() ? model::cpp_name(mechanism.name) : options.name;
  expected.title = mechanism.name;
  expected.path = options.path;
  expected.sha256 = options.sha256;
  expected.positions = layout.position_names;
  expected.velocities = layout.velocity_names;
  expected.inputs = layout.input_names;
  for (const model::Parameter& parameter : mechanism.parameters)
    expected.parameters.push_back({parameter.name, parameter.value, parameter.range});
  expect_outputs(mechanism, options, equations, expected);
  if (options.loops) expect_loops(mechanism, *options.loops, tree, expected);
  const model::Tangent tangent = options.loops && options.loops->is_reduced()
                                     ? programs::independent_tangent(*options.loops, tree)
                                     : tree;
  expected.scalars = entries_of(tangent.scalars);
  expected.quaternions = entries_of(tangent.quaternions);
  const model::TimeDependence time = model::time_dependence(mechanism);
  expected.dynamics_depend_on_time = time.dynamics;
  expected.outputs_depend_on_time = time.outputs;
  expected.clock = shape_of(mechanism).clock || options.clock;
  expected.all_derivatives = options.derivative_terms == programs::DerivativeTerms::kAll;
  expected.assumptions = compiled.assumptions;
  expected.sentences.insert(expected.sentences.end(), compiled.assumptions.begin(),
                            compiled.assumptions.end());
  expected.sentences.push_back("SHA-256 " + options.sha256);
  if (!mechanism.source.empty()) expected.sentences.push_back("Numbers from: " + mechanism.source);
  expected.backward_error = compiled.verdict.backward_error;
  expected.condition = compiled.verdict.condition;
  for (const programs::FunctionInfo& function : compiled.functions)
    expected.functions.push_back(function.name);
  return expected;
}

}  // namespace jourdain
