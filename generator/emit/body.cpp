#include "emit/body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "emit/bundles.hpp"
#include "emit/called_functions.hpp"

namespace jourdain::emit {

using ir::Node;
using ir::Op;
using ir::Program;
using ir::ValueId;

namespace {

/// Values that depend on time and that an angle is made of: operands of sines and cosines, through sums and products.
std::vector<bool> angles_of_time(const Program& program) {
  const std::size_t n = program.nodes.size();
  std::vector<bool> depends(n, false), is_angle(n, false);
  const auto operands = [&](std::size_t i, const auto& visit) {
    const Node& node = program.nodes[i];
    const int count = ir::operand_count(node.op);
    if (count > 0) visit(node.a.value);
    if (count > 1) visit(node.b.value);
  };
  for (std::size_t i = 0; i < n; ++i) {
    const Node& node = program.nodes[i];
    depends[i] = node.op == Op::kLeaf && node.leaf == ir::LeafKind::kTime;
    operands(i, [&](std::size_t operand) { depends[i] = depends[i] || depends[operand]; });
  }
  for (std::size_t i = n; i-- > 0;) {
    const Op op = program.nodes[i].op;
    const bool turns = op == Op::kSin || op == Op::kCos;
    const bool is_of_reals = op == Op::kSqrt || ir::is_function(op);
    if (turns || (is_angle[i] && !is_of_reals))
      operands(i, [&](std::size_t operand) { is_angle[operand] = is_angle[operand] || depends[operand]; });
    if (turns || is_of_reals) is_angle[i] = false;
  }
  return is_angle;
}

class BodyBuilder {
 public:
  BodyBuilder(const Program& program, Names names, const LeafPlace& leaf, const ResultStatement& result,
              const StoredValues& stored)
      : program_(program),
        leaf_(leaf),
        result_(result),
        stored_(stored),
        bundles_(program),
        uses_(uses_in_text(program)),
        is_angle_(angles_of_time(program)),
        name_(program.nodes.size()) {
    for (std::size_t i = 0; i < program.nodes.size(); ++i)
      if (const auto it = stored.find(ValueId(i)); it != stored.end())
        name_[i] = it->second;
      else if (bundles_.first(i) != i)
        name_[i] = name_[bundles_.first(i)];
      else if (is_statement(i))
        name_[i] = names.unique(program.labels[i], fmt::format("t{}", i));
    find_pairs();
    name_gathered(names);
  }

  Body build(const Lengths& lengths) {
    std::vector<std::size_t> statements;
    for (std::size_t i = 0; i < program_.nodes.size(); ++i)
      if (!name_[i].empty() && bundles_.first(i) == i) statements.push_back(i);
    std::vector<Declaration> declarations;
    for (const std::size_t i : statements) declarations.push_back({i, bundles_.width(i), reads(i)});
    const Parts parts = cut_into_parts(declarations, pair_, read_by_outputs(), lengths);
    for (const auto& [i, entry] : parts.entries) is_angle_[i] = false;
    Body body;
    body.work_size = parts.size;
    for (std::size_t part = 0; part < parts.count; ++part)
      body.parts.push_back(part_statements(part, declarations, parts));
    for (const ir::Output& output : program_.outputs)
      if (!stored_.count(output.value)) body.parts.back().push_back(result_(output, real(output.value)));
    return body;
  }

 private:
  bool is_statement(std::size_t i) const {
    const Node& node = program_.nodes[i];
    if (ir::operand_count(node.op) == 0 || node.op == Op::kArgument) return false;
    if (node.op == Op::kSin || node.op == Op::kCos) return true;
    if (node.op == Op::kNegate) return uses_[i] > 1;
    if (bundles_.width(i) > 1) return !bundles_.is_read_once(i) || !program_.labels[i].empty();
    return uses_[i] > 1 || !program_.labels[i].empty();
  }

  /// Sines and cosines of the same angle; the later one of a pair is computed with the earlier.
  void find_pairs() {
    std::map<ValueId, std::size_t> sines, cosines;
    for (std::size_t i = 0; i < program_.nodes.size(); ++i) {
      if (program_.nodes[i].op == Op::kSin) sines[program_.nodes[i].a] = i;
      if (program_.nodes[i].op == Op::kCos) cosines[program_.nodes[i].a] = i;
    }
    for (const auto& [angle, sine] : sines)
      if (const auto it = cosines.find(angle);
          it != cosines.end() && !stored_.count(ValueId(sine)) && !stored_.count(ValueId(it->second))) {
        pair_[std::min(sine, it->second)] = std::max(sine, it->second);
        second_.insert(std::max(sine, it->second));
      }
  }

  /// Terms of bundles that are brought together for several of them.
  void name_gathered(Names& names) {
    std::map<std::vector<ValueId>, std::size_t> count;
    for (const std::vector<ValueId>& bundle : program_.lanes)
      for (int k = 0; k < ir::operand_count(program_[bundle[0]].op); ++k)
        if (std::vector<ValueId> terms = bundles_.operands(bundle[0].value, k); is_gathered(terms))
          ++count[std::move(terms)];
    for (const auto& [terms, uses] : count)
      if (const std::string& first = name_[terms[0].value]; uses > 1)
        gathered_[terms] =
            names.unique(first.empty() ? "" : first + "s", fmt::format("g{}", gathered_.size()));
  }

