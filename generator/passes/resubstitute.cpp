#include "passes/resubstitute.hpp"

#include <array>
#include <optional>

#include "ir/fixed_values.hpp"
#include "passes/equal_values.hpp"
#include "passes/rewrite.hpp"
#include "passes/sampled_rounding.hpp"

namespace jourdain::passes {

using ir::Node;
using ir::Op;
using ir::Program;
using ir::Signed;
using ir::ValueId;

namespace {

bool is_operation(Op op) {
  switch (op) {
    case Op::kAdd:
    case Op::kSubtract:
    case Op::kMultiply:
    case Op::kDivide:
    case Op::kSqrt:
      return true;
    case Op::kLiteral:
    case Op::kLeaf:
    case Op::kNegate:
    case Op::kSin:
    case Op::kCos:
    default:
      break;
  }
  return false;
}

class Substitution {
 public:
  Substitution(const Program& program, std::vector<Fingerprint> fingerprints)
      : program_(program),
        equal_(program, std::move(fingerprints)),
        rounding_(program),
        values_(program.nodes.size()) {
    const std::vector<std::size_t> uses = ir::use_counts(program);
    for (std::size_t i = 0; i < values_.size(); ++i) {
      values_[i].uses = uses[i];
      values_[i].fixed = is_fixed(i);
    }
  }

  /// None where nothing is saved. From the results to what they need: what goes with a result needs no other way.
  std::optional<Program> run() {
    const int before = total();
    for (bool improved = true; improved;) {
      improved = false;
      for (std::size_t i = values_.size(); i-- > 0;)
        if (values_[i].uses > 0 && is_operation(program_.nodes[i].op)) improved = improve(i) || improved;
      if (improved) take_back();
    }
    return total() < before ? std::optional(rewritten()) : std::nullopt;
  }

 private:
  struct Alternative {
    Definition definition;
    std::optional<bool> admitted = {};  ///< if that was asked
  };

  struct Value {
    Definition definition;
    std::size_t uses = 0;                       ///< by values that are needed, and by outputs
    bool fixed = false;                         ///< depends on literals and parameters alone
    bool has_lines = false, has_pairs = false;  ///< among its alternatives
    std::vector<Alternative> alternatives;
  };

  /// Values that `i` reads as it is defined now.
  std::array<std::optional<std::size_t>, 2> operands(std::size_t i) const {
    const Definition& definition = values_[i].definition;
    const Node& node = program_.nodes[i];
    const bool own = definition.kind == Definition::Kind::kOwn;
    const int count = own ? ir::operand_count(node.op) : definition.operands();
    std::array<std::optional<std::size_t>, 2> list;
    if (count >= 1) list[0] = own ? node.a.value : definition.x.value.value;
    if (count == 2) list[1] = own ? node.b.value : definition.y.value.value;
    return list;
  }

  bool is_fixed(std::size_t i) const {
    const Node& node = program_.nodes[i];
    if (values_[i].definition.kind == Definition::Kind::kOwn && node.op == Op::kLeaf)
      return ir::is_made_with_the_model(node.leaf);
    const auto [a, b] = operands(i);
    return (!a || values_[*a].fixed) && (!b || values_[*b].fixed);
  }

  /// Operations of a value. Those on parameters and literals alone go to the model's constants.
  int cost(std::size_t i) const {
    const Definition& definition = values_[i].definition;
    if (values_[i].fixed) return 0;
    const bool own = definition.kind == Definition::Kind::kOwn;
    return own ? int(is_operation(program_.nodes[i].op)) : definition.operations();
  }

  int total() const {
    int sum = 0;
    for (std::size_t i = 0; i < values_.size(); ++i)
      if (values_[i].uses > 0) sum += cost(i);
    return sum;
  }

  /// Takes one use away from what `i` reads. Returns what is not computed any more then.
  int release_operands(std::size_t i) {
    int freed = 0;
    for (const auto& operand : operands(i))
      if (operand && --values_[*operand].uses == 0) freed += cost(*operand) + release_operands(*operand);
    return freed;
  }

  /// The opposite.
  int acquire_operands(std::size_t i) {
    int taken = 0;
    for (const auto& operand : operands(i))
      if (operand && values_[*operand].uses++ == 0) taken += cost(*operand) + acquire_operands(*operand);
    return taken;
  }

