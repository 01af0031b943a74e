#include "readback/parser.hpp"

#include "readback/known_text.hpp"
#include "readback/statement_parser.hpp"

namespace jourdain::readback {

Symbol SymbolTable::operator[](std::string_view name) {
  if (const auto it = known_.find(name); it != known_.end()) return it->second;
  const auto symbol = static_cast<Symbol>(texts_.size());
  known_.emplace(texts_.emplace_back(name), symbol);
  return symbol;
}

namespace {

/// Namespaces, structs, functions and what is declared beside them.
class FileParser : public StatementParser {
 public:
  FileParser(Unit& unit, Known& known, const Tokens& tokens, int file)
      : StatementParser(unit, known, tokens, file), comments_(tokens.comments), file_(file) {}

  void read() {
    if (file_ == 0) unit_.opening_comment = comment();
    while (peek().kind == TokenKind::kDirective)
      unit_.directives[std::size_t(file_)].emplace_back(take().text);
    expect_word("namespace");
    const std::string name = unit_.symbols.text(expect_name());
    if (unit_.name_of_namespace.empty()) unit_.name_of_namespace = name;
    if (name != unit_.name_of_namespace) refuse_here("the namespace " + unit_.name_of_namespace);
    expect("{");
    namespace_body();
    if (peek().kind != TokenKind::kEnd) refuse_here("the end of the file");
  }

 private:
  void namespace_body() {
    while (!accept("}"))
      if (known_text() || (scope_ == "detail" && table_function()))
        continue;
      else if (accept_word("namespace"))
        inner_namespace();
      else
        item();
  }

  /// Takes a passage that stands for numbers.
  bool known_text() {
    for (const KnownText& text : known_texts(known_.packs)) {
      if (text.scope != scope_ || !begins(text.tokens)) continue;
      for (std::size_t i = 0; i + 1 < text.tokens.tokens.size(); ++i) take();
      if (text.type.empty()) return read_meaning(text);
      const Symbol name = unit_.symbols[text.type], space = unit_.symbols[text.scope];
      if (!unit_.numbers.insert(name).second) refuse_here("no second " + std::string(text.type));
      if (text.scope.empty())
        known_.struct_templates.insert(name);
      else
        known_.qualified.insert({space, name});
      return true;
    }
    return false;
  }

  /// Of a passage about packs or sines, each of which stands once.
  bool read_meaning(const KnownText& text) {
    if (!passages_read_.insert(&text).second) refuse_here("no second passage about packs or sines");
    unit_.has_own_sines = unit_.has_own_sines || text.is_own_sines;
    if (known_.packs) known_.function_templates.insert(unit_.symbols["number"]);
    if (!text.meaning) return true;
    FileParser inner(unit_, known_, *text.meaning, file_);
    inner.scope_ = scope_;
    while (inner.peek().kind != TokenKind::kEnd) inner.item();
    return true;
  }

  bool begins(const Tokens& text) const {
    for (std::size_t i = 0; i + 1 < text.tokens.size(); ++i)
      if (peek(i).kind != text.tokens[i].kind || peek(i).text != text.tokens[i].text) return false;
    return true;
  }

  void inner_namespace() {
    if (!scope_.empty()) refuse_here("no third namespace");
    const std::set<Symbol> outside = known_.struct_templates;
    scope_ = unit_.symbols.text(expect_name());
    expect("{");
    namespace_body();
    scope_.clear();
    known_.struct_templates = outside;
  }

  std::string comment() const {
    return peek().comment < 0 ? "" : comments_[static_cast<std::size_t>(peek().comment)];
  }

  void item() {
    Function& function = unit_.all_functions.emplace_back();
    function.comment = comment();
    function.place = place();
    function.scope = scope_;
    if (is_word("template") && !is("<", 1)) return explicit_instantiation(function);
    const std::set<Symbol> outside = known_.types;
    if (is_word("template")) {
      function.is_template = true;
      function.parameters_of_template = template_parameters();
    }
    if (is_word("struct"))
      structure(function.parameters_of_template);
    else
      function_or_constant(function);
    known_.types = outside;
  }

  std::vector<TemplateParameter> template_parameters() {
    expect_word("template");
    expect("<");
    std::vector<TemplateParameter> list;
    do {
      TemplateParameter& parameter = list.emplace_back();
      parameter.is_type = !is_word("int");
      if (parameter.is_type)
        expect_word("class");
      else
        take();
      parameter.name = expect_name();
      if (parameter.is_type) known_.types.insert(parameter.name);
      if (accept("=")) parameter.standard = &unit_.types.emplace_back(type());
    } while (accept(","));
    expect(">");
    return list;
  }

