#include "emit/c/c_variables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "emit/unique_names.hpp"
#include "emit/what_depends.hpp"

namespace jourdain::emit::c {

namespace {

/// C99 promises that compilers take strings of 4095 characters.
constexpr std::size_t kLongestString = 4000;

/// "JOURDAIN_" and the word in capitals.
std::string constant(const std::string& prefix, std::string_view word) {
  std::string text = prefix;
  for (const char c : word) text += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// Entries of all variables in one array; each variable points at its first.
class Pool {
 public:
  Pool(std::string type, std::string name) : type_(std::move(type)), name_(std::move(name)) {}

  std::string add(const std::vector<std::string>& entries) {
    if (entries.empty()) return "NULL";
    const std::size_t first = count_;
    for (const std::string& entry : entries) text_ += "  " + entry + ",\n";
    count_ += entries.size();
    return fmt::format("{} + {}", name_, first);
  }

  std::string text() const {
    return count_ == 0 ? "" : fmt::format("static const {}{}[] = {{\n{}}};\n\n", type_, name_, text_);
  }

 private:
  std::string type_, name_, text_;
  std::size_t count_ = 0;
};

std::vector<std::string> strings(const std::vector<std::string>& entries) {
  std::vector<std::string> list;
  for (const std::string& entry : entries) {
    if (entry.size() > kLongestString) return {};
    list.push_back(c_string(entry));
  }
  return list;
}

}  // namespace

std::string c_string(const std::string& text) {
  std::string safe;
  for (const char c : quoted_text(text)) {
    if (c == '?' && safe.ends_with('?')) safe += '\\';  // no trigraph
    safe += c;
  }
  return "\"" + safe + "\"";
}

std::string in_one_line(std::string comment) {
  std::replace(comment.begin(), comment.end(), '\n', ' ');
  return comment;
}

std::string variable_tables(const ModelText& model, const ir::Module& module) {
  const CNames of_double{model.name, false};
  Pool numbers("char *const ", "number_names"), starts("double ", "starts"), reads("char *const ", "read_by");
  std::string rows;
  for (const programs::Variable& variable : model.variables) {
    std::vector<std::string> start;
    for (const double value : variable.start) start.push_back(of_double.literal(value));
    const std::array<double, 2> range = variable.range.value_or(std::array<double, 2>{0, 0});
    rows += fmt::format("  {{{}, {}, {},\n   {}, {}, {}, {}, {},\n   {}, {}, {}, {}, {}, {}, {}}},\n",
                        c_string(variable.name), c_string(variable.description), c_string(variable.unit),
                        constant("JOURDAIN_", role_name(variable.role)),
                        constant("JOURDAIN_QUANTITY_", quantity_name(variable.quantity)), variable.index,
                        variable.rows, variable.columns, numbers.add(strings(variable.numbers)),
                        starts.add(start), variable.range ? 1 : 0, of_double.literal(range[0]),
                        of_double.literal(range[1]),
                        variable.derivative_of ? static_cast<long>(*variable.derivative_of) : -1,
                        reads.add(strings(what_depends(variable, model.facts, module))));
  }
  return numbers.text() + starts.text() + reads.text() +
         (rows.empty() ? "" : "static const jourdain_variable variables[] = {\n" + rows + "};\n\n");
}

}  // namespace jourdain::emit::c
