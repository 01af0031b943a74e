// Declarations, definitions, instantiations, and the operations that comments state.
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "readback/api.hpp"
#include "readback/header_check.hpp"

namespace jourdain::readback {

namespace {

/// Words of a comment, separated by single spaces.
std::string words(const std::string& comment) {
  std::string text;
  for (const char c : comment) {
    const bool is_space = c == ' ' || c == '\n' || c == '\t' || c == '\r';
    if (!is_space)
      text += c;
    else if (!text.empty() && text.back() != ' ')
      text += ' ';
  }
  return text;
}

std::string operations_sentence(const ir::Operations& count) {
  return fmt::format("{} operations ({} mul, {} add and sub, {} div), {} sin and cos{}.", count.arithmetic(),
                     count.multiply, count.add + count.subtract, count.divide, count.sin + count.cos,
                     count.atan2 == 0 ? "" : fmt::format(", {} atan2", count.atan2));
}

/// The comment must end with the sentence (a step's may go on), and state operations nowhere else.
void check_comment(const Function& function, const std::string& name, const std::string& sentence,
                   Findings& findings) {
  const std::string text = words(function.comment) + " ";
  const std::size_t at = text.find(" " + sentence + " ");
  const std::size_t first = text.find(" operations"), last = text.rfind(" operations");
  if (at == std::string::npos || first != last)
    findings.add("the comment of {} does not say '{}'", name, sentence);
}

std::string template_text(const Unit& unit, const Function& function) {
  std::string text;
  for (const TemplateParameter& parameter : function.parameters_of_template)
    text += (text.empty() ? "" : ", ") + unit.symbols.text(parameter.name);
  return text;
}

/// With inputs a step is written for a function that samples them, and once more for held ones.
std::vector<std::string> definitions(const FunctionApi& api, const Expected& expected) {
  std::vector<std::string> list;
  const std::string held = api.signature(expected, "Real");
  if (api.result == Result::kStep && !expected.inputs.empty() && !expected.velocities.empty()) {
    std::string sampled = held;
    const std::string type = "const Input<Real>&";
    sampled.replace(sampled.find(type), type.size(), "const InputAt&");
    list.push_back("Real, InputAt: " + sampled);
  }
  list.push_back("Real: " + held);
  return list;
}

void compare(const std::string& what, const std::vector<std::string>& found,
             const std::vector<std::string>& wanted, Findings& findings) {
  for (std::size_t i = 0; i < std::max(found.size(), wanted.size()); ++i) {
    const std::string is = i < found.size() ? found[i] : "nothing",
                      must = i < wanted.size() ? wanted[i] : "nothing";
    if (is != must) return findings.add("{} {}: '{}' must be '{}'", what, i + 1, is, must);
  }
}

void check_comments(const Unit& unit, const Expected& expected, Findings& findings) {
  for (const Function* function : unit.functions) {
    if (function->place.file != 0 || function->body) continue;
    const std::string& name = unit.symbols.text(function->name);
    if (const auto it = findings.counts.find(name); it != findings.counts.end())
      check_comment(*function, name, operations_sentence(it->second), findings);
    if (const auto it = findings.steps.find(name); it != findings.steps.end() && !expected.velocities.empty())
      check_comment(*function, name, fmt::format("{} operations.", it->second.operations), findings);
  }
}

}  // namespace

void check_declarations(const Unit& unit, const Expected& expected, Findings& findings) {
  std::vector<std::string> wanted, bodies, instances, found, defined, instantiated;
  for (const std::string& name : expected.functions) {
    const std::optional<FunctionApi> api = api_of(name, expected);
    if (!api) continue;
    wanted.push_back("Real: " + api->signature(expected, "Real"));
    for (const std::string& definition : definitions(*api, expected)) bodies.push_back(definition);
    for (const char* real : {"double", "float"}) instances.push_back(api->signature(expected, real));
  }
  for (const Function* function : unit.functions) {
    if (function->scope == "detail" && function->place.file == 1 && function->body) continue;
    const std::string text = fmt::format("{}{}: {}", function->is_inline ? "inline " : "",
                                         template_text(unit, *function), signature_of(unit, *function));
    if (function->is_constructor && function->place.file == 1)
      findings.expect("the constructor's template", template_text(unit, *function), "Real");
    else if (function->place.file == 0 && !function->body)
      found.push_back(text);
    else if (function->place.file == 1 && function->body)
      defined.push_back(text);
    else
      findings.add("'{}' does not belong there", text);
  }
  for (const Function* function : unit.instantiations) instantiated.push_back(signature_of(unit, *function));
  compare("declaration", found, wanted, findings);
  compare("definition", defined, bodies, findings);
  compare("instantiation", instantiated, instances, findings);
  std::vector<std::string> structs;
  for (const TypeName& type : unit.struct_instantiations) structs.push_back(text_of(unit, type));
  compare("instantiation of a struct", structs, {"Model<double>", "Model<float>"}, findings);
  check_comments(unit, expected, findings);
}

}  // namespace jourdain::readback