  void explicit_instantiation(Function& function) {
    take();
    if (accept_word("struct")) {
      unit_.struct_instantiations.push_back(type());
      expect(";");
      return;
    }
    expect_word(kFunctionMacro);
    function.has_stages = accept_word(kStagesMacro);
    head(function);
    expect(";");
    unit_.instantiations.push_back(&function);
  }

  void function_or_constant(Function& function) {
    const bool is_function = accept_word(kFunctionMacro), is_inline = accept_word("inline");
    if (is_function && !accept_word(kInlinedMacro)) function.has_stages = accept_word(kStagesMacro);
    if (!is_function) {
      expect_word("constexpr");
      constant(is_inline);
      return;
    }
    if (is_inline && is_word("int") && !function.is_template && !function.has_stages) return table();
    function.is_inline = is_inline;
    if (is_constructor_outside()) {
      constructor_outside(function);
    } else {
      head(function);
    }
    if (is("{"))
      function.body = block();
    else
      expect(";");
    unit_.functions.push_back(&function);
    if (function.is_template) known_.function_templates.insert(function.name);
  }

  /// `Model<Real>::Model(`
  bool is_constructor_outside() const {
    return starts_type() && is("<", 1) && is(">", 3) && is("::", 4) && is("(", 6);
  }

  void constructor_outside(Function& function) {
    const TypeName owner = type();
    function.scope = unit_.symbols.text(owner.path.back());
    expect("::");
    function.is_constructor = true;
    function.name = expect_name();
    const auto& own = function.parameters_of_template;
    const bool of_template = own.size() == 1 && owner.arguments.size() == 1 &&
                             owner.arguments[0].type.path == std::vector<Symbol>{own[0].name};
    if (function.name != owner.path.back() || !of_template) refuse_here("a constructor");
    const std::set<Symbol> outside = known_.types;
    for (const Struct* known : unit_.structs)
      if (known->name == owner.path.back())
        for (const auto& [alias, type] : known->aliases) known_.types.insert(alias);
    parameters(function);
  }

  void head(Function& function) {
    if (!starts_type()) refuse_here("a declaration");
    function.result = type();
    if (is("&") || is("*")) function.result_indirection = take().text[0];
    function.name = expect_name();
    parameters(function);
  }

  void parameters(Function& function) {
    expect("(");
    if (!is(")")) do {
        Parameter& parameter = function.parameters.emplace_back();
        parameter.type = type();
        parameter.declarator = declarator(true);
        initializer(parameter.declarator);
      } while (accept(","));
    expect(")");
    function.is_noexcept = accept_word("noexcept");
  }

  Constant& constant(bool is_inline) {
    Constant& made = unit_.all_constants.emplace_back();
    made.is_inline = is_inline;
    made.scope = scope_;
    made.type = type();
    made.declarator = declarator(false);
    initializer(made.declarator);
    expect(";");
    unit_.constants.push_back(&made);
    return made;
  }

  /// A function of the entries of a constant.
  void table() {
    expect_word("int");
    const Symbol name = expect_name();
    expect_text("(int k) noexcept { static constexpr");
    if (!is_word("int")) refuse_here("whole numbers");
    Constant& made = constant(false);
    expect_text("return list[k]; }");
    if (unit_.symbols.text(made.declarator.name) != "list" || made.declarator.bounds.size() != 1)
      refuse_here("a list");
    made.declarator.name = name;
    known_.tables.insert(name);
  }

  void structure(const std::vector<TemplateParameter>& parameters_of_template) {
    Struct& made = unit_.all_structs.emplace_back();
    made.place = place();
    take();
    made.name = expect_name();
    made.scope = scope_;
    made.parameters_of_template = parameters_of_template;
    if (parameters_of_template.empty()) refuse_here("a template of a struct");
    known_.struct_templates.insert(made.name);
    const Symbol space = unit_.symbols[scope_.empty() ? unit_.name_of_namespace : scope_];
    known_.qualified.insert({space, made.name});
    if (!is(";")) members(made);
    expect(";");
    unit_.structs.push_back(&made);
  }

  void members(Struct& made) {
    expect("{");
    while (!accept("}")) member(made);
  }

