#include "commands/fmu_description.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tinyxml2.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "model/units.hpp"

namespace jourdain::commands {

using programs::Role;
using Element = tinyxml2::XMLElement;

namespace {

Element& child(tinyxml2::XMLNode& parent, const char* name) {
  return *parent.InsertEndChild(parent.GetDocument()->NewElement(name))->ToElement();
}

void set(Element& element, const char* name, const std::string& text) {
  element.SetAttribute(name, text.c_str());
}

/// Shortest text that reads as the same number.
void set(Element& element, const char* name, double number) { set(element, name, fmt::format("{}", number)); }

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// Characters that XML does not have, and ends of lines, as blanks.
std::string in_xml(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  replace_all(text, "\xEF\xBF\xBE", " ");  // U+FFFE and U+FFFF
  replace_all(text, "\xEF\xBF\xBF", " ");
  return text;
}

std::string causality(const FmuNumber& number) {
  switch (number.role) {
    case Role::kTime:
      return "independent";
    case Role::kPosition:
    case Role::kVelocity:
    case Role::kOutput:
      return "output";
    case Role::kInput:
      return "input";
    case Role::kParameter:
      return "parameter";
    case Role::kPositionRate:
    case Role::kAcceleration:
    case Role::kConstant:
      return "local";
  }
  return "local";
}

std::string variability(const FmuNumber& number) {
  if (number.role == Role::kParameter) return "tunable";
  return number.role == Role::kConstant ? "constant" : "continuous";
}

/// "exact", "calculated" or, of what has neither, empty.
std::string initial(const FmuNumber& number) {
  if (number.role == Role::kTime || number.role == Role::kInput) return "";
  return number.start ? "exact" : "calculated";
}

class Description {
 public:
  Description(const FmuScene& scene, FmiVersion version)
      : scene_(scene), is_2_(version == FmiVersion::k2), states_(state_references(scene)) {}

  std::string text(const std::string& token, const std::vector<std::string>& sources) {
    document_.InsertEndChild(document_.NewDeclaration());
    Element& root = child(document_, "fmiModelDescription");
    head(root, token);
    interfaces(root, sources);
    units(root);
    Element& category = child(child(root, "LogCategories"), "Category");
    set(category, "name", "logStatusError");
    set(category, "description", "a call that was refused, and why");
    Element& warnings = child(*root.LastChildElement("LogCategories"), "Category");
    set(warnings, "name", "logStatusWarning");
    set(warnings, "description", "start values that were moved to what the mechanism can do");
    Element& experiment = child(root, "DefaultExperiment");
    set(experiment, "startTime", 0.0);
    set(experiment, "stepSize", scene_.step);
    Element& variables = child(root, "ModelVariables");
    for (std::size_t k = 0; k < scene_.numbers.size(); ++k) variable(variables, k);
    structure(root);
    tinyxml2::XMLPrinter printer;
    document_.Print(&printer);
    return printer.CStr();
  }

 private:
  void head(Element& root, const std::string& token) const {
    set(root, "fmiVersion", is_2_ ? "2.0" : "3.0");
    set(root, "modelName", in_xml(scene_.title));
    set(root, is_2_ ? "guid" : "instantiationToken", token);
    std::string about = in_xml(scene_.description);
    if (!about.empty()) about += about.ends_with('.') ? " " : ". ";
    set(root, "description",
        fmt::format("{}Co-simulation takes steps of {} s with {}; their error is not assured.", about,
                    scene_.step, scene_.method));
    set(root, "generationTool", scene_.generator);
    set(root, "variableNamingConvention", "flat");
    if (is_2_) set(root, "numberOfEventIndicators", "0");
  }

  void interfaces(Element& root, const std::vector<std::string>& sources) const {
    const char* state = is_2_ ? "canGetAndSetFMUstate" : "canGetAndSetFMUState";
    const char* serialize = is_2_ ? "canSerializeFMUstate" : "canSerializeFMUState";
    const char* directional = is_2_ ? "providesDirectionalDerivative" : "providesDirectionalDerivatives";
    const std::string has_derivatives = scene_.has_derivatives ? "true" : "false";
    for (const bool is_exchange : {true, false}) {
      Element& way = child(root, is_exchange ? "ModelExchange" : "CoSimulation");
      set(way, "modelIdentifier", scene_.name);
      if (is_2_) set(way, "canNotUseMemoryManagementFunctions", "true");
      set(way, state, "true");
      set(way, serialize, "true");
      set(way, directional, has_derivatives);
      if (!is_2_) set(way, "providesAdjointDerivatives", has_derivatives);
      if (is_exchange) {
        set(way, is_2_ ? "completedIntegratorStepNotNeeded" : "needsCompletedIntegratorStep",
            scene_.drifts != is_2_ ? "true" : "false");
      } else {
        set(way, "canHandleVariableCommunicationStepSize", "true");
        if (!is_2_) set(way, "fixedInternalStepSize", scene_.step);
      }
      if (!is_2_) continue;
      Element& files = child(way, "SourceFiles");
      for (const std::string& source : sources) set(child(files, "File"), "name", source);
    }
  }

  void units(Element& root) const {
    std::set<std::string> names;
    for (const FmuNumber& number : scene_.numbers) names.insert(number.unit);
    names.erase("");
    Element& definitions = child(root, "UnitDefinitions");
    for (const std::string& name : names) {
      Element& unit = child(definitions, "Unit");
      set(unit, "name", name);
      const std::optional<BaseUnits> base = base_units(name);
      if (!base) continue;
      Element& powers = child(unit, "BaseUnit");
      for (const auto& [symbol, power] :
           {std::pair("kg", base->kg), std::pair("m", base->m), std::pair("s", base->s),
            std::pair("A", base->A), std::pair("rad", base->rad)})
        if (power != 0) powers.SetAttribute(symbol, power);
      if (base->factor != 1) set(powers, "factor", base->factor);
    }
  }

