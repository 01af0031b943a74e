#include "commands/equation_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <map>
#include <vector>

#include "commands/equation_names.hpp"
#include "compile/compile.hpp"
#include "dynamics/harmonics.hpp"
#include "emit/unique_names.hpp"
#include "loops/record/loop_plan.hpp"
#include "model/coordinates.hpp"
#include "model/joint_kinds.hpp"
#include "programs/tree_functions.hpp"
#include "support/constant_array.hpp"

namespace jourdain::commands {

namespace {

using ir::Op;
using ir::ValueId;

/// Largest number of coordinates for which expanded equations are readable.
constexpr std::size_t kExpandedCoordinates = 3;

constexpr const char* kWhereNegative = "where_negative(a, b): b where a < 0, else 0";
constexpr const char* kWhereNotNegative = "where_not_negative(a, b): 0 where a < 0, else b";

/// A line of its own, of LaTeX a comment.
std::string meaning(const std::string& sentence, bool latex) {
  return fmt::format("  {}{}\n", latex ? "% " : "", sentence);
}

/// Prints a program as one equation per named or shared value, then its outputs.
class EquationPrinter {
 public:
  EquationPrinter(const ir::Program& program, const PrintedNames& printed)
      : program_(program),
        mechanism_(printed.mechanism),
        spelling_(printed.spelling),
        latex_(spelling_.is_latex()),
        uses_(ir::use_counts(program)) {
    emit::Names identifiers({});  // of labels; these differ, but not all as they are printed
    const auto unused = [&](const std::string& label, const std::string& otherwise) {
      return spelling_.unused(identifiers.unique(label, otherwise), "_v");
    };
    for (std::size_t i = 0; i < program.nodes.size(); ++i) {
      const bool operation = ir::operand_count(program.nodes[i].op) > 0;
      const bool named = operation && (uses_[i] > 1 || !program.labels[i].empty());
      names_.push_back(named ? unused(program.labels[i], fmt::format("t{}", i)) : "");
    }
    for (const ir::Node& node : program.nodes)
      if (node.op == Op::kEntry && array_names_.count(array_of(node)) == 0) {
        arrays_.push_back(array_of(node));
        array_names_[arrays_.back()] = unused("", fmt::format("array{}", arrays_.size()));
      }
  }

  std::string print() const {
    std::string text;
    if (!latex_ && has(Op::kWhereNegative)) text += meaning(kWhereNegative, false);
    if (!latex_ && has(Op::kWhereNotNegative)) text += meaning(kWhereNotNegative, false);
    if (!arrays_.empty())
      text += meaning("entry(x, array): that of number floor(x), the first is 0; beyond an end that", latex_);
    for (const std::uint32_t array : arrays_) {
      std::vector<std::string> entries;
      for (const double entry : support::array_of(array)) entries.push_back(number(entry));
      text += equation(spelt(array_names_.at(array)), fmt::format("({})", fmt::join(entries, ", ")));
    }
    for (std::size_t i = 0; i < names_.size(); ++i)
      if (!names_[i].empty()) text += equation(spelt(names_[i]), expression(ValueId(i), true).text);
    for (const ir::Output& output : program_.outputs)
      text += equation(output_name(output), expression(output.value, false).text);
    return text;
  }

 private:
  bool has(Op op) const {
    return std::any_of(program_.nodes.begin(), program_.nodes.end(),
                       [op](const ir::Node& node) { return node.op == op; });
  }

  struct Text {
    std::string text;
    int strength;  ///< -1 cases, 0 sum, 1 product, 2 atom
  };

  std::string spelt(const std::string& name) const { return spelling_(name); }

  std::string number(double value) const {
    return latex_ ? dynamics::latex_number(value) : fmt::format("{}", value);
  }

  std::string equation(const std::string& left, const std::string& right) const {
    return latex_ ? fmt::format("  {} &= {} \\\\\n", left, right) : fmt::format("  {} = {}\n", left, right);
  }

  std::string output_name(const ir::Output& output) const {
    const bool barred = output.name == "k" || output.name == "q";
    const std::string base = !barred ? output.name : latex_ ? "\\bar " + output.name : output.name + "_bar";
    if (latex_ && base == "g_t") return fmt::format("g_{{t,{}}}", output.row);
    const std::string at = output.column < 0
                               ? fmt::format("{}", output.row)
                               : fmt::format("{}{}{}", output.row, latex_ ? "," : "][", output.column);
    return latex_ ? fmt::format("{}_{{{}}}", base, at) : fmt::format("{}[{}]", base, at);
  }