  void member(Struct& made) {
    if (is_word("using")) return alias(made);
    if (is_word("struct")) return anonymous(made);
    const bool is_function = accept_word(kFunctionMacro), is_explicit = accept_word("explicit");
    const bool is_constructor = is_function && peek().text == unit_.symbols.text(made.name) && is("(", 1);
    const bool is_static = accept_word("static");
    if (is_explicit && !is_constructor) refuse_here("a constructor");
    if (is_constructor) {
      Function& function = member_function(made);
      function.is_explicit = is_explicit;
      function.is_constructor = true;
      function.name = expect_name();
      if (function.name != made.name) refuse_here("a constructor");
      parameters(function);
      return expect(";");
    }
    const bool is_constexpr = accept_word("constexpr");
    const std::string before = comment();
    const Place where = place();
    const TypeName read = type();
    if (is_function) {
      Function& function = member_function(made);
      function.comment = before;
      function.place = where;
      function.is_static = is_static;
      function.result = read;
      function.name = expect_name();
      parameters(function);
      function.body = block();
      return;
    }
    variables(made, read, is_static, is_constexpr);
  }

  Function& member_function(Struct& made) {
    Function& function = unit_.all_functions.emplace_back();
    function.place = place();
    function.scope = unit_.symbols.text(made.name);
    made.functions.push_back(&function);
    return function;
  }

  void variables(Struct& made, const TypeName& read, bool is_static, bool is_constexpr) {
    if (is_static != is_constexpr) refuse_here("static constexpr together");
    do {
      Member& member = made.members.emplace_back();
      member.type = read;
      member.is_static = is_static;
      member.is_constexpr = is_constexpr;
      member.declarator = declarator(false);
      initializer(member.declarator);
    } while (accept(","));
    expect(";");
  }

  void alias(Struct& made) {
    take();
    const Symbol name = expect_name();
    expect("=");
    if (!made.aliases.emplace(name, type()).second) refuse_here("an alias once");
    known_.types.insert(name);
    expect(";");
  }

  void anonymous(Struct& made) {
    Struct& inner = unit_.all_structs.emplace_back();
    inner.place = place();
    inner.scope = made.scope;
    inner.parameters_of_template = made.parameters_of_template;
    take();
    members(inner);
    Member& member = made.members.emplace_back();
    member.anonymous = &inner;
    member.declarator = declarator(false);
    expect(";");
  }

  const std::vector<std::string>& comments_;
  int file_ = 0;
  std::string scope_;
  std::set<const KnownText*> passages_read_;
};

std::string text_of(const Unit& unit, const Expression& bound) {
  if (bound.kind == ExpressionKind::kInteger) return std::to_string(bound.integer);
  if (bound.kind == ExpressionKind::kName && !bound.type) return unit.symbols.text(bound.name);
  return "?";
}

}  // namespace

void parse(Unit& unit, const std::vector<const support::FileText*>& files, bool packs) {
  ExpressionParser::Known known;
  known.packs = packs;
  for (const support::FileText* file : files) {
    unit.files.push_back(file->name);
    unit.directives.emplace_back();
    const Tokens tokens = tokenize(file->name, file->text);
    FileParser(unit, known, tokens, static_cast<int>(unit.files.size()) - 1).read();
  }
}

std::string text_of(const Unit& unit, const TypeName& type) {
  std::string text = type.is_const ? "const " : "";
  for (std::size_t i = 0; i < type.path.size(); ++i)
    text += (i == 0 ? "" : "::") + unit.symbols.text(type.path[i]);
  std::string arguments;
  for (const TemplateArgument& argument : type.arguments)
    arguments += (arguments.empty() ? "" : ", ") +
                 (argument.value ? text_of(unit, *argument.value) : text_of(unit, argument.type));
  return text + (type.arguments.empty() ? "" : "<" + arguments + ">");
}

std::string text_of(const Unit& unit, const TypeName& type, const Declarator& declarator) {
  std::string text = text_of(unit, type), bounds;
  for (const Expression* bound : declarator.bounds)
    bounds += "[" + (bound ? text_of(unit, *bound) : "") + "]";
  if (declarator.indirection == '&' && !bounds.empty()) return text + " (&)" + bounds;
  if (declarator.indirection != 0) text += declarator.indirection;
  return text + bounds;
}

std::string signature_of(const Unit& unit, const Function& function) {
  std::string text = text_of(unit, function.result), parameters;
  if (function.result_indirection != 0) text += function.result_indirection;
  for (const Parameter& parameter : function.parameters)
    parameters += (parameters.empty() ? "" : ", ") + text_of(unit, parameter.type, parameter.declarator);
  return text + " " + unit.symbols.text(function.name) + "(" + parameters + ")" +
         (function.is_noexcept ? " noexcept" : "");
}

}  // namespace jourdain::readback
