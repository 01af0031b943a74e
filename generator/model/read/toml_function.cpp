// [[function]]: functions that are given by an expression of their arguments.
#include <fmt/format.h>

#include <algorithm>

#include "model/expression_functions.hpp"
#include "model/names.hpp"
#include "model/read/keys.hpp"
#include "model/read/toml_callable.hpp"
#include "model/read/toml_names.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

using support::shown;

void check_callable_name(TomlFile& file, const TomlTable& table, const char* what, const std::string& name) {
  const SourceRange where = table.where("name");
  check_identifier(file, where, what, name);
  if (is_expression_word(name))
    table.error("name", fmt::format("{} '{}' would hide what '{}' means in expressions", what, name, name));
  for (const DeclaredParameter& parameter : file.declared())
    if (parameter.name == name) table.error("name", fmt::format("'{}' is a parameter too", shown(name)));
  is_new_name(file, where, "tables or functions", name, file.callables());
}

namespace {

class FunctionReader {
 public:
  FunctionReader(TomlFile& file, const toml::table& node, const ReadOptions& options)
      : file_(file),
        options_(options),
        keys_(file, node, fmt::format("function '{}'", shown(file.text_or(node, "name"))),
              file.range(node.source()), keys_of("function")) {}

  /// One that is zero after a diagnostic, nothing where it has no name or its arguments have none.
  std::optional<Callable> read() {
    function_.kind = "function";
    function_.name = keys_.required_text("name").value_or("");
    function_.where = keys_.where("name");
    if (!function_.name.empty()) check_callable_name(file_, keys_, "function", function_.name);
    keys_.text("description");
    const std::string unit = read_unit();
    if (!keys_.has("arguments")) keys_.missing("arguments", "the names that 'value' uses");
    const bool has_arguments = keys_.has("arguments") && read_arguments();
    if (!keys_.has("value")) keys_.missing("value", "an expression of the arguments");
    if (!has_arguments) file_.complete().numbers = false;
    if (function_.arguments.empty() || function_.name.empty()) return {};
    if (keys_.has("argument_units")) read_units();
    const auto read = [&] { return keys_.function("value", {{unit}}, scope()); };
    const std::size_t mark = file_.error_count();
    Expression value = has_arguments ? read() : 0.0;
    if (file_.error_count() == mark && value.has_kinks())
      function_.smooth = smoothness(kinks_of(file_, read));
    const bool is_external = function_.is_external = read_external();
    if (is_external) check_external(value);
    read_range(unit, is_external);
    if (is_external && options_.external && has_arguments) {
      function_.value = call();
      return std::move(function_);
    }
    if (is_external && has_arguments)
      file_.diagnostics().note(
          function_.where, fmt::format("{} is external: its expression stands for it here", keys_.what()));
    function_.value = [value = std::move(value)](std::span<const Expression> arguments) {
      return with_arguments(value, arguments);
    };
    return std::move(function_);
  }

 private:
  static Callable::Smooth smoothness(Kinks kinks) {
    return kinks == Kinks::kNone             ? Callable::Smooth::kEverywhere
           : kinks == Kinks::kWhereTablesEnd ? Callable::Smooth::kWithinEnds
                                             : Callable::Smooth::kNowhere;
  }

  bool read_external() {
    if (!keys_.has("external")) return false;
    const toml::value<bool>* external = keys_.find("external")->as_boolean();
    if (!external)
      keys_.error("external", fmt::format("{} must be true or false, not {}", keys_.quoted("external"),
                                          type_in_words(*keys_.find("external"))));
    return external && external->get();
  }

  /// That of what stands in for an external function.
  void read_range(const std::string& unit, bool is_external) {
    if (!keys_.has("range")) return;
    if (!is_external) return keys_.error("range", fmt::format("{} is not external", keys_.what()));
    const std::optional<std::array<double, 2>> range = keys_.constant_pair("range", {{unit}}, {});
    if (range && !((*range)[0] < (*range)[1]))
      keys_.error("range", fmt::format("{} does not rise", keys_.quoted("range")));
    else if (range)
      range_ = *range;
  }

  /// Its names become those of members, those of its derivatives too.
  void check_external(const Expression& value) {
    for (const Expression::Node& node : value.nodes())
      if (node.op == Expression::Op::kParameter)
        return keys_.error("value", fmt::format("'value' of external {} has parameters", keys_.what()),
                           "what it takes are its arguments");
    for (const Callable& other : file_.callables())
      if (other.is_external && (names_a_slope(function_, other.name) || names_a_slope(other, function_.name)))
        keys_.error(
            "name",
            fmt::format("{} has the name of a partial derivative, or '{}' has", keys_.what(), other.name),
            "that of 'grip' by 'slip' is called grip_slip");
    const auto has_meaning = [](const std::string& name) {
      return is_reserved(name) || name == "context" || name == "Functions";
    };
    std::vector<std::string> names = {function_.name};
    for (const Callable::Argument& argument : function_.arguments) names.push_back(argument.name);
    for (const std::string& name : names)
      if (has_meaning(name))
        keys_.error(
            name == function_.name ? "name" : "arguments",
            fmt::format("{} is external, and '{}' has a meaning in emitted code", keys_.what(), name));
  }

