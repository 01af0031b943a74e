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
  return fmt::format("{} operations ({} mul, {} add and sub, {} div), {} sin and cos{}{}{}.",
                     count.arithmetic(), count.multiply, count.add + count.subtract, count.divide,
                     count.sin + count.cos, count.atan2 == 0 ? "" : fmt::format(", {} atan2", count.atan2),
                     count.functions == 0 ? "" : fmt::format(", {} other functions", count.functions),
                     count.selections == 0 ? "" : fmt::format(", {} selections", count.selections));
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

bool may_sample(const FunctionApi& api, const Expected& expected) {
  return api.result == Result::kStep && !expected.inputs.empty() && !expected.velocities.empty();
}

/// A step for a function of the state in place of an input.
std::string sampled_signature(const FunctionApi& api, const Expected& expected) {
  std::string text = api.signature(expected, "Real");
  const bool in_c = expected.choices.language == ir::Language::kC;
  const std::string type = in_c ? "const Input<Real>*" : "const Input<Real>&";
  text.replace(text.find(type), type.size(), "const InputAt&");
  if (in_c) text.insert(text.find('('), "_sampled");
  return "Real, InputAt: " + text;
}

/// With inputs a step is written for a function that samples them, and once more for held ones.
std::vector<std::string> definitions(const FunctionApi& api, const Expected& expected) {
  std::vector<std::string> list;
  if (may_sample(api, expected)) list.push_back(sampled_signature(api, expected));
  list.push_back("Real: " + api.signature(expected, "Real"));
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

/// Of functions that C has beside those of the API.
std::string parameter_names_of_c(const std::string& name, const Expected& expected) {
  if (name == "set_model") return "model, parameters";
  if (name == "default_parameters" || name == "loops_proven") return "parameters";
  if (name == "loops_closed") return "state";
  const std::string sampled = "_sampled";
  if (!name.ends_with(sampled)) return "";
  const auto api = api_of(name.substr(0, name.size() - sampled.size()), expected);
  if (!api) return "";
  std::vector<std::string> names = api->parameter_names();
  std::replace(names.begin(), names.end(), std::string("input"), std::string("input_at"));
  return fmt::format("{}", fmt::join(names, ", "));
}

void check_parameter_names(const Unit& unit, const Function& function, const Expected& expected,
                           Findings& findings) {
  const std::string& name = unit.symbols.text(function.name);
  std::vector<std::string> names;
  for (const Parameter& parameter : function.parameters)
    names.push_back(unit.symbols.text(parameter.declarator.name));
  if (const std::optional<FunctionApi> api = api_of(name, expected))
    findings.expect("names of the parameters of " + name, fmt::format("{}", fmt::join(names, ", ")),
                    fmt::format("{}", fmt::join(api->parameter_names(), ", ")));
  else if (unit.is_c)
    findings.expect("names of the parameters of " + name, fmt::format("{}", fmt::join(names, ", ")),
                    parameter_names_of_c(name, expected));
}

/// A comment of C: nothing that ends or begins one, no trigraphs.
std::string shown_in_c(const std::string& text) {
  std::string shown;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '?' && i > 0 && text[i - 1] == '?') continue;
    shown += text[i];
    const std::string pair = text.substr(i, 2);
    if (pair == "*/" || pair == "/*") shown += ' ';
  }
  return shown;
}

/// What the header says at its top: the sentences, word by word.
void check_sentences(const Unit& unit, const Expected& expected, Findings& findings) {
  const std::string text = words(unit.opening_comment);
  for (const std::string& sentence : expected.sentences) {
    std::string shown;
    for (const char c : sentence) shown += c >= ' ' && c <= '~' && c != '\\' ? c : '?';
    if (unit.is_c) shown = shown_in_c(shown);
    if (text.find(words(shown)) == std::string::npos) findings.add("the header does not say '{}'", shown);
  }
}

void check_comments(const Unit& unit, const Expected& expected, Findings& findings) {
  check_sentences(unit, expected, findings);
  for (const Function* function : unit.functions) {
    if (function->place.file != 0 || function->body) continue;
    const std::string& name = unit.symbols.text(function->name);
    check_parameter_names(unit, *function, expected, findings);
    if (const auto it = findings.counts.find(name); it != findings.counts.end())
      check_comment(*function, name, operations_sentence(it->second), findings);
    if (const auto it = findings.steps.find(name); it != findings.steps.end() && !expected.velocities.empty())
      check_comment(*function, name, fmt::format("{} operations.", it->second.operations), findings);
  }
}

/// Functions of C in their order: what C++ has as members of Model, then all others.
std::vector<std::string> functions_of_c(const Expected& expected) {
  std::vector<std::string> list = {"Real: void default_parameters(Parameters<Real>*) noexcept",
                                   "Real: void set_model(Model<Real>*, const Parameters<Real>*) noexcept"};
  if (!expected.constraints.empty()) list.push_back("Real: int loops_closed(const State<Real>*) noexcept");
  if (!expected.proven_parameters.empty())
    list.push_back("Real: int loops_proven(const Parameters<Real>*) noexcept");
  for (const std::string& name : expected.functions)
    if (const std::optional<FunctionApi> api = api_of(name, expected)) {
      list.push_back("Real: " + api->signature(expected, "Real"));
      if (may_sample(*api, expected)) list.push_back(sampled_signature(*api, expected));
    }
  return list;
}

std::vector<const char*> instantiated_reals(const Expected& expected) {
  if (expected.choices.language == ir::Language::kC) return {};
  std::vector<const char*> reals;
  if (expected.choices.has_double) reals.push_back("double");
  if (expected.choices.has_float) reals.push_back("float");
  return reals;
}

}  // namespace

void check_declarations(const Unit& unit, const Expected& expected, Findings& findings) {
  std::vector<std::string> wanted, bodies, instances, found, defined, instantiated;
  const std::vector<const char*> reals = instantiated_reals(expected);
  for (const std::string& name : expected.functions) {
    const std::optional<FunctionApi> api = api_of(name, expected);
    if (!api) continue;
    wanted.push_back("Real: " + api->signature(expected, "Real"));
    for (const std::string& definition : definitions(*api, expected)) bodies.push_back(definition);
    for (const char* real : reals) instances.push_back(api->signature(expected, real));
  }
  if (unit.is_c) wanted = bodies = functions_of_c(expected);
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
  for (const Function* function : unit.instantiations) {
    instantiated.push_back(signature_of(unit, *function));
    const std::optional<FunctionApi> api = api_of(unit.symbols.text(function->name), expected);
    if (function->has_stages && !(api && api->result == Result::kStep))
      findings.add("'{}' is marked as a step", instantiated.back());
  }
  compare("declaration", found, wanted, findings);
  compare("definition", defined, bodies, findings);
  compare("instantiation", instantiated, instances, findings);
  std::vector<std::string> structs;
  for (const TypeName& type : unit.struct_instantiations) structs.push_back(text_of(unit, type));
  std::vector<std::string> models;
  for (const char* real : reals) models.push_back(fmt::format("Model<{}>", real));
  compare("instantiation of a struct", structs, models, findings);
  check_comments(unit, expected, findings);
}

}  // namespace jourdain::readback
