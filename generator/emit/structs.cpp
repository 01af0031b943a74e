#include "emit/structs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "emit/layout.hpp"
#include "emit/names.hpp"
#include "emit/signature.hpp"

namespace jourdain::emit {

std::string output_struct(const ModelText& model) {
  if (model.outputs.empty()) return "";
  std::string text =
      "/// What the model description asks for; lengths in m, angles in rad, forces in N, moments in N "
      "m.\n";
  text += "template <class Real = double>\nstruct Outputs {\n";
  for (const OutputDeclaration& output : model.outputs) {
    std::string members;
    for (const OutputMember& member : output.members) {
      std::string bounds;
      if (member.rows > 1) bounds += fmt::format("[{}]", member.rows);
      if (member.is_matrix) bounds += fmt::format("[{}]", member.columns);
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

std::string guard_members(const SceneShape& scene) {
  if (scene.constraints == 0) return "";
  return "  /// Of what the last closing of the loops solved for: 1 at its best, 0 where it is singular, "
         "negative beyond.\n"
         "  /// Below Model::least_regularity do not trust what follows.\n"
         "  Real regularity = Real(1.0);\n"
         "  /// Square of the distance that the last closing moved the positions, rad or m. Beyond\n"
         "  /// Model::greatest_opening loops may be left open: the step was too long.\n"
         "  Real opening = Real(0.0);\n";
}

bool linearizes(const std::vector<FunctionInfo>& functions) {
  return std::any_of(functions.begin(), functions.end(),
                     [](const FunctionInfo& f) { return f.shape == Shape::kLinearization; });
}

std::string linearization_struct(const std::vector<FunctionInfo>& functions, const SceneShape& scene) {
  for (const FunctionInfo& function : functions)
    if (function.shape == Shape::kLinearization) {
      std::string text = wrapped_doc(
          "With x = (displacements, velocities), nz each, and o the numbers of all outputs in their order, "
          "matrices row by "
          "row: d(dx/dt) = A dx + B du + rate_t dt, do = C dx + D du + output_t dt. The displacement of a "
          "coordinate is its "
          "change, that of a quaternion a small rotation in body axes, dquat = 1/2 quat (0, dtheta).",
          0);
      text += "template <class Real = double>\nstruct Linearization {\n";
      for (const ArrayResult& array : function.arrays)
        if (scene.has(array)) text += fmt::format("  Real {}{};\n", array.name, bounds_of(array, scene));
      return text + "};\n\n";
    }
  return "";
}

}  // namespace jourdain::emit