  /// One number for all lanes.
  static bool is_same(const std::vector<ValueId>& values) {
    return std::count(values.begin(), values.end(), values[0]) == std::ssize(values);
  }

  bool is_gathered(const std::vector<ValueId>& values) const {
    return !bundles_.are_bundle(values) && !is_same(values) &&
           !std::all_of(values.begin(), values.end(),
                        [this](ValueId value) { return program_[value].op == Op::kLiteral; });
  }

  /// Statements that statement `i` reads, through the expressions written inside it.
  void operands(std::size_t i, std::set<std::size_t>& found) const {
    for (const ValueId lane : bundles_.together(i)) {
      const Node& node = program_[lane];
      for (int k = 0; k < ir::operand_count(node.op); ++k) {
        const std::size_t operand = (k == 0 ? node.a : node.b).value;
        if (!name_[operand].empty())
          found.insert(bundles_.first(operand));
        else if (bundles_.first(operand) == operand)
          operands(operand, found);
      }
    }
  }

  std::set<std::size_t> reads(std::size_t i) const {
    std::set<std::size_t> found;
    operands(i, found);
    return found;
  }

  std::set<std::size_t> read_by_outputs() const {
    std::set<std::size_t> read;
    for (const ir::Output& output : program_.outputs)
      if (name_[output.value.value].empty())
        operands(output.value.value, read);
      else
        read.insert(bundles_.first(output.value.value));
    return read;
  }

  Statements part_statements(std::size_t index, const std::vector<Declaration>& declarations,
                             const Parts& parts) const {
    Statements part;
    std::set<std::size_t> fetched;
    std::set<std::string> brought;
    const auto fetch = [&](const std::set<std::size_t>& needed) {
      for (const std::size_t i : needed)
        if (parts.part_of.at(i) < index && fetched.insert(i).second)
          part.push_back(fetched_statement(i, parts.entries.at(i)));
    };
    for (const Declaration& declaration : declarations) {
      const std::size_t i = declaration.value;
      if (parts.part_of.at(i) != index) continue;
      fetch(declaration.reads);
      bring_together(part, i, brought);
      add_statement(part, i);
      if (const auto entry = parts.entries.find(i); entry != parts.entries.end())
        pass_on(part, i, entry->second);
    }
    if (index + 1 == parts.count) fetch(read_by_outputs());
    return part;
  }

  /// A value of an earlier part, where it is first read.
  Statement fetched_statement(std::size_t i, std::size_t entry) const {
    const Expression w = name("w");
    const std::size_t width = bundles_.width(i);
    return width == 1 ? constant(name_[i], w[entry])
                      : constant_lanes(name_[i], width, lanes(entries(w, entry, width)));
  }

  /// To later parts, as soon as it is known: what waits for the end of a part keeps a register or is stored twice.
  void pass_on(Statements& part, std::size_t i, std::size_t entry) const {
    for (std::size_t l = 0; l < bundles_.width(i); ++l)
      part.push_back(set(name("w")[entry + l], by_name(bundles_.together(i)[l])));
  }

  static std::vector<Expression> entries(const Expression& array, std::size_t first, std::size_t count) {
    std::vector<Expression> list;
    for (std::size_t l = 0; l < count; ++l) list.push_back(array[first + l]);
    return list;
  }

  static Statement constant_lanes(const std::string& variable, std::size_t count, Expression value) {
    const Type type{Type::Kind::kLanes, {}, false, static_cast<int>(count)};
    return {Declare{type, Declare::Change::kConstant, {{variable, {}, std::move(value)}}}};
  }

  std::vector<Expression> reals(const std::vector<ValueId>& values) const {
    std::vector<Expression> list;
    for (const ValueId value : values) list.push_back(real(value));
    return list;
  }

  /// Declares what statement `i` is the first of the part to need, through the expressions written inside it.
  void bring_together(Statements& part, std::size_t i, std::set<std::string>& brought) const {
    const bool is_bundle = bundles_.width(i) > 1;
    for (int k = 0; k < ir::operand_count(program_.nodes[i].op); ++k) {
      const std::vector<ValueId> terms = bundles_.operands(i, k);
      if (is_bundle && bundles_.are_bundle(terms)) {
        if (name_[terms[0].value].empty()) bring_together(part, terms[0].value, brought);
        continue;
      }
      for (const ValueId term : terms)
        if (name_[term.value].empty()) bring_together(part, bundles_.first(term.value), brought);
      const auto it = gathered_.find(terms);
      if (is_bundle && it != gathered_.end() && brought.insert(it->second).second)
        part.push_back(constant_lanes(it->second, terms.size(), lanes(reals(terms))));
    }
  }