  std::string leaf(const ir::Node& node) const {
    switch (node.leaf) {
      case ir::LeafKind::kParameter:
        return spelt(mechanism_.parameters[node.index].name);
      case ir::LeafKind::kPosition:
        return spelt(fmt::format("y{}", node.index));
      case ir::LeafKind::kVelocity:
        return spelt(fmt::format("z{}", node.index));
      case ir::LeafKind::kInput:
        return spelt(fmt::format("u{}", node.index));
      case ir::LeafKind::kTime:
        return "t";
      case ir::LeafKind::kConstant:
      case ir::LeafKind::kAcceleration:
      case ir::LeafKind::kMultiplier:
      case ir::LeafKind::kStepLength:
      case ir::LeafKind::kHeld:
        break;
    }
    JD_CHECK(false, "leaf {}", ir::leaf_name(node.leaf));
    return "";
  }

  std::uint32_t array_of(const ir::Node& entry) const {
    return static_cast<std::uint32_t>(program_[entry.b].literal);
  }

  std::string at_least(const Text& text, int strength) const {
    if (text.strength >= strength) return text.text;
    return text.strength < 0 ? "\\left(" + text.text + "\\right)" : "(" + text.text + ")";
  }

  /// Of LaTeX: what comes behind `left` is no number of it.
  static std::string product(const std::string& left, const std::string& right) {
    return left + (std::isdigit(static_cast<unsigned char>(right.front())) ? " \\cdot " : " ") + right;
  }

  static Text cases(const std::string& decides, const std::string& negative, const std::string& otherwise) {
    return {dynamics::latex_cases(decides, negative, otherwise), -1};
  }

  Text expression(ValueId id, bool own) const {
    if (!own && !names_[id.value].empty()) return {spelt(names_[id.value]), 2};
    const ir::Node& node = program_[id];
    const auto a = [&](int strength) { return at_least(expression(node.a, false), strength); };
    const auto b = [&](int strength) { return at_least(expression(node.b, false), strength); };
    const std::string function = latex_ ? "\\" : "";
    switch (node.op) {
      case Op::kLiteral:
        return literal(node.literal);
      case Op::kLeaf:
        return {leaf(node), 2};
      case Op::kNegate:
        return {"-" + a(1), 0};
      case Op::kAdd:
        return {a(0) + " + " + b(1), 0};
      case Op::kSubtract:
        return {a(0) + " - " + b(1), 0};
      case Op::kMultiply:
        return {latex_ ? product(a(1), b(2)) : a(1) + "*" + b(1), 1};
      case Op::kDivide:
        if (latex_) return {fmt::format("\\frac{{{}}}{{{}}}", a(0), b(0)), 2};
        return {a(1) + "/" + b(2), 1};
      case Op::kSqrt:
        return {fmt::format(fmt::runtime(latex_ ? "\\sqrt{{{}}}" : "sqrt({})"), a(0)), 2};
      case Op::kSin:
        return {fmt::format("{}sin({})", function, a(0)), 2};
      case Op::kCos:
        return {fmt::format("{}cos({})", function, a(0)), 2};
      case Op::kEntry:
        return call(node.op, a(0), ", " + spelt(array_names_.at(array_of(node))));
      case Op::kWhereNegative:
        return latex_ ? cases(a(0), b(0), "0") : call(node.op, a(0), ", " + b(0));
      case Op::kWhereNotNegative:
        return latex_ ? cases(a(0), "0", b(0)) : call(node.op, a(0), ", " + b(0));
      default:
        return call(node.op, a(0), ir::operand_count(node.op) == 2 ? ", " + b(0) : "");
    }
  }

  Text literal(double value) const {
    const std::string text = number(value);
    return {text, value < 0 ? 0 : text.find("\\cdot") != std::string::npos ? 1 : 2};
  }

  Text call(Op op, const std::string& first, const std::string& more) const {
    std::string name = ir::op_name(op);
    if (latex_) {
      for (std::size_t at = 0; (at = name.find('_', at)) != std::string::npos; at += 2) name.insert(at, "\\");
      name = "\\operatorname{" + name + "}";
    }
    return {fmt::format("{}({}{})", name, first, more), 2};
  }

