#include "readback/struct_members.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "readback/api.hpp"

namespace jourdain::readback {

namespace {

std::vector<FunctionApi> steps(const Expected& expected) {
  std::vector<FunctionApi> list;
  for (const std::string& name : expected.functions)
    if (const auto api = api_of(name, expected); api && api->result == Result::kStep) list.push_back(*api);
  return list;
}

std::string bounds(const std::vector<std::size_t>& extents) {
  std::string text;
  for (const std::size_t extent : extents) text += fmt::format("[{}]", extent);
  return text;
}

Texts output_members(const Expected& expected) {
  Texts texts;
  for (const ExpectedOutput& output : expected.outputs)
    for (const ExpectedMember& member : output.members) {
      std::vector<std::size_t> extents;
      if (member.rows > 1) extents.push_back(static_cast<std::size_t>(member.rows));
      if (member.is_matrix) extents.push_back(static_cast<std::size_t>(member.columns));
      texts.push_back(fmt::format("Real {}{}{}{}", output.name, member.name.empty() ? "" : ".", member.name,
                                  bounds(extents)));
    }
  return texts;
}

Texts state_members(const Expected& expected) {
  Texts texts;
  if (expected.clock) texts.push_back("Time<Real> t");
  if (!expected.positions.empty()) texts.push_back(fmt::format("Real y[{}]", expected.positions.size()));
  if (!expected.velocities.empty()) texts.push_back(fmt::format("Real z[{}]", expected.velocities.size()));
  if (expected.constraints.empty()) return texts;
  texts.insert(texts.end(), {"Real regularity", "Real opening"});
  if (!expected.proven_positions.empty())
    texts.push_back(fmt::format("Real beyond[{}]", expected.proven_positions.size()));
  return texts;
}

Texts members_of(const Unit& unit, const Struct& found, const std::string& prefix = "") {
  Texts texts;
  for (const Member& member : found.members) {
    if (member.is_static) continue;
    const std::string name = prefix + unit.symbols.text(member.declarator.name);
    if (member.anonymous) {
      for (const std::string& text : members_of(unit, *member.anonymous, name + ".")) texts.push_back(text);
      continue;
    }
    Declarator declarator = member.declarator;
    std::string text = text_of(unit, member.type, declarator), array;
    if (const std::size_t bracket = text.find('['); bracket != std::string::npos) {
      array = text.substr(bracket);
      text.resize(bracket);
    }
    texts.push_back(text + " " + name + array);
  }
  return texts;
}

}  // namespace

bool linearizes(const Expected& expected) {
  for (const std::string& name : expected.functions)
    if (name == "linearize") return true;
  return false;
}

std::map<std::string, Texts> struct_members(const Expected& expected) {
  std::map<std::string, Texts> list;
  for (const ExpectedParameter& parameter : expected.parameters)
    list["Parameters"].push_back("Real " + parameter.name);
  list["Parameters"];
  list["State"] = state_members(expected);
  list["Input"];
  if (!expected.inputs.empty()) list["Input"] = {fmt::format("Real u[{}]", expected.inputs.size())};
  if (!expected.outputs.empty()) list["Outputs"] = output_members(expected);
  if (linearizes(expected))
    for (const ArrayArgument& member : linearization_members(expected))
      list["Linearization"].push_back("Real " + member.name + bounds(member.extents));
  if (!expected.user_functions().empty()) list["Functions"];
  const std::size_t ny = expected.positions.size(), nz = expected.velocities.size();
  const bool in_c = expected.choices.language == ir::Language::kC;
  for (const FunctionApi& api : steps(expected)) {
    if (api.history == 0) continue;
    // C has one for each depth.
    Texts& members = list[in_c ? fmt::format("RateHistory{}", api.history) : "RateHistory"];
    const std::string depth = in_c ? fmt::format("{}", api.history) : "depth";
    members = {"int count"};
    if (nz > 0) members.push_back(fmt::format("Real ydot[{}][{}]", depth, ny));
    if (nz > 0) members.push_back(fmt::format("Real zdot[{}][{}]", depth, nz));
  }
  const std::vector<FunctionApi> all = steps(expected);
  if (std::any_of(all.begin(), all.end(), [](const FunctionApi& api) { return api.implicit; })) {
    list["Accelerations"] = {"int count"};
    if (nz > 0) list["Accelerations"].push_back(fmt::format("Real zdot[{}]", nz));
  }
  return list;
}

std::string template_text(const Unit& unit, const Struct& found) {
  std::string text;
  for (const TemplateParameter& parameter : found.parameters_of_template) {
    text += text.empty() ? "" : ", ";
    text += (parameter.is_type ? "class " : "int ") + unit.symbols.text(parameter.name);
    if (parameter.standard) text += " = " + text_of(unit, *parameter.standard);
  }
  return text;
}

std::string unquoted(std::string_view text, bool question_marks) {
  const auto is_escaped = [&](char c) { return c == '"' || c == '\\' || (question_marks && c == '?'); };
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\' && (i + 1 == text.size() || !is_escaped(text[i + 1])))
      return fmt::format("{} (an escape)", text);
    if (question_marks && text[i] == '?') return fmt::format("{} (a trigraph)", text);
    if (text[i] == '\\') ++i;
    plain += text[i];
  }
  return plain;
}

void check_struct(const Unit& unit, const Struct& found, const Texts& wanted, Findings& findings) {
  const std::string name = unit.symbols.text(found.name);
  findings.expect("members of " + name, fmt::format("{}", fmt::join(members_of(unit, found), "; ")),
                  fmt::format("{}", fmt::join(wanted, "; ")));
  findings.expect("template parameters of " + name, template_text(unit, found),
                  name == "RateHistory" ? "int depth, class Real = double" : "class Real = double");
  if (!found.functions.empty()) findings.add("{} has functions", name);
}

}  // namespace jourdain::readback
