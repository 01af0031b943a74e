#include "passes/pipeline.hpp"

#include <algorithm>
#include <chrono>

#include "passes/angles.hpp"
#include "passes/constants.hpp"
#include "passes/factor.hpp"
#include "passes/hoist.hpp"
#include "passes/resubstitute.hpp"
#include "passes/rewrite.hpp"
#include "passes/term_order.hpp"

namespace jourdain::passes {

using ir::Module;
using ir::Program;

namespace {

std::function<Module(const Module&)> each_function(Program (*pass)(const Program&)) {
  return [pass](const Module& module) {
    Module result;
    result.constants = module.constants;
    for (const Program& function : module.functions) result.functions.push_back(pass(function));
    return result;
  };
}

}  // namespace

/// The pipeline: a new pass is one line here.
const std::vector<Pass>& pipeline() {
  static const std::vector<Pass> passes = {
      {"split_angles", Effect::kReassociating, each_function(split_angles)},
      {"factor", Effect::kReassociating, each_function(factor)},
      {"group_constants", Effect::kReassociating, each_function(group_constants)},
      {"remove_dead_code", Effect::kExact, each_function(remove_dead_code)},
      {"resubstitute", Effect::kReassociating, each_function(resubstitute), true},
      {"hoist", Effect::kExact, hoist},
      {"order_terms", Effect::kReassociating, each_function(order_terms), false, true},
  };
  return passes;
}

std::vector<std::string> pass_names() {
  std::vector<std::string> names;
  for (const Pass& pass : pipeline()) names.emplace_back(pass.name);
  return names;
}

std::vector<std::string> uncompared_pass_names() {
  std::vector<std::string> names;
  for (const Pass& pass : pipeline())
    if (pass.is_dear || pass.is_last) names.emplace_back(pass.name);
  return names;
}

std::size_t arithmetic(const Module& module) {
  std::size_t total = ir::count_operations(module.constants).arithmetic();
  for (const Program& function : module.functions) total += ir::count_operations(function).arithmetic();
  return total;
}

namespace {

constexpr int kMostRounds = 20;  // all models and random programs need at most 4

bool same_operations(const Module& a, const Module& b) {
  return passes::same_operations(a.constants, b.constants) &&
         std::equal(a.functions.begin(), a.functions.end(), b.functions.begin(), b.functions.end(),
                    [](const Program& x, const Program& y) { return passes::same_operations(x, y); });
}

/// Runs one pass and says what it did.
PassRecord run(const Pass& pass, Module& module) {
  using Clock = std::chrono::steady_clock;
  PassRecord record{pass.name, pass.effect, arithmetic(module), 0, 0, 1};
  const Clock::time_point start = Clock::now();
  module = pass.run(module);
  record.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  record.operations_after = arithmetic(module);
  return record;
}

}  // namespace

Module optimise_once(Module module) {
  for (const Pass& pass : pipeline())
    if (!pass.is_dear && !pass.is_last) module = pass.run(module);
  return module;
}

Optimised optimise(Module module, const std::vector<std::string>& switched_off, const Watch& watch) {
  Optimised result;
  const auto is_on = [&](const Pass& pass) {
    return std::find(switched_off.begin(), switched_off.end(), pass.name) == switched_off.end();
  };
  int round = 0;
  const auto apply = [&](const Pass& pass, Module& to) {
    result.records.push_back(run(pass, to));
    result.records.back().round = round;
    if (watch) watch(result.records.back(), to);
  };
  while (++round <= kMostRounds) {
    const Module before = module;
    for (const Pass& pass : pipeline())
      if (is_on(pass) && !pass.is_last && (!pass.is_dear || arithmetic(module) == arithmetic(before)))
        apply(pass, module);
    if (same_operations(module, before)) break;
  }
  for (const Pass& pass : pipeline())
    if (is_on(pass) && pass.is_last) apply(pass, module);
  result.module = std::move(module);
  return result;
}

std::size_t remaining_operations(const Program& program) {
  Module module;
  module.functions = {program};
  return ir::count_operations(optimise_once(std::move(module)).functions[0]).arithmetic();
}

std::size_t emitted_operations(const Program& program) {
  Module module;
  module.functions = {program};
  return ir::count_operations(optimise(std::move(module)).module.functions[0]).arithmetic();
}

}  // namespace jourdain::passes
