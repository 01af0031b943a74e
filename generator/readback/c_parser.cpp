#include "readback/c_parser.hpp"

#include <array>
#include <utility>

#include "readback/c_known_text.hpp"
#include "readback/statement_parser.hpp"

namespace jourdain::readback {

namespace {

/// Structs, without their prefix, and what C++ calls them.
constexpr std::array<std::pair<std::string_view, std::string_view>, 13> kStructs = {
    {{"parameters", "Parameters"},
     {"state", "State"},
     {"input", "Input"},
     {"output_values", "Outputs"},
     {"linearization", "Linearization"},
     {"model", "Model"},
     {"functions", "Functions"},
     {"rate_history1", "RateHistory1"},
     {"rate_history2", "RateHistory2"},
     {"accelerations", "Accelerations"},
     {"detail_implicit_step", "ImplicitStep"},
     {"detail_implicit_stage", "ImplicitStage"},
     {"detail_increment", "Increment"}}};

class CFileParser : public StatementParser {
 public:
  CFileParser(Unit& unit, Known& known, const Tokens& tokens, int file, const CKnownTexts& texts)
      : StatementParser(unit, known, tokens, file), comments_(tokens.comments), file_(file), texts_(texts) {
    double_.path = {unit.symbols["double"]};
  }

  void read_header() {
    unit_.opening_comment = comment();
    for (int k = 0; k < 3; ++k) directive();
    expect_word("extern");
    if (peek().kind != TokenKind::kString || take().text != "C") refuse_here("\"C\"");
    expect("{");
    directive();
    while (peek().kind != TokenKind::kDirective) item();
    directive();
    expect("}");
    directive();
    directive();
    if (peek().kind != TokenKind::kEnd) refuse_here("the end of the file");
  }

  void read_source() {
    while (peek().kind == TokenKind::kDirective) directive();
    while (peek().kind != TokenKind::kEnd) item();
  }

 private:
  void directive() {
    if (peek().kind != TokenKind::kDirective) refuse_here("a directive");
    unit_.directives[static_cast<std::size_t>(file_)].emplace_back(take().text);
  }

  std::string comment() const {
    return peek().comment < 0 ? "" : comments_[static_cast<std::size_t>(peek().comment)];
  }

  void item() {
    if (peek().kind == TokenKind::kEnd) refuse_here("a declaration");
    if (known_text() || table_function()) return;
    if (is_word("typedef")) return structure();
    if (is_word("enum")) return enumeration();
    if (is_word("extern")) return declared_constant();
    Function& function = unit_.all_functions.emplace_back();
    function.comment = comment();
    function.place = place();
    const bool is_static = accept_word("static");
    if (is_word("const")) return constant(is_static);
    function_item(function, is_static);
  }

  bool known_text() {
    for (const CKnownText& text : texts_.all()) {
      if (!begins(text.tokens)) continue;
      for (std::size_t i = 0; i + 1 < text.tokens.tokens.size(); ++i) take();
      if (!known_.c_operations.insert(text.name).second) refuse_here("no second " + text.name);
      unit_.has_own_sines = unit_.has_own_sines || (text.meaning && text.name == "sine_cosine");
      if (text.meaning) read_meaning(*text.meaning);
      if (text.name == "angle_sine") declare_of_number("sine");
      if (text.name == "angle_cosine") declare_of_number("cosine");
      if (text.name == "time") add_sum(known_.c->prefix + "time", {unit_.symbols["Time"]});
      if (text.name == "angle")
        add_sum(known_.c->internal() + "angle", {unit_.symbols["detail"], unit_.symbols["Angle"]});
      return true;
    }
    return false;
  }

  void read_meaning(const Tokens& meaning) { CFileParser(unit_, known_, meaning, file_, texts_).item(); }

  /// What a function of angles is read as, where own sines leave it out because nothing else calls it.
  void declare_of_number(const std::string& name) {
    if (!known_.c_operations.count("sine_cosine") || !known_.c_operations.insert(name).second) return;
    for (const CKnownText& text : texts_.all())
      if (text.name == name && text.meaning) read_meaning(*text.meaning);
  }

  bool begins(const Tokens& text) const {
    for (std::size_t i = 0; i + 1 < text.tokens.size(); ++i)
      if (peek(i).kind != text.tokens[i].kind || peek(i).text != text.tokens[i].text) return false;
    return true;
  }

