#include "emit/c/c_tables.hpp"

#include <fmt/format.h>

#include <vector>

#include "emit/constant_tables.hpp"
#include "support/constant_array.hpp"

namespace jourdain::emit::c {

std::string table_text(std::uint32_t array, const CNames& names) {
  std::vector<std::string> numbers;
  for (const double value : support::array_of(array)) numbers.push_back(names.digits(value));
  return fmt::format(
      "\nstatic {0} {1}({0} i) {{\n"
      "  static const {0} values[] = {{{2}}};\n\n"
      "  return values[i > 0.0{3} ? (i < {4}.0{3} ? (int)i : {4}) : 0];\n"
      "}}\n",
      names.real(), names.internal(table_function(array)), listed(numbers), names.suffix(),
      numbers.size() - 1);
}

}  // namespace jourdain::emit::c
