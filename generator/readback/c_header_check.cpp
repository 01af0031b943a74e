// What a header in C, and what its source defines beside functions, must be.
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "readback/header_check.hpp"
#include "readback/interpreter.hpp"
#include "readback/node_table.hpp"
#include "readback/struct_members.hpp"

namespace jourdain::readback {

namespace {

class CHeaderCheck {
 public:
  CHeaderCheck(const Unit& unit, const Expected& expected, const std::string& prefix, Findings& findings)
      : unit_(unit), expected_(expected), prefix_(prefix), findings_(findings) {}

  void check() {
    files();
    enumerators();
    structs();
    constants();
    findings_.guarded("defaults", [this] { defaults(); });
  }

 private:
  std::string text(Symbol symbol) const { return unit_.symbols.text(symbol); }

  void files() {
    const std::string file = prefix_.substr(0, prefix_.size() - 1);
    std::string guard = prefix_ + "H";
    for (char& c : guard) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    std::vector<Texts> wanted = {{"#ifndef " + guard, "#define " + guard, "#ifdef __cplusplus", "#endif",
                                  "#ifdef __cplusplus", "#endif", "#endif"},
                                 {std::begin(kNarrowVectors), std::end(kNarrowVectors)}};
    wanted[1].insert(wanted[1].end(), {"#include \"" + file + ".h\"", "#include <math.h>"});
    for (std::size_t i = 0; i < wanted.size(); ++i)
      findings_.expect("directives of " + unit_.files[i],
                       fmt::format("{}", fmt::join(unit_.directives[i], "; ")),
                       fmt::format("{}", fmt::join(wanted[i], "; ")));
  }

  Texts wanted_enumerators() const {
    Texts wanted;
    const auto count = [&](const char* what, std::size_t number) {
      wanted.push_back(fmt::format("{}{}_count = {}", prefix_, what, number));
    };
    count("position", expected_.positions.size());
    count("velocity", expected_.velocities.size());
    count("input", expected_.inputs.size());
    count("output", expected_.outputs.size());
    if (!expected_.constraints.empty()) count("constraint", expected_.constraints.size());
    if (!expected_.proven_positions.empty()) count("range", expected_.proven_positions.size());
    count("parameter", expected_.parameters.size());
    for (const auto& [name, entry] : index_names(expected_))
      wanted.push_back(fmt::format("{}{} = {}", prefix_, name, entry));
    return wanted;
  }

  void enumerators() {
    Texts found;
    for (const Constant* constant : unit_.constants) {
      if (!constant->is_enumerator) continue;
      const Declarator& declarator = constant->declarator;
      const bool is_integer =
          declarator.initial->kind == ExpressionKind::kInteger && declarator.place.file == 0;
      found.push_back(fmt::format("{} = {}", text(declarator.name),
                                  is_integer ? std::to_string(declarator.initial->integer) : "?"));
    }
    findings_.expect("counts and indices", fmt::format("{}", fmt::join(found, "; ")),
                     fmt::format("{}", fmt::join(wanted_enumerators(), "; ")));
  }

  void structs() {
    std::map<std::string, Texts> wanted = struct_members(expected_);
    bool has_model = false;
    for (const Struct* found : unit_.structs) {
      const std::string name = text(found->name);
      const bool is_internal = found->scope == "detail";
      if (found->place.file != (is_internal ? 1 : 0))
        findings_.add("the struct {} does not belong there", name);
      if (is_internal) continue;
      if (name == "Model") {
        has_model = true;
        continue;
      }
      const auto it = wanted.find(name);
      if (it == wanted.end()) {
        findings_.add("the struct {} does not belong there", name);
        continue;
      }
      check_struct(unit_, *found, it->second, findings_);
      wanted.erase(it);
    }
    Texts pointers, called;
    const auto shown = [](const std::string& name, const Texts& arguments) {
      return fmt::format("{}({})", name, fmt::join(arguments, ", "));
    };
    for (const auto& [name, arguments] : unit_.user_functions) pointers.push_back(shown(name, arguments));
    for (const auto& [name, function] : expected_.user_functions())
      called.push_back(shown(name, function.arguments));
    findings_.expect("functions of the user", fmt::format("{}", fmt::join(pointers, "; ")),
                     fmt::format("{}", fmt::join(called, "; ")));
    if (!has_model) findings_.add("there is no model struct");
    for (const auto& [name, members] : wanted) findings_.add("there is no struct {}", name);
  }

