#include "emit/cpp/definitions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "emit/cpp/comments.hpp"
#include "emit/layout.hpp"

namespace jourdain::emit::cpp {

namespace {

using Access = Parameter::Access;

/// What stands in front of a function, or of one that the compiler puts into what calls it.
std::string opening(const Function& function, const char* parameters, bool is_step = false) {
  return fmt::format("template <{}> JOURDAIN_FUNCTION{}\n", parameters,
                     function.is_inlined ? " JOURDAIN_INLINED"
                     : is_step           ? " JOURDAIN_STAGES"
                                         : "");
}

constexpr const char* kInputAt = R"(
// Inputs at a stage: held over the step, or sampled there.
template <class Real> JOURDAIN_FUNCTION
const Input<Real>& input_at(const Input<Real>& held, const State<Real>&) noexcept {
  return held;
}
template <class Real, class InputAt> JOURDAIN_FUNCTION
Input<Real> input_at(const InputAt& sampled, const State<Real>& stage) noexcept {
  return sampled(stage);
}
)";

/// `inputs`: what the type of inputs that may be sampled is called; empty: as they are held.
std::string parameter_text(const Parameter& parameter, const std::string& real, const std::string& inputs,
                           bool named, bool in_detail) {
  const std::string& name = named ? parameter.name : "";
  std::string type = type_text(parameter.type, real, {in_detail});
  if (parameter.is_inputs && !inputs.empty()) type = inputs;
  if (parameter.access == Access::kRead) type = "const " + type;
  if (parameter.is_slice) return type + "*" + (named ? " " + name : "");
  if (!parameter.extents.empty())
    return fmt::format("{} (&{})[{}]", type, name, fmt::join(parameter.extents, "]["));
  return type + (parameter.access == Access::kValue ? "" : "&") + (named ? " " + name : "");
}

std::vector<std::string> parameter_texts(const Function& function, const std::string& real,
                                         const std::string& inputs, bool all_named, bool in_detail) {
  std::vector<std::string> list;
  for (const Parameter& parameter : function.parameters)
    list.push_back(parameter_text(parameter, real, inputs,
                                  all_named || mentions(function.body, parameter.name), in_detail));
  return list;
}

std::string head(const Function& function, const std::string& real,
                 const std::vector<std::string>& parameters) {
  const std::string result = function.result ? type_text(*function.result, real, {}) : "void";
  return fmt::format("{} {}({}) noexcept", result, function.name, fmt::join(parameters, ", "));
}

bool may_sample(const Function& function) {
  return std::any_of(function.parameters.begin(), function.parameters.end(),
                     [](const Parameter& p) { return p.is_inputs; });
}

std::string support_function(const Function& function) {
  const bool samples = may_sample(function);
  std::string text = "\n";
  if (!function.comment.empty()) text += prefixed("// ", function.comment);
  if (function.only_sampled) {
    text += opening(function, "class Real") +
            aligned("void " + function.name + "(",
                    parameter_texts({"", "", function.parameters}, "Real", "", false, true), ") noexcept {}");
    text += opening(function, "class Real, class InputAt");
  } else {
    text += opening(function, samples ? "class Real, class Inputs" : "class Real");
  }
  return text +
         aligned("void " + function.name + "(",
                 parameter_texts(function, "Real", function.only_sampled ? "InputAt" : "Inputs", false, true),
                 ") noexcept {") +
         statements_text(function.body, {true, samples}) + "}\n";
}

std::string support_struct(const Struct& of) {
  std::string text = "\n";
  if (!of.comment.empty()) text += wrapped_comment(of.comment);
  text += fmt::format("template <class Real>\nstruct {} {{\n", of.name);
  for (const Members& members : of.members) {
    std::vector<std::string> names;
    for (const Variable& variable : members.variables) names.push_back(declared(variable, {}));
    text += fmt::format("  {} {};{}\n", type_text(members.type, "Real", {true}), fmt::join(names, ", "),
                        members.comment.empty() ? "" : "  // " + members.comment);
  }
  return text + "};\n";
}

}  // namespace

std::string signature(const Function& function, const std::string& real, bool all_named) {
  return head(function, real, parameter_texts(function, real, "", all_named, false));
}

std::string definition(const Function& function) {
  const bool samples = may_sample(function);
  const std::string body = statements_text(function.body, {false, samples});
  if (!samples)
    return "\n" + opening(function, "class Real") + wrapped(signature(function, "Real", false) + " {", 0) +
           body + "}\n";
  std::string arguments;
  for (const Parameter& parameter : function.parameters)
    arguments += (arguments.empty() ? "" : ", ") + parameter.name;
  return "\n// `input` may be a function that gives the Input at the state of a stage.\n" +
         opening(function, "class Real, class InputAt", function.has_stages) +
         wrapped(head(function, "Real", parameter_texts(function, "Real", "InputAt", true, false)) + " {",
                 0) +
         body + "}\n\n" + opening(function, "class Real") +
         wrapped(signature(function, "Real", true) + " {", 0) +
         wrapped(fmt::format("{}<Real, Input<Real>>({});", function.name, arguments), 2) + "}\n";
}

std::string part_definition(const Function& part) {
  return "\n" + opening(part, "class Real") + signature(part, "Real", true) + " {\n" +
         statements_text(part.body, {}) + "}\n";
}

std::string support_text(const Support& support, bool samples_inputs) {
  if (support.functions.empty()) return "";
  std::string text = samples_inputs ? kInputAt : "";
  for (const Struct& of : support.structs) text += support_struct(of);
  for (const Table& table : support.tables) {
    if (!table.comment.empty()) text += "\n" + wrapped_comment(table.comment);
    text += fmt::format(
        "JOURDAIN_FUNCTION inline int {}(int k) noexcept {{\n"
        "  static constexpr int list[] = {{{}}};\n"
        "  return list[k];\n"
        "}}\n",
        table.name, fmt::join(table.entries, ", "));
  }
  for (const Function& function : support.functions) text += support_function(function);
  return text;
}

std::string public_struct(const Struct& of) {
  std::string text = wrapped_doc(of.comment, 0);
  text += fmt::format("template <{}class Real = double>\nstruct {} {{\n", of.has_depth ? "int depth, " : "",
                      of.name);
  for (const Members& members : of.members)
    for (const Variable& variable : members.variables)
      text += fmt::format("  {} {} = {};{}\n", type_text(members.type, "Real", {}), declared(variable, {}),
                          variable.extents.empty() ? expression_text(*variable.value, {}) : "{}",
                          members.comment.empty() ? "" : "  ///< " + members.comment);
  return text + "};\n\n";
}

}  // namespace jourdain::emit::cpp
