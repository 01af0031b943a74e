#include "programs/output_names.hpp"

#include <fmt/format.h>

namespace jourdain::programs {

std::string subscripts(const OutputMember& member, int a, int b) {
  return (member.rows > 1 ? fmt::format("[{}]", a) : "") + (member.is_matrix ? fmt::format("[{}]", b) : "");
}

std::vector<std::string> number_names(const OutputFacts& output, const OutputMember& member) {
  const std::string prefix = output.name + (member.name.empty() ? "" : "." + member.name);
  std::vector<std::string> names;
  for (int row = 0; row < member.rows; ++row)
    for (int column = 0; column < member.columns; ++column)
      names.push_back(prefix + subscripts(member, row, column));
  return names;
}

}  // namespace jourdain::programs
