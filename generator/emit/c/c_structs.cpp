#include "emit/c/c_structs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "emit/called_functions.hpp"
#include "emit/layout.hpp"
#include "emit/parameters.hpp"
#include "emit/sentences.hpp"
#include "emit/templates.hpp"
#include "emit/unique_names.hpp"
#include "programs/output_names.hpp"

namespace jourdain::emit::c {

namespace {

using programs::FunctionInfo;

std::string remark(const std::string& comment) {
  return comment.empty() ? "" : fmt::format(" /**< {} */", c_safe(comment));
}

/// C has no empty structs.
std::string structure(const std::string& doc, const std::string& members, const std::string& name) {
  return fmt::format("{}typedef struct {{\n{}}} {};\n\n", doc,
                     members.empty() ? "  char none; /**< nothing */\n" : members, name);
}

std::string array(const CNames& names, const char* name, std::size_t entries) {
  return entries == 0 ? "" : fmt::format("  {} {}[{}];\n", names.real(), name, entries);
}

std::string parameters(const CNames& names, const programs::SceneFacts& scene) {
  std::string members;
  for (const model::Parameter& parameter : scene.parameters)
    members += fmt::format("  {} {};{}\n", names.real(), parameter.name, remark(parameter_remark(parameter)));
  return structure(c_doc(fmt::format("Parameters that may change at run time; {} gives the values of the "
                                     "model description.",
                                     names.global("default_parameters")),
                         0),
                   members, names.global("parameters"));
}

std::string state(const CNames& names, const ModelText& model) {
  const programs::SceneFacts& scene = model.facts;
  std::string members = scene.clock ? fmt::format("  {} t;\n", names.global("time")) : "";
  members += array(names, "y", scene.positions.size()) + array(names, "z", scene.velocities.size());
  if (!scene.constraints.empty()) {
    const std::string limits = names.global("");
    members += c_doc(fmt::format("{}", fmt::join(regularity_sentences(model, limits), " ")), 2) +
               fmt::format("  {} regularity;\n", names.real()) + c_doc(opening_sentence(model, limits), 2) +
               fmt::format("  {} opening;\n", names.real());
    if (!model.proven.positions.empty())
      members += c_doc(beyond_sentence(model), 2) + array(names, "beyond", model.proven.positions.size());
  }
  return structure(c_doc(fmt::format("{}", fmt::join(state_sentences(model), " ")), 0), members,
                   names.global("state"));
}

std::string outputs(const CNames& names, const programs::SceneFacts& scene) {
  if (scene.outputs.empty()) return "";
  std::string members;
  for (const programs::OutputFacts& output : scene.outputs) {
    std::string inner;
    for (const programs::OutputMember& member : output.members) {
      const std::string bounds = programs::subscripts(member, member.rows, member.columns);
      if (member.name.empty())
        members += fmt::format("  {} {}{};{}\n", names.real(), output.name, bounds,
                               remark(comment_text(output.comment)));
      else
        inner += fmt::format("    {} {}{};\n", names.real(), member.name, bounds);
    }
    if (!inner.empty())
      members += c_doc(comment_text(output.comment), 2) +
                 fmt::format("  struct {{\n{}  }} {};\n", inner, output.name);
  }
  return structure(
      c_doc("What the model description asks for; lengths in m, angles in rad, forces in N, moments in N m.",
            0),
      members, names.type(struct_type("Outputs")));
}

std::string linearization(const CNames& names, const programs::SceneFacts& scene,
                          const std::vector<FunctionInfo>& functions) {
  for (const FunctionInfo& function : functions) {
    if (function.shape != programs::Shape::kLinearization) continue;
    std::string members;
    for (const programs::ArrayResult& result : function.arrays)
      if (programs::has_entries(scene, result))
        members += fmt::format("  {} {}[{}];\n", names.real(), result.name,
                               fmt::join(extents_of(result, scene), "]["));
    return structure(c_doc(linearization_sentence(scene), 0), members, names.global("linearization"));
  }
  return "";
}

/// What the user defines, as pointers.
std::string user_functions(const CNames& names, const std::vector<support::CalledFunction>& called) {
  if (called.empty()) return "";
  std::string members = "  void *context; /**< goes to each of them */\n";
  for (const support::CalledFunction& function : called) {
    std::string arguments;
    for (const std::string& argument : function.arguments)
      arguments += fmt::format(", {} {}", names.real(), argument);
    members += wrapped(fmt::format("{} (*{})(void *context{});", names.real(), function.member(), arguments) +
                           remark(remark_of(function)),
                       2);
  }
  return structure(
      c_doc(
          fmt::format("What the model calls: set `functions` of a {} before anything but {} is called; that "
                      "leaves it as it is. In SI units.",
                      names.global("model"), names.global("set_model")),
          0),
      members, names.global("functions"));
}

std::string model_struct(const CNames& names, const ModelCode& code, bool has_functions) {
  std::string members = has_functions ? fmt::format("  {} functions;\n", names.global("functions")) : "";
  for (const std::string& constant : code.constants)
    members += fmt::format("  {} {};\n", names.real(), constant);
  return structure(c_doc(fmt::format("What depends on the parameters only, computed once by {}. Changed "
                                     "parameters need that again.",
                                     names.global("set_model")),
                         0),
                   members, names.global("model"));
}

/// Steps that the memories of these functions hold; 0 for a memory without depth.
std::set<int> depths(const Struct& memory, const std::vector<FunctionInfo>& functions) {
  std::set<int> found;
  for (const FunctionInfo& function : functions)
    if (function.stepper && memory.name == "RateHistory" && function.stepper->history > 0)
      found.insert(function.stepper->history);
  if (found.empty()) found.insert(0);
  return found;
}

std::string extent_text(const Expression& extent, int depth) {
  if (extent.kind == Expression::Kind::kName) return fmt::format("{}", depth);
  return fmt::format("{}", static_cast<long>(extent.number));
}

std::string memories(const CNames& names, const ModelCode& code, const std::vector<FunctionInfo>& functions) {
  std::string text;
  for (const Struct& memory : code.memories)
    for (const int depth : depths(memory, functions)) {
      std::string members, comment = memory.comment;
      for (const Members& list : memory.members)
        for (const Variable& variable : list.variables) {
          std::string bounds;
          for (const Expression& extent : variable.extents)
            bounds += fmt::format("[{}]", extent_text(extent, depth));
          members += fmt::format("  {} {}{};{}\n", names.type(list.type), variable.name, bounds,
                                 remark(list.comment));
        }
      if (const std::size_t at = comment.find("`depth`"); at != std::string::npos)
        comment.replace(at, std::string("`depth`").size(), fmt::format("{}", depth));
      text += structure(c_doc(comment + " A fresh one is {0}.", 0), members,
                        names.type({Type::Kind::kStruct, memory.name, false, depth}));
    }
  return text;
}

}  // namespace

std::string c_counts(const CNames& names, const ModelText& model) {
  const programs::SceneFacts& scene = model.facts;
  std::string text = "enum {\n";
  const auto count = [&](const char* what, std::size_t number, const char* end) {
    text += fmt::format("  {} = {}{}\n", names.count(what), number, end);
  };
  count("position", scene.positions.size(), ",");
  count("velocity", scene.velocities.size(), ",");
  count("input", scene.inputs.size(), ",");
  count("output", scene.outputs.size(), ",");
  if (!scene.constraints.empty()) count("constraint", scene.constraints.size(), ",");
  if (!model.proven.positions.empty()) count("range", model.proven.positions.size(), ",");
  count("parameter", scene.parameters.size(), "");
  text += "};\n\n";
  std::vector<std::string> lines, examples;
  const auto add = [&](const char* array, const char* letter, const std::vector<std::string>& of) {
    const std::vector<std::string> indices = unique_names(letter, of);
    for (std::size_t i = 0; i < indices.size(); ++i)
      lines.push_back(fmt::format("  {} = {}", names.global(indices[i]), i));
    if (!indices.empty()) examples.push_back(fmt::format("{}[{}]", array, names.global(indices[0])));
  };
  add("state.y", "y_", scene.positions);
  add("state.z", "z_", scene.velocities);
  add("input.u", "u_", scene.inputs);
  if (lines.empty()) return text;
  return text + c_comment(fmt::format("Entries by name: {}.", fmt::join(examples, ", ")), 0) +
         fmt::format("enum {{\n{}\n}};\n\n", fmt::join(lines, ",\n"));
}

std::string c_name_arrays(const CNames& names, const programs::SceneFacts& scene, bool defined) {
  std::string text;
  const auto add = [&](const char* of, const std::vector<std::string>& entries) {
    std::string line = fmt::format("{}const char *const {}[{}]", defined ? "" : "extern ",
                                   names.global(fmt::format("{}_names", of)), entries.size() + 1);
    if (defined) {
      line += " = {";
      for (const std::string& entry : entries) {
        std::string quoted;
        for (const char c : quoted_text(entry)) quoted += c == '?' ? "\\?" : std::string(1, c);
        line += fmt::format("\"{}\", ", quoted);
      }
      line += "0}";
    }
    text += wrapped(line + ";", 0);
  };
  std::vector<std::string> outputs, parameters;
  for (const programs::OutputFacts& output : scene.outputs) outputs.push_back(output.name);
  for (const model::Parameter& parameter : scene.parameters) parameters.push_back(parameter.name);
  add("position", scene.positions);
  add("velocity", scene.velocities);
  if (!scene.constraints.empty()) add("constraint", scene.constraints);
  add("input", scene.inputs);
  add("output", outputs);
  add("parameter", parameters);
  return text;
}

std::string c_structs(const CNames& names, const ModelText& model, const ModelCode& code,
                      const std::vector<FunctionInfo>& functions,
                      const std::vector<support::CalledFunction>& called) {
  const programs::SceneFacts& scene = model.facts;
  std::string text = parameters(names, scene);
  if (scene.clock)
    text += fill(template_text("c_time.h.in"), {{"N", names.global("")}, {"REAL", names.real()}}) + "\n";
  text += state(names, model);
  text +=
      structure(c_doc("Inputs: forces of the actuators (N m, N) and what the model's expressions take.", 0),
                array(names, "u", scene.inputs.size()), names.global("input"));
  text += outputs(names, scene) + linearization(names, scene, functions) + user_functions(names, called) +
          model_struct(names, code, !called.empty());
  return text + memories(names, code, functions);
}

std::string c_internal_struct(const CNames& names, const Struct& of) {
  std::string members;
  for (const Members& list : of.members) {
    std::vector<std::string> variables;
    for (const Variable& variable : list.variables) {
      std::string text = variable.name;
      for (const Expression& extent : variable.extents) text += fmt::format("[{}]", extent_text(extent, 0));
      variables.push_back(text);
    }
    members += fmt::format("  {} {};{}\n", names.type(list.type), fmt::join(variables, ", "),
                           list.comment.empty() ? "" : fmt::format(" /* {} */", list.comment));
  }
  return (of.comment.empty() ? "" : c_comment(of.comment, 0)) +
         fmt::format("typedef struct {{\n{}}} {};\n", members, names.type({Type::Kind::kStruct, of.name}));
}

std::string c_limits(const CNames& names, const ModelText& model, bool defined) {
  if (model.facts.constraints.empty()) return "";
  const auto limit = [&](const char* name, double value, bool is_proven) {
    const std::string declared = fmt::format("const {} {}", names.real(), names.global(name));
    return defined ? fmt::format("{} = {};\n", declared, names.literal(value))
                   : fmt::format("extern {}; /**< see {}; {} */\n", declared, names.global("state"),
                                 is_proven ? "proven" : "chosen");
  };
  return limit("least_regularity", model.least_regularity, false) +
         limit("greatest_opening", model.greatest_opening, model.opening_is_proven) + "\n";
}

}  // namespace jourdain::emit::c