  /// The two versions name the same attributes; in 2.0 those of the type stand in an element of their own.
  void variable(Element& list, std::size_t k) const {
    const FmuNumber& number = scene_.numbers[k];
    Element& one = child(list, is_2_ ? "ScalarVariable" : "Float64");
    set(one, "name", in_xml(number.name));
    one.SetAttribute("valueReference", static_cast<unsigned>(k));
    if (!number.description.empty()) set(one, "description", in_xml(number.description));
    set(one, "causality", causality(number));
    set(one, "variability", variability(number));
    const std::string how = initial(number);
    if (!how.empty()) set(one, "initial", how);
    Element& type = is_2_ ? child(one, "Real") : one;
    if (!number.unit.empty()) set(type, "unit", number.unit);
    if (number.range) {
      set(type, "min", (*number.range)[0]);
      if ((*number.range)[1] < std::numeric_limits<double>::max()) set(type, "max", (*number.range)[1]);
    }
    if (number.role == Role::kInput)
      set(type, "start", number.start.value_or(0));
    else if (number.start && number.role != Role::kTime)
      set(type, "start", *number.start);
    if (number.nominal) set(type, "nominal", *number.nominal);
    if (number.derivative_of)
      type.SetAttribute("derivative", static_cast<unsigned>(name_of(*number.derivative_of)));
  }

  /// How other elements name a variable: by its place in the list, from 1, or by its reference.
  std::size_t name_of(std::size_t reference) const { return is_2_ ? reference + 1 : reference; }

  void unknown(Element& list, const char* kind, std::size_t reference, bool with_dependencies) const {
    Element& one = child(list, is_2_ ? "Unknown" : kind);
    one.SetAttribute(is_2_ ? "index" : "valueReference", static_cast<unsigned>(name_of(reference)));
    const std::optional<std::vector<std::size_t>>& known = scene_.numbers[reference].depends_on;
    if (!with_dependencies || !known) return;
    std::vector<std::size_t> names;
    for (const std::size_t one_known : *known) names.push_back(name_of(one_known));
    set(one, "dependencies", fmt::format("{}", fmt::join(names, " ")));
    if (scene_.numbers[reference].is_state) set(one, "dependenciesKind", "constant");
  }

  void structure(Element& root) const {
    Element& element = child(root, "ModelStructure");
    std::vector<std::size_t> outputs, derivatives, calculated;
    for (std::size_t k = 0; k < scene_.numbers.size(); ++k)
      if (causality(scene_.numbers[k]) == "output") outputs.push_back(k);
    for (const std::size_t state : states_)
      for (std::size_t k = 0; k < scene_.numbers.size(); ++k)
        if (scene_.numbers[k].derivative_of == state) derivatives.push_back(k);
    for (std::size_t k = 0; k < scene_.numbers.size(); ++k) {
      const FmuNumber& number = scene_.numbers[k];
      const bool is_asked = causality(number) == "output" || number.derivative_of;
      if (is_asked && initial(number) == "calculated") calculated.push_back(k);
    }
    const auto add = [&](const char* group, const char* kind, const std::vector<std::size_t>& list,
                         bool depend) {
      if (list.empty()) return;
      Element& place = is_2_ ? child(element, group) : element;
      for (const std::size_t reference : list) unknown(place, kind, reference, depend);
    };
    add("Outputs", "Output", outputs, true);
    add("Derivatives", "ContinuousStateDerivative", derivatives, true);
    add("InitialUnknowns", "InitialUnknown", calculated, false);
  }

  const FmuScene& scene_;
  bool is_2_;
  std::vector<std::size_t> states_;
  tinyxml2::XMLDocument document_;
};

}  // namespace

std::optional<BaseUnits> base_units(const std::string& unit) {
  const auto parsed = model::parse_unit(unit);
  if (!std::holds_alternative<model::Unit>(parsed)) return std::nullopt;
  const auto& known = std::get<model::Unit>(parsed);
  // An angle has no dimension: its exponent is what metres in its place would add.
  std::string with_metres = known.si;
  replace_all(with_metres, "rad", "m");
  const auto replaced = model::parse_unit(with_metres);
  const int rad = std::holds_alternative<model::Unit>(replaced)
                      ? std::get<model::Unit>(replaced).dimension[0] - known.dimension[0]
                      : 0;
  return BaseUnits{known.dimension[1],
                   known.dimension[0],
                   known.dimension[2],
                   known.dimension[3],
                   rad,
                   static_cast<double>(known.factor)};
}

std::string model_description(const FmuScene& scene, FmiVersion version, const std::string& token,
                              const std::vector<std::string>& sources) {
  return Description(scene, version).text(token, sources);
}

std::string build_description(const std::string& name, const std::vector<std::string>& sources) {
  tinyxml2::XMLDocument document;
  document.InsertEndChild(document.NewDeclaration());
  Element& root = child(document, "fmiBuildDescription");
  set(root, "fmiVersion", "3.0");
  Element& configuration = child(root, "BuildConfiguration");
  set(configuration, "modelIdentifier", name);
  Element& set_of_files = child(configuration, "SourceFileSet");
  set(set_of_files, "language", "C99");
  for (const std::string& source : sources) set(child(set_of_files, "SourceFile"), "name", source);
  set(child(configuration, "Library"), "name", "m");
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

}  // namespace jourdain::commands
