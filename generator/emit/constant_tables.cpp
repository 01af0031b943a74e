#include "emit/constant_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "support/constant_array.hpp"

namespace jourdain::emit {

std::set<std::uint32_t> arrays_in(const ir::Module& module) {
  std::set<std::uint32_t> found;
  const auto gather = [&found](const ir::Program& program) {
    for (const ir::Node& node : program.nodes)
      if (node.op == ir::Op::kEntry) found.insert(static_cast<std::uint32_t>(program[node.b].literal));
  };
  gather(module.constants);
  for (const ir::Program& program : module.functions) gather(program);
  return found;
}

std::string table_function(double number) {
  return fmt::format("table_{:06x}", static_cast<std::uint32_t>(number));
}

bool is_table_function(std::string_view name) {
  return name.size() == table_function(0).size() && name.starts_with("table_") &&
         name.find_first_not_of("0123456789abcdef", 6) == std::string_view::npos;
}

bool overflows_float(std::uint32_t array) {
  const std::vector<double>& values = support::array_of(array);
  return std::any_of(values.begin(), values.end(),
                     [](double value) { return std::isinf(static_cast<float>(value)); });
}

std::string listed(const std::vector<std::string>& numbers) {
  constexpr std::size_t kColumns = 110;
  std::string text, line;
  for (const std::string& number : numbers) {
    if (line.size() + number.size() > kColumns) text += "\n      " + line + ",", line.clear();
    line += (line.empty() ? "" : ", ") + number;
  }
  return text + "\n      " + line;
}

}  // namespace jourdain::emit
