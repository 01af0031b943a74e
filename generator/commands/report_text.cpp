#include "commands/report_text.hpp"

#include <fmt/format.h>

#include "passes/lanes.hpp"

namespace jourdain::commands {

namespace {

std::string operations_row(const std::string& name, const ir::Operations& c) {
  return fmt::format("  {:<18} {:>6} {:>6} {:>6} {:>6} {:>5} {:>5} | {:>5} {:>5} {:>5}{}{}{}\n", name,
                     c.arithmetic(), c.multiply, c.add, c.subtract, c.divide, c.sqrt, c.negate, c.sin, c.cos,
                     c.atan2 == 0 ? "" : fmt::format("  and {} atan2", c.atan2),
                     c.functions == 0 ? "" : fmt::format("  and {} exp, log, …", c.functions),
                     c.selections == 0 ? "" : fmt::format("  and {} selections", c.selections));
}

}  // namespace

std::string operations_table(const ir::Module& module) {
  std::string text =
      fmt::format("  {:<18} {:>6} {:>6} {:>6} {:>6} {:>5} {:>5} | {:>5} {:>5} {:>5}\n", "operations", "all",
                  "mul", "add", "sub", "div", "sqrt", "neg", "sin", "cos");
  text += operations_row("Model (once)", ir::count_operations(module.constants));
  for (const ir::Program& program : module.functions)
    text += operations_row(program.name, ir::count_operations(program));
  return text;
}

std::string verdict_text(const validate::Verdict& v) {
  return fmt::format(
      "  validated at {} states: algebra agrees to {}; in double backward error {:.1e}, others {:.1e} of "
      "their scale; cond(M) up to {}\n{}",
      v.states, validate::algebra_text(v), v.backward_error, v.entry_error, validate::condition_text(v),
      v.kinks.count == 0 ? "" : "  " + validate::in_words(v.kinks) + "\n");
}

std::string oracles_text(const validate::Verdict& verdict) {
  std::string text =
      "  compared with (worst difference in 77 digits over scale; error in double over scale)\n";
  for (const validate::Compared& c : verdict.compared)
    text += fmt::format("    {:<32} {:>3} states {:>6} numbers  {:>7}  {:>7}  {}\n", c.function, c.states,
                        c.numbers, fmt::format("{:.0e}", c.algebra),
                        c.oracle == validate::kReference ? "" : fmt::format("{:.1e}", c.rounding), c.oracle);
  return text;
}

std::string readback_text(const readback::Record& record) {
  std::string text =
      fmt::format("  read back from the files: {} functions, the same as validated in all {} nodes",
                  record.functions, record.nodes);
  if (record.steps > 0)
    text += fmt::format("; {} step{} as defined, at {} random point{} in 70 digits", record.steps,
                        record.steps == 1 ? "" : "s", record.points, record.points == 1 ? "" : "s");
  return text + "\n";
}

std::string passes_text(const std::vector<passes::PassRecord>& passes) {
  const auto effect = [](passes::Effect e) {
    switch (e) {
      case passes::Effect::kExact:
        return "exact";
      case passes::Effect::kReassociating:
        return "reassociating";
      case passes::Effect::kAssuming:
        return "assuming";
    }
    return "";
  };
  std::string text = "  passes (operations of all functions together)\n";
  for (const passes::PassRecord& pass : passes)
    if (pass.round == 1 || pass.operations_before != pass.operations_after)
      text += fmt::format("    {:<18} {:<14} {:>7} -> {}\n", pass.name, effect(pass.effect),
                          pass.operations_before, pass.operations_after);
  return text;
}

std::string lanes_text(const ir::Module& module) {
  std::string text;
  for (const ir::Program& program : module.functions)
    if (!program.lanes.empty())
      text += fmt::format("    {:<26} {:>6} of {}\n", program.name, passes::saved_by_lanes(program),
                          ir::count_operations(program).arithmetic());
  return text.empty() ? "" : "  lanes (operations that go with those of limbs that are alike)\n" + text;
}

std::string programs_text(const passes::PassRecord& pass, const ir::Module& module) {
  std::string text = pass.seconds == 0 ? fmt::format("# {}\n", pass.name)
                                       : fmt::format("# {}, round {}: {} -> {} operations, {:.3g} ms\n",
                                                     pass.name, pass.round, pass.operations_before,
                                                     pass.operations_after, 1e3 * pass.seconds);
  const auto add = [&text](const ir::Program& program) {
    text += fmt::format("# {} operations\n{}", ir::count_operations(program).arithmetic(), print(program));
  };
  if (!module.constants.outputs.empty()) add(module.constants);
  for (const ir::Program& program : module.functions) add(program);
  return text + "\n";
}

std::string omissions_text(const std::vector<Omission>& omissions) {
  std::string text = "  left out (operations of forward_dynamics saved)\n";
  for (const Omission& omission : omissions)
    text += fmt::format("    {:<26} {:>6}  {}\n", omission.name,
                        omission.saved == 0 ? "" : fmt::format("{}", omission.saved), omission.what);
  return text;
}

}  // namespace jourdain::commands
