#include "readback/program_check.hpp"

#include <algorithm>
#include <map>

#include "readback/api.hpp"
#include "readback/function_texts.hpp"
#include "readback/interpreter.hpp"
#include "readback/tokens.hpp"

namespace jourdain::readback {

namespace {

using ir::LeafKind;

/// Results by their names: "coupler_curve.position[2]".
using Results = std::map<std::string, Number>;

std::string subscripts(const ir::Output& output) {
  std::string text;
  if (output.row >= 0) text += fmt::format("[{}]", output.row);
  if (output.column >= 0) text += fmt::format("[{}]", output.column);
  return text;
}

/// Names of an object's scalars in the order of memory.
void names_of(const Unit& unit, const Type* type, const std::string& prefix,
              std::vector<std::string>& names) {
  if (type->kind == Type::Kind::kArray) {
    for (long i = 0; i < type->extent; ++i)
      names_of(unit, type->element, fmt::format("{}[{}]", prefix, i), names);
  } else if (type->kind == Type::Kind::kStruct) {
    for (const Field& field : type->structure->fields)
      names_of(unit, field.type, (prefix.empty() ? "" : prefix + ".") + unit.symbols.text(field.name), names);
  } else {
    names.push_back(prefix);
  }
}

class FunctionCheck {
 public:
  FunctionCheck(const Unit& unit, const Expected& expected, NodeTable& table, Findings& findings)
      : unit_(unit), expected_(expected), table_(table), findings_(findings), run_(unit, table) {}

  void check(const FunctionApi& api, const ir::Program& program) {
    name_ = api.name;
    values_ = table_.insert(program);
    std::vector<Value> arguments = {Interpreter::as_const(model())};
    const Value state = this->state();
    const bool changes = api.result == Result::kCorrection || api.result == Result::kSampling;
    if (api.result != Result::kState) arguments.push_back(changes ? state : Interpreter::as_const(state));
    if (api.takes_input) arguments.push_back(Interpreter::as_const(input()));
    if (api.takes_acceleration) arguments.push_back(Interpreter::as_const(leaves(LeafKind::kAcceleration)));
    if (api.result == Result::kSampling) arguments.push_back(step_length());
    std::vector<Value> arrays;
    for (const ArrayArgument& array : api.arrays) arrays.push_back(run_.make(array_type(array)));
    arguments.insert(arguments.end(), arrays.begin(), arrays.end());
    if (api.result == Result::kStruct) arguments.push_back(run_.make(of_number(api.structure)));
    const std::vector<Cell> before = cells(state);
    table_.clear_count();
    const Value result = run_.call("", api.name, arguments);
    findings_.counts[api.name] = table_.count();
    switch (api.result) {
      case Result::kState:
        return compare(result, after(program, initial_state()));
      case Result::kNumber:
        return number(result);
      case Result::kArrays:
        for (std::size_t i = 0; i < arrays.size(); ++i) compare_array(api, api.arrays[i], arrays[i], program);
        return;
      case Result::kStruct:
        return compare(arguments.back(), after(program, zeros(arguments.back(), api.sparse)));
      case Result::kCorrection:
      case Result::kSampling:
        return compare(state, after(program, results(state, before)));
      case Result::kStep:
        return;
    }
  }

  void check_constructor(const ir::Program& program) {
    name_ = "model";
    values_ = table_.insert(program);
    const Value parameters = run_.make(of_number("Parameters"));
    for (std::size_t i = 0; i < parameters.type->cells; ++i)
      run_.cell(parameters, i) = number_cell(table_.leaf(LeafKind::kParameter, i));
    const Value object = run_.make(of_number("Model"));
    table_.clear_count();
    run_.construct(object, Interpreter::as_const(parameters));
    findings_.counts[name_] = table_.count();
    findings_.expect("number of the model's members", object.type->cells, program.outputs.size());
    std::vector<std::string> names;
    names_of(unit_, object.type, "", names);
    for (std::size_t i = 0; i < names.size(); ++i) {
      for (std::size_t k = 0; k < program.outputs.size(); ++k)
        if (program.outputs[k].row == static_cast<int>(i)) expect(names[i], run_.cell(object, i), values_[k]);
    }
  }

 private:
  const Type* of_number(const std::string& name) {
    return run_.types().instance(name, {{0, run_.types().number(), 0}});
  }

  const Type* array_type(const ArrayArgument& array) {
    const Type* type = run_.types().number();
    for (std::size_t i = array.extents.size(); i-- > 0;)
      type = run_.types().array(type, static_cast<long>(array.extents[i]));
    return type;
  }