  void define(std::size_t i, const Definition& definition) {
    values_[i].definition = definition;
    values_[i].fixed = is_fixed(i);
  }

  /// Ways were admitted one by one: those that together lose digits are taken back for good.
  void take_back() {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      Value& value = values_[i];
      if (value.definition.kind != Definition::Kind::kOwn &&
          !rounding_.admits(ValueId(i), value.definition)) {
        if (value.uses > 0) release_operands(i);
        value.alternatives.clear();
        value.has_lines = value.has_pairs = true;
        define(i, {});
        if (value.uses > 0) acquire_operands(i);
      }
      rounding_.follow(ValueId(i), value.definition);
    }
  }

  /// Takes the definition of `i` that saves most, the first among equals. Was any better than the present one?
  bool improve(std::size_t i) {
    Definition best = values_[i].definition;
    const bool was_fixed = values_[i].fixed;
    const int own = cost(i), freed = release_operands(i);
    int most = 0;
    find_alternatives(i, freed > 0);
    for (Alternative& alternative : values_[i].alternatives) {
      if (alternative.admitted == false) continue;
      define(i, alternative.definition);
      const int saved = own + freed - cost(i) - acquire_operands(i);
      release_operands(i);
      if (saved <= most || (was_fixed && !values_[i].fixed) || !is_admitted(i, alternative)) continue;
      most = saved;
      best = alternative.definition;
    }
    define(i, best);
    acquire_operands(i);
    return most > 0;
  }

  /// Pairs save something only where operations are released.
  void find_alternatives(std::size_t i, bool with_pairs) {
    Value& value = values_[i];
    const auto append = [&](const std::vector<Definition>& list) {
      for (const Definition& definition : list) value.alternatives.push_back({definition});
    };
    if (!value.has_lines) append(equal_.lines(ValueId(i)));
    if (with_pairs && !value.has_pairs) append(equal_.pairs(ValueId(i)));
    value.has_lines = true;
    value.has_pairs = value.has_pairs || with_pairs;
  }

  bool is_admitted(std::size_t i, Alternative& alternative) {
    if (alternative.admitted) return *alternative.admitted;
    const std::optional<Definition> complete = equal_.with_numbers(ValueId(i), alternative.definition);
    if (complete) alternative.definition = *complete;
    alternative.admitted = complete && rounding_.admits(ValueId(i), *complete);
    return *alternative.admitted;
  }

  Program rewritten() const {
    std::vector<bool> unused;
    for (const Value& value : values_) unused.push_back(value.uses == 0);
    Copy copy(program_);
    const auto replaced = [&](ValueId id) -> std::optional<Signed> {
      const Definition& definition = values_[id.value].definition;
      if (definition.kind == Definition::Kind::kOwn) return {};
      return built(definition, copy);
    };
    return remove_dead_code(copy.run(replaced, unused));
  }

  static Signed built(const Definition& definition, Copy& copy) {
    ir::Builder& builder = copy.builder();
    const auto copied = [&](Signed value) { return value.negative ? -copy[value.value] : copy[value.value]; };
    switch (definition.kind) {
      case Definition::Kind::kSum: {
        const Signed y = copied(definition.y);
        return builder.add(copied(definition.x), y);
      }
      case Definition::Kind::kProduct: {
        const Signed y = copied(definition.y);
        return builder.multiply(copied(definition.x), y);
      }
      case Definition::Kind::kOwn:
      case Definition::Kind::kLine:
      case Definition::Kind::kNumber:
        break;
    }
    if (definition.kind == Definition::Kind::kNumber) return builder.literal(definition.offset);
    Signed line = copied(definition.x);
    if (definition.is_scaled) line = builder.multiply(builder.literal(definition.factor), line);
    return definition.is_shifted ? builder.add(line, builder.literal(definition.offset)) : line;
  }

  const Program& program_;
  EqualValues equal_;
  SampledRounding rounding_;
  std::vector<Value> values_;
};

}  // namespace

Program resubstitute(const Program& program) {
  Program best = remove_dead_code(program);
  for (;;) {
    std::optional<std::vector<Fingerprint>> found = fingerprints(best);
    if (!found) return best;
    std::optional<Program> next = Substitution(best, std::move(*found)).run();
    if (!next) return best;
    best = std::move(*next);
  }
}

}  // namespace jourdain::passes