  TypeName of_real(const std::vector<Symbol>& path) {
    TypeName type;
    type.path = path;
    TemplateArgument real;
    real.type.path = {unit_.symbols["Real"]};
    type.arguments = {real};
    return type;
  }

  void add_sum(const std::string& name, const std::vector<Symbol>& path) {
    unit_.numbers.insert(path.back());
    known_.c_types[unit_.symbols[name]] = of_real(path);
  }

  std::vector<TemplateParameter> over_reals(bool with_standard) {
    TemplateParameter parameter;
    parameter.name = unit_.symbols["Real"];
    if (with_standard) parameter.standard = &unit_.types.emplace_back(double_);
    return {parameter};
  }

  // structs

  void structure() {
    Struct& made = unit_.all_structs.emplace_back();
    made.place = place();
    expect_word("typedef");
    expect_word("struct");
    made.parameters_of_template = over_reals(true);
    members(made);
    name_struct(made);
    expect(";");
    unit_.structs.push_back(&made);
  }

  void name_struct(Struct& made) {
    const std::string whole(peek().text), &prefix = known_.c->prefix;
    for (const auto& [in_c, in_cpp] : kStructs) {
      if (whole != prefix + std::string(in_c)) continue;
      const bool is_internal = in_c.starts_with("detail_");
      made.scope = is_internal ? "detail" : "";
      made.name = unit_.symbols[in_cpp];
      std::vector<Symbol> path = {made.name};
      if (is_internal) path.insert(path.begin(), unit_.symbols["detail"]);
      if (!known_.c_types.emplace(unit_.symbols[whole], of_real(path)).second) refuse_here("a struct once");
      expect_name();
      return;
    }
    refuse_here("the name of a struct");
  }

  void members(Struct& made) {
    expect("{");
    if (is_word("char")) {  // C has no empty structs
      take();
      expect_word("none");
      expect(";");
      return expect("}");
    }
    if (is_word("void")) return user_functions();
    do {
      if (is_word("struct"))
        anonymous(made);
      else
        variables(made);
    } while (!accept("}"));
  }

  /// `void *context; double (*grip)(void *context, double slip);`
  void user_functions() {
    const auto pointer_to_context = [this] {
      expect_word("void");
      expect("*");
      expect_word("context");
    };
    pointer_to_context();
    expect(";");
    do {
      expect_word(known_.c->real());
      expect("(");
      expect("*");
      const std::string name = unit_.symbols.text(expect_name());
      expect(")");
      expect("(");
      pointer_to_context();
      std::vector<std::string> arguments;
      while (accept(",")) {
        expect_word(known_.c->real());
        arguments.push_back(unit_.symbols.text(expect_name()));
      }
      expect(")");
      expect(";");
      unit_.user_functions.emplace_back(name, arguments);
    } while (!accept("}"));
    if (peek().text != known_.c->prefix + "functions") refuse_here("the functions of the user");
  }

  void variables(Struct& made) {
    const TypeName read = type();
    do {
      Member& member = made.members.emplace_back();
      member.type = read;
      member.declarator = declarator(false);
    } while (accept(","));
    expect(";");
  }

  void anonymous(Struct& made) {
    Struct& inner = unit_.all_structs.emplace_back();
    inner.place = place();
    inner.parameters_of_template = made.parameters_of_template;
    expect_word("struct");
    members(inner);
    Member& member = made.members.emplace_back();
    member.anonymous = &inner;
    member.declarator = declarator(false);
    expect(";");
  }

  // constants

  void enumeration() {
    expect_word("enum");
    expect("{");
    do {
      Constant& made = unit_.all_constants.emplace_back();
      made.is_enumerator = true;
      made.type.path = {unit_.symbols["int"]};
      made.declarator.place = place();
      made.declarator.name = expect_name();
      expect("=");
      made.declarator.initial = expression();
      unit_.constants.push_back(&made);
    } while (accept(","));
    expect("}");
    expect(";");
  }

  Constant& constant_head() {
    Constant& made = unit_.all_constants.emplace_back();
    made.type = type();
    const bool is_pointer = accept("*");
    if (is_pointer) expect_word("const");
    made.declarator = declarator(false);
    if (made.declarator.indirection != 0) refuse_here("a constant");
    if (is_pointer) made.declarator.indirection = '*';
    return made;
  }