  /// Entries of an array of strings that ends with 0.
  static Texts strings_of(const Constant& constant) {
    Texts found;
    if (const Expression* list = constant.declarator.initial)
      for (const Expression* entry : list->arguments)
        found.push_back(entry->kind == ExpressionKind::kString ? unquoted(entry->text, true)
                        : entry->kind == ExpressionKind::kInteger && entry->integer == 0 ? "nullptr"
                                                                                         : "?");
    return found;
  }

  std::string value_of(const Constant& constant) const {
    const Expression* value = constant.declarator.initial;
    const bool is_real = value && value->kind == ExpressionKind::kCast;
    return is_real ? fmt::format("{}", value->arguments[0]->floating) : "?";
  }

  /// Declared in the header and defined in the source, in one order: names, then limits.
  void constants() {
    Texts wanted, values, declared, defined, found;
    for (const auto& [name, entries] : name_arrays(expected_)) {
      wanted.push_back(fmt::format("const char*[{}] {}{}", entries.size() + 1, prefix_, name));
      values.push_back(fmt::format("{}; nullptr", fmt::join(entries, "; ")));
      if (entries.empty()) values.back() = "nullptr";
    }
    if (!expected_.constraints.empty())
      for (const auto& [name, value] : {std::pair("least_regularity", expected_.least_regularity),
                                        {"greatest_opening", expected_.greatest_opening}}) {
        wanted.push_back(fmt::format("const Real {}{}", prefix_, name));
        values.push_back(fmt::format("{}", value));
      }
    const auto head = [this](const Constant& constant) {
      return fmt::format("{} {}", text_of(unit_, constant.type, constant.declarator),
                         text(constant.declarator.name));
    };
    for (const Constant* constant : unit_.declared_constants)
      declared.push_back(constant->declarator.place.file == 0 ? head(*constant) : "?");
    for (const Constant* constant : unit_.constants) {
      if (constant->is_enumerator || !constant->scope.empty()) continue;
      defined.push_back(head(*constant));
      found.push_back(constant->declarator.indirection == '*'
                          ? fmt::format("{}", fmt::join(strings_of(*constant), "; "))
                          : value_of(*constant));
    }
    const auto compare = [this](const char* what, const Texts& is, const Texts& must) {
      findings_.expect(what, fmt::format("{}", fmt::join(is, "\n")),
                       fmt::format("{}", fmt::join(must, "\n")));
    };
    compare("declared constants", declared, wanted);
    compare("constants", defined, wanted);
    compare("values of constants", found, values);
  }

  void defaults() {
    NodeTable table(expected_.is_float);
    Interpreter run(unit_, table);
    const Value parameters = run.make(run.types().instance("Parameters", {{0, run.types().number(), 0}}));
    run.call("", "default_parameters", {parameters});
    for (const ExpectedParameter& parameter : expected_.parameters)
      if (run.cell(run.field(parameters, parameter.name)) != number_cell(table.literal(parameter.value)))
        findings_.add("default of parameter {} is not {}", parameter.name, parameter.value);
  }

  const Unit& unit_;
  const Expected& expected_;
  std::string prefix_;
  Findings& findings_;
};

}  // namespace

void check_c_structs(const Unit& unit, const Expected& expected, const std::string& prefix,
                     Findings& findings) {
  CHeaderCheck(unit, expected, prefix, findings).check();
}

}  // namespace jourdain::readback
