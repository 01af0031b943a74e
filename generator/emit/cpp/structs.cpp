#include "emit/cpp/structs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "emit/cpp/layout.hpp"
#include "emit/cpp/printer.hpp"
#include "emit/parameters.hpp"
#include "programs/output_names.hpp"

namespace jourdain::emit::cpp {

std::string output_struct(const ModelText& model) {
  if (model.facts.outputs.empty()) return "";
  std::string text =
      "/// What the model description asks for; lengths in m, angles in rad, forces in N, moments in N "
      "m.\n";
  text += "template <class Real = double>\nstruct Outputs {\n";
  for (const programs::OutputFacts& output : model.facts.outputs) {
    std::string members;
    for (const programs::OutputMember& member : output.members) {
      const std::string bounds = programs::subscripts(member, member.rows, member.columns);
      if (member.name.empty())
        text += fmt::format("  Real {}{};  ///< {}\n", output.name, bounds, comment_text(output.comment));
      else
        members += fmt::format("    Real {}{};\n", member.name, bounds);
    }
    if (!members.empty())
      text += wrapped_doc(comment_text(output.comment), 2) +
              fmt::format("  struct {{\n{}  }} {};\n", members, output.name);
  }
  return text + "};\n\n";
}

namespace {

const char* opening_comment(const ModelText& model) {
  if (model.opening_is_proven)
    return "Square of the distance that the first iterations of the last closing moved the positions, rad or "
           "m. Up to Model::greatest_opening they are proven to end on the branch (see above), where no step "
           "errs by more than the distance to other solutions. Beyond it nothing is: the step was too long.";
  return "Square of the distance that the last closing moved the positions, rad or m. Beyond "
         "Model::greatest_opening loops may be left open: the step was too long.";
}

}  // namespace

std::string guard_members(const ModelText& model) {
  if (model.facts.constraints.empty()) return "";
  std::string text =
      "  /// Of what the last closing of the loops solved for: 1 at its best, 0 where it is singular, "
      "negative beyond.\n"
      "  /// Below Model::least_regularity, or not a number, do not trust what follows.\n"
      "  Real regularity = Real(1.0);\n" +
      wrapped_doc(opening_comment(model), 2) + "  Real opening = Real(0.0);\n";
  if (model.proven.positions.empty()) return text;
  std::string ranges;
  for (const loops::ProvenRange& range : model.proven.positions)
    ranges += fmt::format("{}{} from {} to {}", ranges.empty() ? "" : ", ",
                          model.facts.positions[range.index], range.low, range.high);
  return text +
         wrapped_doc(fmt::format("(y - low) (y - high) after the last closing: positive where a position is "
                                 "outside the range for which how loops are closed is proven. {}.",
                                 comment_text(ranges)),
                     2) +
         fmt::format("  Real beyond[{}] = {{}};\n", model.proven.positions.size());
}

std::string guard_limits(const ModelText& model) {
  if (model.facts.constraints.empty()) return "";
  const std::string ranges =
      model.proven.positions.empty()
          ? ""
          : fmt::format("  static constexpr int range_count = {};\n", model.proven.positions.size());
  return fmt::format(
      "  static constexpr int constraint_count = {};\n"
      "  static constexpr double least_regularity = {};  ///< see State; chosen\n"
      "  static constexpr double greatest_opening = {};  ///< see State; {}\n{}",
      model.facts.constraints.size(), model.least_regularity, model.greatest_opening,
      model.opening_is_proven ? "proven" : "chosen", ranges);
}

namespace {

std::string proven_function(const ModelText& model) {
  if (model.proven.parameters.empty()) return "";
  std::string conditions;
  for (const loops::ProvenRange& range : model.proven.parameters)
    conditions += fmt::format("{0}parameters.{1} >= {2} && parameters.{1} <= {3}",
                              conditions.empty() ? "" : " && ", model.facts.parameters[range.index].name,
                              literal_text(range.low), literal_text(range.high));
  return wrapped_doc(
             "Does what is proven of the loops (see above) hold at these parameters? Those that the "
             "constraints depend on must be in their declared ranges; without one a parameter must have its "
             "default value. Elsewhere nothing is known.",
             2) +
         "  static bool loops_proven(const Parameters& parameters) noexcept {\n" +
         wrapped(fmt::format("return {};", conditions), 4) + "  }\n";
}

}  // namespace

std::string guard_functions(const ModelText& model) {
  if (model.facts.constraints.empty()) return "";
  std::string text = "\n" +
                     wrapped_doc(
                         "Did the last closing of the loops go well, by all that State says of it? No where "
                         "something is not finite.",
                         2) +
                     "  static bool loops_closed(const State& state) noexcept {\n";
  if (!model.proven.positions.empty())
    text += "    for (const Real& excess : state.beyond)\n      if (!(excess <= Real(0.0))) return false;\n";
  text +=
      "    return state.regularity >= Real(least_regularity) && state.opening <= Real(greatest_opening);\n"
      "  }\n";
  return text + proven_function(model);
}

bool linearizes(const std::vector<programs::FunctionInfo>& functions) {
  return std::any_of(functions.begin(), functions.end(), [](const programs::FunctionInfo& f) {
    return f.shape == programs::Shape::kLinearization;
  });
}

std::string linearization_struct(const std::vector<programs::FunctionInfo>& functions,
                                 const programs::SceneFacts& scene) {
  for (const programs::FunctionInfo& function : functions)
    if (function.shape == programs::Shape::kLinearization) {
      std::string text = wrapped_doc(
          fmt::format("With x = (displacements, velocities), nz each, and o the numbers of all outputs in "
                      "their order, matrices row by row: d(dx/dt) = A dx + B du{}, do = C dx + D du{}. The "
                      "displacement of a coordinate is its change, that of a quaternion a small rotation in "
                      "body axes, dquat = 1/2 quat (0, dtheta).",
                      scene.time.dynamics ? " + rate_t dt" : "", scene.time.outputs ? " + output_t dt" : ""),
          0);
      text += "template <class Real = double>\nstruct Linearization {\n";
      for (const programs::ArrayResult& array : function.arrays)
        if (programs::has_entries(scene, array))
          text += fmt::format("  Real {}[{}];\n", array.name, fmt::join(extents_of(array, scene), "]["));
      return text + "};\n\n";
    }
  return "";
}

}  // namespace jourdain::emit::cpp