  const ir::Program& program_;
  const model::Mechanism& mechanism_;
  Spelling spelling_;
  bool latex_;
  std::vector<std::size_t> uses_;
  std::vector<std::string> names_;
  std::vector<std::uint32_t> arrays_;  ///< of constants that entries are taken of, in the order of their use
  std::map<std::uint32_t, std::string> array_names_;
};

std::string expanded(const dynamics::Equations& equations, bool latex) {
  std::string text;
  const auto line = [&](const std::string& left, const kinematics::Ex& value) {
    const std::string right = dynamics::to_text(dynamics::expand(equations, value), latex);
    text += latex ? fmt::format("  {} &= {} \\\\\n", left, right) : fmt::format("  {} = {}\n", left, right);
  };
  const std::size_t n = equations.M.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i; j < n; ++j)
      line(latex ? fmt::format("M_{{{},{}}}", i, j) : fmt::format("M[{}][{}]", i, j), equations.M[i][j]);
  for (std::size_t i = 0; i < n; ++i)
    line(latex ? fmt::format("\\bar k_{{{}}}", i) : fmt::format("k_bar[{}]", i), equations.k_bar[i]);
  for (std::size_t i = 0; i < n; ++i)
    line(latex ? fmt::format("\\bar q_{{{}}}", i) : fmt::format("q_bar[{}]", i), equations.q_bar[i]);
  if (!latex && text.find("where_not_negative(") != std::string::npos)
    text.insert(0, meaning(kWhereNotNegative, false));
  if (!latex && text.find("where_negative(") != std::string::npos)
    text.insert(0, meaning(kWhereNegative, false));
  return text;
}

std::string block(const std::string& title, const std::string& lines, bool latex) {
  if (latex) return fmt::format("% {}\n\\begin{{align*}}\n{}\\end{{align*}}\n", title, lines);
  return fmt::format("{}\n{}\n", title, lines);
}

/// Rows of all loops.
std::string constraints_text(const PrintedNames& names, const dynamics::Equations& equations) {
  const model::Mechanism& mechanism = names.mechanism;
  const bool latex = names.spelling.is_latex();
  if (mechanism.loops.empty()) return "";
  const loops::ConstraintPrograms programs = loops::constraint_programs(mechanism, equations).front();
  const auto print = [&](const ir::Program& program) { return EquationPrinter(program, names).print(); };
  return block("constraints with named intermediates", print(programs.value), latex) +
         block("their Jacobian with named intermediates, entries that are not zero", print(programs.jacobian),
               latex);
}

std::string legend(const PrintedNames& names) {
  const model::Mechanism& mechanism = names.mechanism;
  const bool latex = names.spelling.is_latex();
  std::string text;
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  const char* mark = latex ? "%" : "";
  const bool same = layout.position_names == layout.velocity_names;
  for (std::size_t i = 0; i < layout.position_count(); ++i)
    text += same ? fmt::format("{}  y{}, z{}: {}\n", mark, i, i, layout.position_names[i])
                 : fmt::format("{}  y{}: {}\n", mark, i, layout.position_names[i]);
  for (std::size_t i = 0; i < layout.velocity_count() && !same; ++i)
    text += fmt::format("{}  z{}: {}\n", mark, i, layout.velocity_names[i]);
  for (std::size_t k = 0; k < layout.input_count(); ++k)
    text += fmt::format("{}  u{}: {}\n", mark, k, layout.input_names[k]);
  const std::vector<std::string> rows = loops::row_names(mechanism);
  for (std::size_t r = 0; r < rows.size(); ++r) text += fmt::format("{}  g[{}]: {}\n", mark, r, rows[r]);
  for (const PrintedNames::Change& change : names.changes)
    text += fmt::format("{}  {}: parameter {}\n", mark, change.printed, change.parameter);
  return text;
}

/// Sums of products of sines and cosines of angles: joints that turn about and move along axes, and nothing else.
bool has_expanded_form(const model::Mechanism& mechanism) {
  for (const model::Joint& joint : mechanism.joints) {
    if (model::joint_kind(joint).has(model::MotionKind::kCurve)) return false;
    for (const model::Coordinate& c : joint.coordinates)
      if (c.motion || !c.friction.is_zero()) return false;
  }
  return model::lay_out_coordinates(mechanism).quaternions.empty() && model::has_inputs_alone(mechanism);
}

}  // namespace

std::string equations_text(const model::Mechanism& described, bool latex) {
  const PrintedNames names = printed_names(described, latex);
  const model::Mechanism& mechanism = names.mechanism;
  const dynamics::Equations equations = dynamics::derive_equations(mechanism);
  const bool closed = !mechanism.loops.empty();
  std::string text =
      fmt::format("{}{}: M zdot = k_bar - q_bar{}, dy/dt = {}{}\n", latex ? "% " : "", mechanism.name,
                  closed ? " - G^T lambda" : "", equations.ydot.empty() ? "z" : "Z z",
                  closed ? ", g(y, t) = 0, G z + g_t = 0; all coordinates of the tree" : "");
  text += legend(names);
  if (!latex) text += "\n";
  if (equations.M.size() <= kExpandedCoordinates && has_expanded_form(mechanism))
    text += block("Expanded", expanded(equations, latex), latex);
  for (const ir::Program& program :
       programs::lower_functions(equations, programs::with_needed({"mass_matrix", "k_bar", "q_bar"},
                                                                  programs::scene_facts(mechanism)))
           .functions)
    text += block(fmt::format("{} with named intermediates", program.name),
                  EquationPrinter(program, names).print(), latex);
  text += constraints_text(names, equations);
  return text;
}

}  // namespace jourdain::commands