  Value model() {
    const Value place = run_.make(of_number("Model"));
    for (std::size_t i = 0; i < place.type->cells; ++i)
      run_.cell(place, i) = number_cell(table_.leaf(LeafKind::kConstant, i));
    return place;
  }

  void fill(const Value& array, LeafKind kind) {
    for (std::size_t i = 0; i < array.type->cells; ++i)
      run_.cell(array, i) = number_cell(table_.leaf(kind, i));
  }

  Value state() {
    const Value place = run_.make(of_number("State"));
    for (std::size_t i = 0; i < place.type->cells; ++i) run_.cell(place, i) = number_cell(table_.mark(i));
    if (expected_.clock) run_.set(run_.field(place, "t"), table_.leaf(LeafKind::kTime, 0));
    if (!expected_.positions.empty()) fill(run_.field(place, "y"), LeafKind::kPosition);
    if (!expected_.velocities.empty()) fill(run_.field(place, "z"), LeafKind::kVelocity);
    return place;
  }

  Value input() {
    const Value place = run_.make(of_number("Input"));
    if (!expected_.inputs.empty()) fill(run_.field(place, "u"), LeafKind::kInput);
    return place;
  }

  Value step_length() {
    const Value place = run_.make(run_.types().number());
    run_.set(place, table_.leaf(LeafKind::kStepLength, 0));
    return place;
  }

  Value leaves(LeafKind kind) {
    const Value place = run_.make(array_type({"", {expected_.velocities.size()}}));
    fill(place, kind);
    return place;
  }

  std::vector<Cell> cells(const Value& object) {
    std::vector<Cell> list;
    for (std::size_t i = 0; i < object.type->cells; ++i) list.push_back(run_.cell(object, i));
    return list;
  }

  Results results(const Value& object, const std::vector<Cell>& held) const {
    std::vector<std::string> names;
    names_of(unit_, object.type, "", names);
    Results list;
    for (std::size_t i = 0; i < names.size(); ++i) list[names[i]] = held[i].number;
    return list;
  }

  /// What a state has before its program writes: t = 0, and of its closing nothing but good.
  Results initial_state() {
    Results list;
    if (expected_.clock) list["t"] = table_.literal(0.0);
    if (expected_.constraints.empty()) return list;
    list["regularity"] = table_.literal(1.0);
    list["opening"] = table_.literal(0.0);
    for (std::size_t i = 0; i < expected_.proven_positions.size(); ++i)
      list[fmt::format("beyond[{}]", i)] = table_.literal(0.0);
    return list;
  }

  Results zeros(const Value& object, bool sparse) {
    std::vector<std::string> names;
    names_of(unit_, object.type, "", names);
    Results list;
    if (sparse)
      for (const std::string& name : names) list[name] = table_.literal(0.0);
    return list;
  }

  Results after(const ir::Program& program, Results list) const {
    for (std::size_t i = 0; i < program.outputs.size(); ++i)
      list[program.outputs[i].name + subscripts(program.outputs[i])] = values_[i];
    return list;
  }

  void compare(const Value& object, const Results& wanted) {
    std::vector<std::string> names;
    names_of(unit_, object.type, "", names);
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto it = wanted.find(names[i]);
      if (it == wanted.end())
        findings_.add("{}: the program has nothing for {}", name_, names[i]);
      else
        expect(names[i], run_.cell(object, i), it->second);
    }
    findings_.expect(name_ + ": number of results", names.size(), wanted.size());
  }

  void compare_array(const FunctionApi& api, const ArrayArgument& array, const Value& place,
                     const ir::Program& program) {
    std::map<std::pair<int, int>, Number> wanted;
    const bool is_matrix = array.extents.size() > 1;
    for (std::size_t i = 0; i < program.outputs.size(); ++i) {
      const ir::Output& output = program.outputs[i];
      if (api.sparse && output.name != array.name) continue;
      wanted[{output.row, is_matrix ? output.column : 0}] = values_[i];
      if (api.symmetric) wanted[{output.column, output.row}] = values_[i];
    }
    const int columns = is_matrix ? static_cast<int>(array.extents[1]) : 1;
    for (int row = 0; row < static_cast<int>(array.extents[0]); ++row)
      for (int column = 0; column < columns; ++column) {
        const std::string name =
            array.name + (is_matrix ? fmt::format("[{}][{}]", row, column) : fmt::format("[{}]", row));
        const auto it = wanted.find({row, column});
        if (it == wanted.end() && !api.sparse)
          findings_.add("{}: the program has nothing for {}", name_, name);
        else
          expect(name,
                 run_.cell(place, static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                                      static_cast<std::size_t>(column)),
                 it == wanted.end() ? table_.literal(0.0) : it->second);
      }
  }

