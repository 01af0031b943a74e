#include "emit/called_functions.hpp"

#include <fmt/format.h>

#include <map>

#include "support/elementary_functions.hpp"

namespace jourdain::emit {

std::vector<support::CalledFunction> called_in(const ir::Module& module) {
  std::map<std::string, support::CalledFunction> found;
  const auto gather = [&found](const ir::Program& program) {
    for (const ir::Node& node : program.nodes)
      if (node.op == ir::Op::kCall) {
        const support::CalledFunction& called = support::called_by(program[node.b].literal);
        found.emplace(called.member(), called);
      }
  };
  gather(module.constants);
  for (const ir::Program& program : module.functions) gather(program);
  std::vector<support::CalledFunction> list;
  for (auto& [name, called] : found) list.push_back(std::move(called));
  return list;
}

std::string remark_of(const support::CalledFunction& function) {
  if (function.by.empty()) return "";
  std::string by;
  for (const std::size_t argument : function.by)
    by += (by.empty() ? "" : " and ") + function.arguments[argument];
  return fmt::format("partial derivative of {} by {}", function.name, by);
}

std::vector<std::size_t> uses_in_text(const ir::Program& program) {
  std::vector<std::size_t> uses = ir::use_counts(program);
  for (std::size_t i = program.nodes.size(); i-- > 0;) {
    const ir::Node& node = program.nodes[i];
    if (node.op != ir::Op::kArgument || uses[i] < 2) continue;
    uses[node.a.value] += uses[i] - 1;
    uses[node.b.value] += uses[i] - 1;
  }
  return uses;
}

}  // namespace jourdain::emit
