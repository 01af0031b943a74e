#include "emit/cpp/structs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "emit/cpp/comments.hpp"
#include "emit/cpp/printer.hpp"
#include "emit/layout.hpp"
#include "emit/parameters.hpp"
#include "emit/sentences.hpp"
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

std::string guard_members(const ModelText& model) {
  if (model.facts.constraints.empty()) return "";
  std::string text;
  for (const std::string& sentence : regularity_sentences(model, "Model::")) text += wrapped_doc(sentence, 2);
  text += "  Real regularity = Real(1.0);\n" + wrapped_doc(opening_sentence(model, "Model::"), 2) +
          "  Real opening = Real(0.0);\n";
  if (model.proven.positions.empty()) return text;
  return text + wrapped_doc(beyond_sentence(model), 2) +
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
  return wrapped_doc(proven_sentence(), 2) +
         "  JOURDAIN_FUNCTION static bool loops_proven(const Parameters& parameters) noexcept {\n" +
         wrapped(fmt::format("return {};", conditions), 4) + "  }\n";
}

}  // namespace

std::string guard_functions(const ModelText& model) {
  if (model.facts.constraints.empty()) return "";
  std::string text = "\n" + wrapped_doc(closed_sentence(), 2) +
                     "  JOURDAIN_FUNCTION static bool loops_closed(const State& state) noexcept {\n";
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
      std::string text = wrapped_doc(linearization_sentence(scene), 0);
      text += "template <class Real = double>\nstruct Linearization {\n";
      for (const programs::ArrayResult& array : function.arrays)
        if (programs::has_entries(scene, array))
          text += fmt::format("  Real {}[{}];\n", array.name, fmt::join(extents_of(array, scene), "]["));
      return text + "};\n\n";
    }
  return "";
}

}  // namespace jourdain::emit::cpp