  void add_statement(Statements& part, std::size_t i) const {
    if (second_.count(i)) return;
    if (bundles_.width(i) > 1) {
      part.push_back(constant_lanes(name_[i], bundles_.width(i), computation_of_bundle(i)));
      return;
    }
    const auto it = pair_.find(i);
    if (it != pair_.end()) {
      const bool sine_first = program_.nodes[i].op == Op::kSin;
      const std::string &sine = name_[sine_first ? i : it->second],
                        &cosine = name_[sine_first ? it->second : i];
      part.push_back({Declare{{}, Declare::Change::kFree, {{sine}, {cosine}}}});
      part.push_back({SineCosine{as_computed(program_.nodes[i].a), sine, cosine}});
    } else if (stored_.count(ValueId(i))) {
      part.push_back(set(name(name_[i]), computation(ValueId(i))));
    } else {
      const Type type{is_angle_[i] ? Type::Kind::kAngle : Type::Kind::kReal};
      part.push_back({Declare{type, Declare::Change::kConstant, {{name_[i], {}, computation(ValueId(i))}}}});
    }
  }

  /// A value as a real: by its name where it has one.
  Expression real(ValueId id) const {
    const Node& node = program_[id];
    if (node.op == Op::kLeaf && node.leaf == ir::LeafKind::kTime)
      return to_real(leaf_(node.leaf, node.index));
    return is_angle_[id.value] ? to_real(as_computed(id)) : as_computed(id);
  }

  /// A value as it is computed: an angle where it is one.
  Expression as_computed(ValueId id) const { return name_[id.value].empty() ? computation(id) : by_name(id); }

  Expression by_name(ValueId id) const {
    const std::optional<Bundles::Place> lane = bundles_.place_of(id.value);
    return lane ? name(name_[id.value])[lane->lane] : name(name_[id.value]);
  }

  /// Of all lanes of a bundle.
  Expression computation_of_bundle(std::size_t first) const {
    const Op op = program_.nodes[first].op;
    std::vector<Expression> operands;
    for (int k = 0; k < ir::operand_count(op); ++k) {
      const std::vector<ValueId> terms = bundles_.operands(first, k);
      const std::string& known = name_[terms[0].value];
      if (bundles_.are_bundle(terms))
        operands.push_back(known.empty() ? computation_of_bundle(terms[0].value) : name(known));
      else if (is_same(terms))
        operands.push_back(real(terms[0]));
      else if (const auto it = gathered_.find(terms); it != gathered_.end())
        operands.push_back(name(it->second));
      else
        operands.push_back(lanes(reals(terms)));
    }
    return operation(op, std::move(operands));
  }

  Expression computation(ValueId id) const {
    const Node& node = program_[id];
    if (node.op == Op::kLiteral) return node.literal;
    if (node.op == Op::kLeaf) {
      const Expression place = leaf_(node.leaf, node.index);
      return node.leaf == ir::LeafKind::kTime ? to_angle(place) : place;
    }
    if (node.op == Op::kCall) return call(node);
    const bool turns = node.op == Op::kSin || node.op == Op::kCos;
    const bool of_angles =
        turns || (is_angle_[id.value] && node.op != Op::kSqrt && !ir::is_function(node.op));
    std::vector<Expression> operands;
    for (int k = 0; k < ir::operand_count(node.op); ++k) {
      const ValueId operand = k == 0 ? node.a : node.b;
      operands.push_back(of_angles ? as_computed(operand) : real(operand));
    }
    return operation(node.op, std::move(operands));
  }

  Expression call(const Node& node) const {
    std::vector<Expression> arguments;
    for (Node list = program_[node.a]; list.op == Op::kArgument; list = program_[list.b])
      arguments.insert(arguments.begin(), real(list.a));
    return invoke(name("model").dot("functions"), support::called_by(program_[node.b].literal).member(),
                  std::move(arguments));
  }

  const Program& program_;
  const LeafPlace& leaf_;
  const ResultStatement& result_;
  const StoredValues& stored_;
  Bundles bundles_;
  std::map<std::vector<ValueId>, std::string> gathered_;  ///< variables of terms that several bundles read
  std::vector<std::size_t> uses_;
  std::vector<bool> is_angle_;
  std::vector<std::string> name_;  ///< of statements; empty for what is written inside them
  std::map<std::size_t, std::size_t> pair_;
  std::set<std::size_t> second_;
};

}  // namespace

bool turns_with_time(const Program& program) {
  const std::vector<bool> is_angle = angles_of_time(program);
  return std::find(is_angle.begin(), is_angle.end(), true) != is_angle.end();
}

bool any_turns_with_time(const ir::Module& module) {
  return std::any_of(module.functions.begin(), module.functions.end(), turns_with_time);
}

Body body_of(const Program& program, Names names, const LeafPlace& leaf, const ResultStatement& result,
             const StoredValues& stored, const Lengths& lengths) {
  return BodyBuilder(program, std::move(names), leaf, result, stored).build(lengths);
}

}  // namespace jourdain::emit
