#include "emit/c/c_printer.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "emit/c/c_expressions.hpp"
#include "emit/layout.hpp"
#include "support/check.hpp"

namespace jourdain::emit::c {

namespace {

using Kind = Expression::Kind;
using Access = Parameter::Access;

bool is_struct(const Parameter& parameter) {
  return parameter.type.kind == Type::Kind::kStruct && parameter.extents.empty() && !parameter.is_slice;
}

std::string parameter_text(const CNames& names, const Parameter& p, CInputs inputs) {
  if (p.is_inputs && inputs == CInputs::kSampled)
    return fmt::format("{} input_at, void *context", names.global("input_at"));
  const bool reads = p.access == Access::kRead && !is_internal(p.type) && p.extents.size() < 2;
  const bool by_value = !is_struct(p) && !p.is_slice && p.extents.empty();
  JD_CHECK(!by_value || p.access != Access::kWrite, "a number is written through {}", p.name);
  std::string text = (reads && !by_value ? "const " : "") + names.type(p.type) + " ";
  if (is_struct(p) || p.is_slice) text += "*";
  text += p.name;
  for (const std::size_t extent : p.extents) text += fmt::format("[{}]", extent);
  return text;
}

/// Variables of one type and remark, declared together.
struct Declared {
  std::string type, comment;
  std::vector<std::string> variables;
};

class BodyPrinter {
 public:
  BodyPrinter(const CContext& context, const Function& function, CInputs inputs,
              const std::vector<std::string>& of_model)
      : context_(context),
        names_(context.names),
        function_(function),
        inputs_(inputs),
        expressions_(names_, scope_) {
    for (const char* table : kTables)
      scope_.add(table, CVariable{{CType::Kind::kInteger}, false, names_.internal(table)});
    for (const std::string& member : of_model) scope_.add(member, CVariable{{}, false, "model->" + member});
    for (const Parameter& p : function.parameters)
      if (!p.is_inputs || inputs == CInputs::kHeld) scope_.add(p.name, p.type, is_struct(p));
  }

  std::string text() {
    const std::string statements = block(function_.body, 2);
    std::string declarations;
    for (const Declared& declared : declared_)
      if (declared.comment.empty())
        declarations += aligned("  " + declared.type + " ", declared.variables, ";");
      else
        declarations +=
            fmt::format("  {} {}; /* {} */\n", declared.type, declared.variables[0], declared.comment);
    if (!declarations.empty()) declarations += "\n";
    return declarations + unused(statements) + statements;
  }

  std::string operator()(const Declare& declare) { return visit(declare); }
  std::string operator()(const Set& set) { return visit(set); }
  std::string operator()(const SineCosine& pair) { return visit(pair); }
  std::string operator()(const Loop& loop) { return visit(loop); }
  std::string operator()(const AtStart& start) { return visit(start); }
  std::string operator()(const Call& call) { return visit(call); }
  std::string operator()(const Return& result) {
    return line(fmt::format("return {};", expressions_.object(result.value)));
  }
  std::string operator()(const Nearby& nearby) {
    JD_CHECK(false, "'{}' is C++'s", nearby.variable);
    return "";
  }

 private:
  std::string of(const Expression& e) const { return expressions_.text(e); }
  std::string line(const std::string& text) const { return wrapped(text, indent_); }

  std::string block(const Statements& statements, std::size_t indent) {
    const std::size_t outside = std::exchange(indent_, indent);
    std::string text;
    for (const Statement& statement : statements) text += std::visit(*this, statement.is);
    indent_ = outside;
    return text;
  }

  /// C names every parameter; those that nothing reads are mentioned so that nobody wonders.
  std::string unused(const std::string& statements) const {
    std::string text;
    for (const Parameter& p : function_.parameters) {
      std::vector<std::string> named = {p.name};
      if (p.is_inputs && inputs_ == CInputs::kSampled) named = {"input_at", "context"};
      for (const std::string& name : named)
        if (!mentions_word(statements, name)) text += fmt::format("  (void){};\n", name);
    }
    return text;
  }

