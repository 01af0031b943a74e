#include "emit/cpp/user_functions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "emit/called_functions.hpp"

namespace jourdain::emit::cpp {

std::string user_functions(const std::string& model, const std::vector<support::CalledFunction>& called) {
  if (called.empty()) return "";
  std::string text = fmt::format(
      "/// What the model calls and you define, with these members, in {}_functions.hpp, which {}.cpp "
      "includes, or\n"
      "/// anywhere before functions of the model are called:\n"
      "///   template <class Real>\n"
      "///   struct {}::Functions {{\n",
      model, model, model);
  for (const support::CalledFunction& function : called) {
    std::vector<std::string> arguments;
    for (const std::string& argument : function.arguments) arguments.push_back("const Real& " + argument);
    const std::string remark = remark_of(function);
    text += fmt::format("///     Real {}({}) const noexcept;{}\n", function.member(),
                        fmt::join(arguments, ", "), remark.empty() ? "" : "  // " + remark);
  }
  return text +
         "///   };\n"
         "/// It may have data: Model::functions is one, made without arguments. In SI units.\n"
         "template <class Real = double>\n"
         "struct Functions;\n\n";
}

}  // namespace jourdain::emit::cpp
