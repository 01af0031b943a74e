#include "emit/cpp/cpp_tables.hpp"

#include <fmt/format.h>

#include <vector>

#include "emit/constant_tables.hpp"
#include "emit/cpp/printer.hpp"
#include "support/constant_array.hpp"

namespace jourdain::emit::cpp {

std::string table_text(std::uint32_t array) {
  std::vector<std::string> numbers;
  for (const double value : support::array_of(array))
    numbers.push_back(fmt::format("Value({})", digits_text(value)));
  return fmt::format(
      "template <class Real> JOURDAIN_FUNCTION\n"
      "Real {}(const Real& i) noexcept {{\n"
      "  using Value = {};\n"
      "  static constexpr Value values[] = {{{}}};\n"
      "  return hooks::entry(values, i, hooks::ByOwnEntry<Real>());\n"
      "}}\n",
      table_function(array), overflows_float(array) ? "double" : "typename hooks::TableOf<Real>::Type",
      listed(numbers));
}

}  // namespace jourdain::emit::cpp
