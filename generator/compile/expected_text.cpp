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
  readback::ExpectedKinematics expected{function.name,
                                        model::takes_acceleration(function) && !facts.velocities.empty(),
                                        facts.motions_take_inputs && model::holds_accelerations(function),
                                        {}};
  for (const model::KinematicQuantity quantity : function.quantities)
    for (const model::KinematicArray& array : model::quantity_row(quantity).arrays) {
      if (array.is_drift && !facts.time.drift) continue;
      readback::ExpectedArray& declared = expected.arrays.emplace_back();
      declared.name = array.name;
      for (const model::ArrayExtent extent : array.extents)
        declared.extents.push_back(extent == model::ArrayExtent::kThree ? 3
                                   : extent == model::ArrayExtent::kSix ? 6
                                                                        : facts.velocities.size());
    }
  return expected;
}

std::vector<readback::ExpectedVariable> expected_variables(const std::vector<programs::Variable>& table) {
  std::vector<readback::ExpectedVariable> list;
  for (const programs::Variable& variable : table) {
    readback::ExpectedVariable& expected = list.emplace_back();
    expected.name = variable.name;
    expected.role = role_name(variable.role);
    expected.quantity = quantity_name(variable.quantity);
    expected.unit = variable.unit;
    expected.description = variable.description;
    expected.index = variable.index;
    expected.rows = variable.rows;
    expected.columns = variable.columns;
    expected.is_array = variable.is_array;
    expected.numbers = variable.numbers;
    expected.start = variable.start;
    expected.range = variable.range;
    if (variable.derivative_of) expected.derivative_of = table[*variable.derivative_of].name;
  }
  return list;
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
  expected.options = options.words;
  const programs::SceneFacts& facts = compiled.facts;
  expected.positions = facts.positions;
  expected.velocities = facts.velocities;
  expected.states = facts.states.size();
  expected.has_samples = *programs::sampling(facts) != '\0';
  expected.inputs = facts.inputs;
  for (const model::Parameter& parameter : facts.parameters)
    expected.parameters.push_back({parameter.name, parameter.value, parameter.range});
  expected.variables =
      expected_variables(programs::variables_of(mechanism, options.loops ? &*options.loops : nullptr, facts));
  for (const programs::OutputFacts& output : facts.outputs) {
    readback::ExpectedOutput& declared =
        expected.outputs.emplace_back(readback::ExpectedOutput{output.name, {}});
    for (const programs::OutputMember& member : output.members)
      declared.members.push_back({member.name, member.rows, member.columns, member.is_matrix});
  }
  for (const model::KinematicFunction& function : mechanism.kinematics)
    expected.kinematics.push_back(expected_kinematics(function, facts));
  expected.constraints = facts.constraints;
  expected.is_reduced = facts.is_reduced;
  expected.dependents = facts.dependents;
  expected.carried = facts.carried;
  expected.closings = facts.closings;
  if (options.loops) expect_loops(mechanism, *options.loops, expected);
  expected.scalars = entries_of(facts.tangent.scalars);
  expected.quaternions = entries_of(facts.tangent.quaternions);
  expected.motions_take_inputs = facts.motions_take_inputs;
  expected.dynamics_depend_on_time = facts.time.dynamics;
  expected.outputs_depend_on_time = facts.time.outputs;
  expected.clock = facts.clock;
  expected.rate_is_velocity = !facts.has_rate();
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
