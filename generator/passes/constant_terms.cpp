#include "passes/constant_terms.hpp"

#include <optional>

#include "ir/fixed_values.hpp"
#include "passes/rewrite.hpp"

namespace jourdain::passes {

using ir::Node;
using ir::Op;
using ir::Program;
using ir::Signed;
using ir::ValueId;

namespace {

class Terms {
 public:
  explicit Terms(const Program& program)
      : program_(program),
        uses_(ir::use_counts(program)),
        constant_(ir::fixed_values(program)),
        copy_(program) {}

  Program run() {
    return remove_dead_code(copy_.run([this](ValueId id) -> std::optional<Signed> {
      if (!is_sum(id) || constant_[id.value]) return {};
      Sum sum;
      collect(id, false, sum);
      if (sum.constants < 2) return {};
      return total(sum);
    }));
  }

 private:
  struct Sum {
    std::optional<Signed> literal, constant, rest;
    int constants = 0;
  };

  bool is_sum(ValueId id) const { return program_[id].op == Op::kAdd || program_[id].op == Op::kSubtract; }

  void collect(ValueId id, bool negative, Sum& sum) {
    const Node& node = program_[id];
    for (const bool second : {false, true}) {
      const ValueId term = second ? node.b : node.a;
      const bool sign = negative != (second && node.op == Op::kSubtract);
      if (is_sum(term) && !constant_[term.value] && uses_[term.value] == 1)
        collect(term, sign, sum);
      else
        add(sum, term, sign);
    }
  }

  void add(Sum& sum, ValueId term, bool negative) {
    sum.constants += constant_[term.value];
    const Signed value = negative ? -copy_[term] : copy_[term];
    add_to(!constant_[term.value]              ? sum.rest
           : program_[term].op == Op::kLiteral ? sum.literal
                                               : sum.constant,
           value);
  }

  void add_to(std::optional<Signed>& side, Signed value) {
    side = side ? copy_.builder().add(*side, value) : value;
  }

  /// There are constant terms.
  Signed total(Sum& sum) {
    if (sum.literal) add_to(sum.constant, *sum.literal);
    if (!sum.rest) return *sum.constant;
    add_to(sum.rest, *sum.constant);
    return *sum.rest;
  }

  const Program& program_;
  std::vector<std::size_t> uses_;
  std::vector<bool> constant_;
  Copy copy_;
};

}  // namespace

Program group_constant_terms(const Program& program) { return Terms(program).run(); }

}  // namespace jourdain::passes
