#include "compile/expected_text.hpp"

#include "loops/plan/plan_text.hpp"
#include "loops/record/loop_plan.hpp"
#include "model/kinematic_kinds.hpp"
#include "model/names.hpp"

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

void expect_loops(const model::Mechanism& mechanism, const loops::LoopPlan& plan,
                  readback::Expected& expected) {
  for (const std::string& sentence : loops::sentences(mechanism, plan))
    expected.sentences.push_back(sentence);
  expected.least_regularity = plan.least_regularity();
  expected.greatest_opening = plan.greatest_opening();
  if (const loops::ProvenBox* box = plan.proven()) {
    expected.proven_positions = ranges_of(box->positions);
    expected.proven_parameters = ranges_of(box->parameters);
  }
}

readback::ExpectedKinematics expected_kinematics(const model::KinematicFunction& function,
                                                 const programs::SceneFacts& facts) {
  readback::ExpectedKinematics expected{function.name, model::takes_acceleration(function), {}};
  for (const model::KinematicQuantity quantity : function.quantities)
    for (const model::KinematicArray& array : model::quantity_row(quantity).arrays) {
      if (array.if_driven && !facts.time.positions) continue;
      readback::ExpectedArray& declared = expected.arrays.emplace_back();
      declared.name = array.name;
      for (const model::ArrayExtent extent : array.extents)
        declared.extents.push_back(extent == model::ArrayExtent::kThree ? 3
                                   : extent == model::ArrayExtent::kSix ? 6
                                                                        : facts.velocities.size());
    }
  return expected;
}

}  // namespace

readback::Expected expected_text(const model::Mechanism& mechanism, const CompileOptions& options,
                                 const CompiledModel& compiled) {
  readback::Expected expected;
  expected.choices = options.choices;
  expected.name = options.name.empty() ? model::cpp_name(mechanism.name) : options.name;
  expected.title = mechanism.name;
  expected.path = options.path;
  expected.sha256 = options.sha256;
  expected.imported = options.imported;
  const programs::SceneFacts& facts = compiled.facts;
  expected.positions = facts.positions;
  expected.velocities = facts.velocities;
  expected.inputs = facts.inputs;
  for (const model::Parameter& parameter : facts.parameters)
    expected.parameters.push_back({parameter.name, parameter.value, parameter.range});
  for (const programs::OutputFacts& output : facts.outputs) {
    readback::ExpectedOutput& declared =
        expected.outputs.emplace_back(readback::ExpectedOutput{output.name, {}});
    for (const programs::OutputMember& member : output.members)
      declared.members.push_back({member.name, member.rows, member.columns, member.is_matrix});
  }
  for (const model::KinematicFunction& function : mechanism.kinematics)
    expected.kinematics.push_back(expected_kinematics(function, facts));
  expected.constraints = facts.constraints;
  expected.dependents = facts.dependents;
  expected.closings = facts.closings;
  if (options.loops) expect_loops(mechanism, *options.loops, expected);
  expected.scalars = entries_of(facts.tangent.scalars);
  expected.quaternions = entries_of(facts.tangent.quaternions);
  expected.dynamics_depend_on_time = facts.time.dynamics;
  expected.outputs_depend_on_time = facts.time.outputs;
  expected.clock = facts.clock;
  expected.all_derivatives = facts.all_derivatives;
  expected.assumptions = compiled.assumptions;
  expected.sentences.insert(expected.sentences.end(), compiled.assumptions.begin(),
                            compiled.assumptions.end());
  expected.sentences.push_back("SHA-256 " + options.sha256);
  for (const support::FileHash& file : options.imported)
    expected.sentences.push_back("imports " + file.path + ", SHA-256 " + file.sha256);
  if (!mechanism.source.empty()) expected.sentences.push_back("Numbers from: " + mechanism.source);
  expected.backward_error = compiled.verdict.backward_error;
  expected.condition = compiled.verdict.condition;
  for (const programs::FunctionInfo& function : compiled.functions)
    expected.functions.push_back(function.name);
  return expected;
}

}  // namespace jourdain