  static bool names_a_slope(const Callable& function, const std::string& name) {
    return std::any_of(function.arguments.begin(), function.arguments.end(),
                       [&](const Callable::Argument& argument) {
                         const std::string slope = function.name + "_" + argument.name;
                         return name == slope || name.starts_with(slope + "_");
                       });
  }

  std::function<Expression(std::span<const Expression>)> call() const {
    support::CalledFunction called{options_.prefix + function_.name, {}, range_[0], range_[1]};
    for (const Callable::Argument& argument : function_.arguments) called.arguments.push_back(argument.name);
    const double number = support::number_of_called(called);
    return [number](std::span<const Expression> arguments) {
      Expression list = 0.0;
      for (const Expression& argument : arguments)
        list = Expression::function(support::Function::kArgument, argument, list);
      return Expression::function(support::Function::kCall, list, number);
    };
  }

  std::string read_unit() {
    const std::optional<Unit> unit = keys_.unit("unit");
    if (!keys_.has("unit") || !unit) return "";
    if (unit->factor != 1) keys_.error("unit", not_si(keys_.quoted("unit")), si_hint(*unit));
    function_.measure = Measure::parameter(*keys_.text("unit"));
    return *keys_.text("unit");
  }

  static std::string not_si(const std::string& what) {
    return fmt::format("{}: functions take and have SI units", what);
  }
  static std::string si_hint(const Unit& unit) {
    return fmt::format("'{}', with the conversion in the expressions that call it", unit.si);
  }

  bool read_arguments() {
    const std::optional<std::vector<Text>> names = texts("arguments");
    if (!names) return false;
    if (names->empty()) {
      keys_.error("arguments", fmt::format("{} has no argument", keys_.what()),
                  "[[signal]] names an expression");
      return false;
    }
    const std::size_t mark = file_.error_count();
    for (const Text& name : *names) take_argument(name);
    return file_.error_count() == mark;
  }

  struct Text {
    const toml::value<std::string>* node;
    std::string text;
    SourceRange where;
  };

  std::optional<std::vector<Text>> texts(const char* key) {
    const toml::array* array = keys_.array(key, "an array of texts");
    if (!array) return {};
    std::vector<Text> result;
    for (const toml::node& node : *array) {
      const auto* text = node.as_string();
      const SourceRange where = file_.range(node.source());
      if (!text) {
        file_.error(where, fmt::format("{} holds texts, not {}", keys_.quoted(key), type_in_words(node)));
        return {};
      }
      result.push_back({text, file_.text(*text), where});
    }
    return result;
  }

  void take_argument(const Text& name) {
    check_identifier(file_, name.where, "argument", name.text);
    if (is_expression_word(name.text) || name.text == time_scope().front().name)
      file_.error(name.where, fmt::format("argument '{}' would hide what '{}' means in expressions",
                                          name.text, name.text));
    for (const DeclaredParameter& parameter : file_.declared())
      if (parameter.name == name.text)
        file_.error(name.where, fmt::format("argument '{}' has the name of a parameter", shown(name.text)));
    for (const Callable& callable : file_.callables())
      if (callable.name == name.text)
        file_.error(name.where,
                    fmt::format("argument '{}' has the name of a {}", shown(name.text), callable.kind));
    for (const Callable::Argument& argument : function_.arguments)
      if (argument.name == name.text)
        file_.error(name.where, fmt::format("{} has two arguments '{}'", keys_.what(), shown(name.text)));
    function_.arguments.push_back({name.text, Measure::open()});
  }

  /// Without effect after a diagnostic.
  void read_units() {
    const std::optional<std::vector<Text>> units = texts("argument_units");
    if (!units) return;
    if (units->size() != function_.arguments.size())
      return keys_.error("argument_units", fmt::format("{} has {} arguments and {} units", keys_.what(),
                                                       function_.arguments.size(), units->size()));
    units_.resize(units->size());
    for (std::size_t i = 0; i < units->size(); ++i) {
      const Text& text = (*units)[i];
      const std::optional<Unit> unit = file_.unit(*text.node);
      if (unit && unit->factor != 1)
        file_.error(text.where, not_si(fmt::format("'{}'", shown(text.text))), si_hint(*unit));
      if (!unit || unit->factor != 1) continue;
      units_[i] = text.text;
      function_.arguments[i].measure = Measure::parameter(text.text);
    }
  }

  Scope scope() const {
    Scope scope;
    for (std::size_t i = 0; i < function_.arguments.size(); ++i)
      scope.push_back({function_.arguments[i].name,
                       {Variable::Kind::kArgument, 0, i},
                       units_.empty() ? Measure::open() : Measure::variable({{units_[i]}})});
    return scope;
  }

  TomlFile& file_;
  const ReadOptions& options_;
  TomlTable keys_;
  Callable function_;
  std::array<double, 2> range_ = {1, 3};
  std::vector<std::string> units_;  ///< of the arguments; none where none are given
};

}  // namespace

void read_functions(TomlFile& file, const TomlTables& section, const ReadOptions& options) {
  for (const toml::node& node : section)
    if (std::optional<Callable> function = FunctionReader(file, *node.as_table(), options).read())
      file.declare(std::move(*function));
}

}  // namespace jourdain::model