  void declared_constant() {
    expect_word("extern");
    unit_.declared_constants.push_back(&constant_head());
    expect(";");
  }

  void constant(bool is_static) {
    Constant& made = constant_head();
    made.scope = is_static ? "detail" : "";
    if (!is_static && file_ == 0) refuse_here("no definition in a header");
    expect("=");
    made.declarator.initial = expression();
    const auto& bounds = made.declarator.bounds;
    const bool fits = bounds.empty() ||
                      (bounds.size() == 1 && bounds[0] && bounds[0]->kind == ExpressionKind::kInteger &&
                       bounds[0]->integer == static_cast<long>(made.declarator.initial->arguments.size()));
    if (!fits) refuse_here("as many values as the array has entries");
    expect(";");
    unit_.constants.push_back(&made);
  }

  // functions

  void function_item(Function& function, bool is_static) {
    function.is_template = function.is_noexcept = true;
    function.parameters_of_template = over_reals(false);
    function.result = type();
    name_function(function, is_static);
    parameters(function);
    if (is("{"))
      function.body = block();
    else
      expect(";");
    unit_.functions.push_back(&function);
  }

  void name_function(Function& function, bool is_static) {
    std::string_view name = peek().text;
    const bool is_internal = name.starts_with(known_.c->internal());
    if (is_internal != is_static) refuse_here("a function that is static and named so, or neither");
    const std::string prefix = is_internal ? known_.c->internal() : known_.c->prefix;
    if (!name.starts_with(prefix)) refuse_here("a name that begins with " + prefix);
    const Symbol whole = expect_name();
    if (known_.c_types.count(whole)) refuse_here("a name that no type has");
    for (const Constant* constant : unit_.constants)
      if (constant->declarator.name == whole) refuse_here("a name that no constant has");
    name.remove_prefix(prefix.size());
    function.name = unit_.symbols[name];
    function.scope = is_internal ? "detail" : "";
  }

  void parameters(Function& function) {
    expect("(");
    do {
      Parameter& parameter = function.parameters.emplace_back();
      if (is_word(known_.c->prefix + "input_at")) {
        sampling(function, parameter);
        continue;
      }
      parameter.type = type();
      parameter.declarator = declarator(false);
      const bool is_array = !parameter.declarator.bounds.empty();
      if (parameter.declarator.indirection == '&' || (is_array && parameter.declarator.indirection != 0))
        refuse_here("a parameter");
      if (is_array) parameter.declarator.indirection = '&';  // and its length must be right
    } while (accept(","));
    expect(")");
  }

  /// `panda_input_at input_at, void *context`: a function of any type.
  void sampling(Function& function, Parameter& parameter) {
    if (!known_.c_operations.count("input_at")) refuse_here("a type");
    take();
    TemplateParameter& any = function.parameters_of_template.emplace_back();
    any.name = unit_.symbols["InputAt"];
    parameter.type.path = {any.name};
    parameter.type.is_const = true;
    parameter.declarator.indirection = '&';
    parameter.declarator.place = place();
    parameter.declarator.name = unit_.symbols["input_at"];
    expect_word("input_at");
    expect(",");
    expect_word("void");
    expect("*");
    expect_word("context");
  }

  const std::vector<std::string>& comments_;
  int file_ = 0;
  const CKnownTexts& texts_;
  TypeName double_;
};

}  // namespace

void parse_c(Unit& unit, const support::FileText& header, const support::FileText& source, const CText& c) {
  unit.is_c = true;
  unit.symbols["context"];
  ExpressionParser::Known known;
  known.c = &c;
  const CKnownTexts texts(c);
  for (const support::FileText* file : {&header, &source}) {
    unit.files.push_back(file->name);
    unit.directives.emplace_back();
    const Tokens tokens = tokenize(file->name, file->text);
    CFileParser parser(unit, known, tokens, static_cast<int>(unit.files.size()) - 1, texts);
    if (file == &header)
      parser.read_header();
    else
      parser.read_source();
  }
  for (const char* function : {"time_at", "time_after"})
    if (known.c_operations.count("time") != known.c_operations.count(function))
      refuse(source.name, 1, std::string(function) + " is missing");
}

}  // namespace jourdain::readback