  void number(const Value& result) {
    if (values_.size() != 1 || result.kind != Value::Kind::kNumber)
      return findings_.add("{}: no number is returned", name_);
    expect("what is returned", number_cell(result.number), values_[0]);
  }

  void expect(const std::string& what, const Cell& found, Number wanted) {
    ++findings_.numbers;
    if (found == number_cell(wanted)) return;
    const std::string text = found.kind == Cell::Kind::kNumber ? table_.print(found.number) : "not written";
    findings_.add("{}: {} is {}, must be {}", name_, what, text, table_.print(wanted));
  }

  const Unit& unit_;
  const Expected& expected_;
  NodeTable& table_;
  Findings& findings_;
  Interpreter run_;
  std::string name_;
  std::vector<Number> values_;
};

constexpr std::pair<const char*, ir::Op> kUnary[] = {
    {"sine", ir::Op::kSin}, {"cosine", ir::Op::kCos}, {"square_root", ir::Op::kSqrt}};

void check_library(const Unit& unit, NumberType type, Findings& findings) {
  NodeTable table;
  Interpreter run(unit, table, type);
  const auto variable = [&](std::size_t index) {
    const Value place = run.make(run.types().number());
    run.set(place, table.mark(index));
    return place;
  };
  const auto expect = [&](const char* name, Number found, Number wanted) {
    if (found != wanted)
      findings.add("{} computes {}, must be {}", name, table.print(found), table.print(wanted));
  };
  const Value x = variable(0), y = variable(1);
  const Number a = table.mark(0), b = table.mark(1);
  const auto is_defined = [&unit](const std::string& name) {
    return std::any_of(unit.functions.begin(), unit.functions.end(), [&](const Function* function) {
      return function->scope == "detail" && unit.symbols.text(function->name) == name;
    });
  };
  for (const auto& [name, op] : kUnary)
    if (!unit.is_c || is_defined(name))
      expect(name, run.number(run.call("detail", name, {Interpreter::as_const(x)})), table.operate(op, a));
  if (!unit.is_c || is_defined("sine_cosine")) {
    const Value sine = variable(2), cosine = variable(3);
    run.call("detail", "sine_cosine", {Interpreter::as_const(x), sine, cosine});
    expect("sine_cosine", run.number(sine), table.operate(ir::Op::kSin, a));
    expect("sine_cosine", run.number(cosine), table.operate(ir::Op::kCos, a));
  }
  for (const auto& [given, op] : emitted_names()) {
    const std::string name(given);
    if (!is_defined(name)) continue;
    const bool is_unary = ir::operand_count(op) == 1;
    std::vector<Value> arguments = {Interpreter::as_const(x)};
    if (!is_unary) arguments.push_back(Interpreter::as_const(y));
    expect(name.c_str(), run.number(run.call("detail", name, arguments)),
           table.operate(op, a, is_unary ? Number(0) : b));
  }
}

}  // namespace

void check_library(const Unit& unit, const Expected& expected, Findings& findings) {
  const bool has_sines =
      unit.is_c ? std::any_of(unit.functions.begin(), unit.functions.end(),
                              [&](const Function* f) {
                                const std::string name(unit.symbols.text(f->name));
                                return f->scope == "detail" &&
                                       (name == "sine" || name == "cosine" || name == "sine_cosine");
                              })
                : expected.module && ir::has_angles(*expected.module);
  findings.expect("sines written out", unit.has_own_sines, expected.choices.own_sines && has_sines);
  for (const NumberType type : {NumberType::kOwn, NumberType::kDouble, NumberType::kFloat})
    if (!unit.is_c || type == NumberType::kOwn)
      findings.guarded("functions of the C library", [&] { check_library(unit, type, findings); });
}

void check_programs(const Unit& unit, const Expected& expected, NodeTable& table, Findings& findings) {
  findings.guarded("model", [&] {
    JD_CHECK(expected.module, "no module to compare with");
    FunctionCheck(unit, expected, table, findings).check_constructor(expected.module->constants);
  });
  for (const std::string& name : expected.functions) {
    const std::optional<FunctionApi> api = api_of(name, expected);
    if (!api) {
      findings.add("{} is no function of the API", name);
      continue;
    }
    if (api->result == Result::kStep) continue;
    const ir::Program* program = ir::find_program(*expected.module, name);
    if (!program) {
      findings.add("{} has no program", name);
      continue;
    }
    findings.guarded(name, [&] { FunctionCheck(unit, expected, table, findings).check(*api, *program); });
  }
}

}  // namespace jourdain::readback