  static bool mentions_word(const std::string& text, const std::string& word) {
    const auto is_part = [](char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)); };
    for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at)
      if ((at == 0 || !(is_part(text[at - 1]) || text[at - 1] == '.' || text[at - 1] == '>')) &&
          !is_part(text[at + word.size()]))
        return true;
    return false;
  }

  void declare_variable(const Type& type, const Variable& variable, const std::string& comment = "") {
    const bool is_known = scope_.find(variable.name) != nullptr;
    scope_.add(variable.name, type, false);
    if (is_known) return;
    std::string text = variable.name;
    for (const Expression& extent : variable.extents) text += fmt::format("[{}]", of(extent));
    const std::string type_name = names_.type(type);
    const auto it = std::find_if(declared_.begin(), declared_.end(), [&](const Declared& d) {
      return d.type == type_name && d.comment.empty() && comment.empty();
    });
    if (it == declared_.end())
      declared_.push_back({type_name, comment, {text}});
    else
      it->variables.push_back(text);
  }

  std::string visit(const Declare& declare) {
    if (declare.change == Declare::Change::kNever) {
      for (const Variable& variable : declare.variables)
        scope_.add(variable.name, CVariable{{CType::Kind::kInteger}, false, of(*variable.value)});
      return "";
    }
    std::string text;
    for (const Variable& variable : declare.variables) {
      declare_variable(declare.type, variable, declare.comment);
      if (variable.value) text += assignment({name(variable.name)}, *variable.value);
      for (std::size_t k = 0; k < variable.entries.size(); ++k)
        text += assignment({name(variable.name)[k]}, variable.entries[k]);
      const bool is_state = declare.type.kind == Type::Kind::kStruct && declare.type.name == "State";
      if (is_state && !variable.value) text += fresh_state(variable.name);
    }
    return text;
  }

  /// What a State has before anything closed its loops.
  std::string fresh_state(const std::string& variable) const {
    if (!context_.has_guards) return "";
    std::string text = line(fmt::format("{}.regularity = {};", variable, names_.literal(1))) +
                       line(fmt::format("{}.opening = {};", variable, names_.literal(0)));
    for (std::size_t k = 0; k < context_.ranges; ++k)
      text += line(fmt::format("{}.beyond[{}] = {};", variable, k, names_.literal(0)));
    return text;
  }

  std::string visit(const Set& set) {
    if (set.value.kind == Kind::kInputsAt && inputs_ == CInputs::kSampled)
      return sample(set.value.operands[0], expressions_.address(set.targets[0]));
    return assignment(set.targets, set.value);
  }

  std::string assignment(const std::vector<Expression>& targets, const Expression& value) const {
    std::string text;
    for (const Expression& target : targets) text += expressions_.object(target) + " = ";
    const bool to_time = scope_.type_of(targets[0]).kind == CType::Kind::kTime;
    const bool is_time = scope_.type_of(value).kind == CType::Kind::kTime;
    const bool to_angle = scope_.type_of(targets[0]).kind == CType::Kind::kAngle;
    if (to_time && !is_time) return line(text + fmt::format("{}({});", names_.global("time_at"), of(value)));
    return line(text + (to_angle ? expressions_.angle(value) : expressions_.object(value)) + ";");
  }

  std::string sample(const Expression& state, const std::string& to) const {
    return line(fmt::format("input_at(context, {}, {});", expressions_.address(state), to));
  }

  std::string visit(const SineCosine& pair) {
    for (const std::string& variable : {pair.sine, pair.cosine}) declare_variable({}, {variable});
    const bool turns = scope_.type_of(pair.angle).kind == CType::Kind::kAngle;
    return line(fmt::format("{}({}, &{}, &{});", names_.internal(turns ? "angle_sine_cosine" : "sine_cosine"),
                            of(pair.angle), pair.sine, pair.cosine));
  }

  std::string visit(const Loop& loop) {
    declare_variable({Type::Kind::kInteger}, {loop.variable});
    const std::string& i = loop.variable;
    const std::string head =
        loop.descends
            ? fmt::format("for ({0} = {1} - 1; {0} >= {2}; --{0}) {{", i, of(loop.end), of(loop.first))
            : fmt::format("for ({0} = {1}; {0} < {2}; ++{0}) {{", i, of(loop.first), of(loop.end));
    return line(head) + block(loop.body, indent_ + 2) + line("}");
  }

  std::string visit(const AtStart& start) {
    std::string text =
        line(fmt::format("if ({} {} {}) {{", of(start.left), start.is_less ? "<" : "==", of(start.right))) +
        block(start.then, indent_ + 2);
    if (!start.otherwise.empty()) text += line("} else {") + block(start.otherwise, indent_ + 2);
    return text + line("}");
  }

  const Function& callee(const Call& call) const {
    const auto& known = call.is_support ? context_.support : context_.functions;
    const auto it = known.find(call.function);
    JD_CHECK(it != known.end(), "no function '{}'", call.function);
    return *it->second;
  }

  std::string visit(const Call& call) {
    const Function& called = callee(call);
    const bool samples = inputs_ == CInputs::kSampled;
    if (called.only_sampled && !samples) return "";
    std::string before, arguments;
    for (std::size_t k = 0; k < call.arguments.size(); ++k) {
      const Expression& argument = call.arguments[k];
      const Parameter& parameter = called.parameters.at(k);
      std::string text;
      if (argument.kind == Kind::kInputsAt && samples) {
        declare_variable({Type::Kind::kStruct, "Input"}, {"input"});
        before += sample(argument.operands[0], "&input");
        text = "&input";
      } else if (argument.kind == Kind::kInputsAt) {
        text = "input";
      } else if (parameter.is_inputs && samples) {
        text = "input_at, context";
      } else {
        text = is_struct(parameter) ? expressions_.address(argument) : of(argument);
      }
      arguments += (arguments.empty() ? "" : ", ") + text;
    }
    const std::string function =
        call.function + (samples && may_sample(called) && !called.only_sampled ? "_sampled" : "");
    return before +
           line(fmt::format("{}({});", call.is_support ? names_.internal(function) : names_.global(function),
                            arguments));
  }

  const CContext& context_;
  const CNames& names_;
  const Function& function_;
  CInputs inputs_;
  CScope scope_;
  CExpressions expressions_;
  std::vector<Declared> declared_;
  std::size_t indent_ = 2;
};

}  // namespace

bool may_sample(const Function& function) {
  return std::any_of(function.parameters.begin(), function.parameters.end(),
                     [](const Parameter& p) { return p.is_inputs; });
}

std::string c_signature(const CContext& context, const Function& function, CInputs inputs,
                        const std::string& name, const std::string& closing, const char* storage) {
  std::vector<std::string> parameters;
  for (const Parameter& p : function.parameters)
    parameters.push_back(parameter_text(context.names, p, inputs));
  const std::string result = function.result ? context.names.type(*function.result) : "void";
  return aligned(fmt::format("{}{} {}(", storage, result, name), parameters, ")" + closing);
}

std::string c_body(const CContext& context, const Function& function, CInputs inputs,
                   const std::vector<std::string>& of_model) {
  return BodyPrinter(context, function, inputs, of_model).text();
}

}  // namespace jourdain::emit::c
