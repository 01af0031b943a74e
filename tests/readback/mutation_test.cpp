// Faults planted in finished files: each is refused, or the files mean the same.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <set>

#include "readback/compiled_text.hpp"
#include "readback/text_mutations.hpp"

namespace jourdain::tests {
namespace {

struct Tally {
  int refused = 0, same_tokens = 0, same_results = 0, never_executed = 0, same_value = 0;
};

/// Operators whose mutants may compute the same: qualifiers, redundant parentheses, statements that do not
/// depend on each other or are idempotent, digits beyond a double's.
const std::set<std::string> kMayMeanTheSame = {"drop_word",       "insert_parentheses",  "swap_statements",
                                               "swap_names",      "duplicate_statement", "drop_parentheses",
                                               "drop_punctuation"};

/// Sites drawn per operator and file of functions; MUTANTS in the environment takes more.
std::size_t per_operator() {
  const char* asked = std::getenv("MUTANTS");
  return asked ? std::stoul(asked) : 2;
}

/// What is refused wherever it is executed, in place of what a mutant changed.
std::string poison(const std::string& was, const std::string& became) {
  if (was.empty() && became == "-") return "!";
  if (became.empty() && was.ends_with(';')) return "nullptr;";
  if (was == "++" || was == "--") return "!";
  if (was == "+" || was == "-" || was == "*" || was == "/") return "<";
  if (was == "<" || was == "<=" || was == ">=" || was == "==") return "+";
  return "nullptr";
}

class Suite {
 public:
  ~Suite() {
    fmt::print("{:<26}{:>9}{:>13}{:>14}{:>16}{:>12}\n", "operator", "refused", "same tokens", "same results",
               "never executed", "same value");
    for (const auto& [name, t] : tally_)
      fmt::print("{:<26}{:>9}{:>13}{:>14}{:>16}{:>12}\n", name, t.refused, t.same_tokens, t.same_results,
                 t.never_executed, t.same_value);
  }

  void plant(const std::string& model, const std::vector<std::string>& functions = {},
             const ir::TextChoices& choices = {}) {
    const CompiledText text = compiled_text(model, functions, choices);
    ASSERT_EQ(text.differences(text.compiled.files), std::vector<std::string>());
    for (std::size_t file = 0; file < text.compiled.files.size(); ++file) {
      const std::size_t count =
          holds_functions(text, file) ? per_operator() : std::max<std::size_t>(per_operator() / 3, 1);
      for (const TextMutant& mutant : text_mutants(text.compiled.files[file].text, seed_ += 1000, count))
        judge(text, file, mutant);
    }
  }

 private:
  bool is_refused(const CompiledText& text, std::size_t file, const TextMutant& mutant) const {
    std::vector<emit::File> files = text.compiled.files;
    files[file].text = mutant.applied_to(files[file].text);
    return !text.differences(files).empty();
  }

  void judge(const CompiledText& text, std::size_t file, const TextMutant& mutant) {
    const std::string& whole = text.compiled.files[file].text;
    Tally& counts = tally_[mutant.operation];
    const std::string was = whole.substr(mutant.at, mutant.length);
    TextMutant poisoned = mutant;
    poisoned.replacement = poison(was, mutant.replacement);
    // C has no nullptr; a number where a name stood is refused where it is executed.
    if (text.compiled.files[file].name.ends_with(".c") && poisoned.replacement.starts_with("nullptr"))
      poisoned.replacement.replace(0, 7, whole.compare(mutant.at - 2, 2, "->") == 0 ? "nothing" : "0");
    if (is_refused(text, file, mutant))
      ++counts.refused;
    else if (changes_only_space_or_comments(whole, mutant.applied_to(whole)))
      ++counts.same_tokens;
    else if (kMayMeanTheSame.count(mutant.operation))
      ++counts.same_results;
    else if (has_same_value(was, mutant.replacement) || names_a_parameter(text, file, mutant) ||
             negates_zero(whole, mutant) || has_no_effect(text, whole, mutant))
      ++counts.same_value;
    else if (holds_functions(text, file) && !is_refused(text, file, poisoned))
      ++counts.never_executed;
    else
      ADD_FAILURE() << text.compiled.files[file].name << ": " << mutant.describe(whole) << "\n"
                    << line_of(whole, mutant);
  }

  static bool holds_functions(const CompiledText& text, std::size_t file) {
    const std::string& name = text.compiled.files[file].name;
    return name.ends_with(".c") || name.ends_with("_kernels.hpp");
  }

  /// Decimal texts of one double, or of one float.
  static bool has_same_value(const std::string& was, const std::string& became) {
    if (was.find('.') == std::string::npos) return false;
    if (was.ends_with('f') && became.ends_with('f'))
      return std::strtof(was.c_str(), nullptr) == std::strtof(became.c_str(), nullptr);
    return std::strtod(was.c_str(), nullptr) == std::strtod(became.c_str(), nullptr);
  }

  /// Of an instantiation: there a name means nothing.
  static bool names_a_parameter(const CompiledText& text, std::size_t file, const TextMutant& mutant) {
    return text.compiled.files[file].name.ends_with(".cpp") && mutant.operation == "replace_name";
  }

  static bool negates_zero(const std::string& whole, const TextMutant& mutant) {
    return mutant.operation == "insert_minus" &&
           (whole.compare(mutant.at, 9, "Real(0.0)") == 0 ||
            whole.compare(mutant.at, 25, "detail::number<Real>(0.0)") == 0 ||
            whole.compare(mutant.at, 16, "least_regularity") == 0);
  }

  /// The displacement of the first stage, which nothing reads without quaternions; loops to where nothing is
  /// coupled, with one velocity all of them; arrays inside steps that are longer than needed.
  static bool has_no_effect(const CompiledText& text, const std::string& whole, const TextMutant& mutant) {
    const std::string line = line_of(whole, mutant);
    if (line.starts_with("  (void)") || commutes(mutant)) return true;
    // Held inputs do not change over a step.
    if (line.find("solve_stage(model, &step, &stage, input, ") != std::string::npos &&
        !text.expected().dynamics_depend_on_time)
      return true;
    // Where all that moves are rotations, rates of local displacements are set once more.
    if (line.ends_with("rate[i] = z[i];") && text.expected().scalars.empty()) return true;
    const bool is_loop = line.find("first_coupled[k + 1]") != std::string::npos ||
                         line.find("first_coupled(k + 1)") != std::string::npos;
    const bool ends_descent = line.ends_with(" - 1; k >= 0; --k)") || line.ends_with(" - 1; k >= 0; --k) {");
    const bool is_array =
        line.starts_with("  Real y[") || line.starts_with("  double y[") || line.starts_with("  float y[");
    const bool is_uncoupled =
        whole.find("first_coupled(int k) noexcept {\n  static constexpr int list[] = {0, 0};") !=
            std::string::npos ||
        whole.find("first_coupled[2] = {0, 0};") != std::string::npos;
    // Mass matrices of the governor and the crane are diagonal.
    const bool is_mass = line.find("= step.W[k][i] + ") != std::string::npos ||
                         line.find("= step->W[i][k] + ") != std::string::npos;
    const bool is_diagonal =
        whole.find("flyball_governor") != std::string::npos || whole.find("crane") != std::string::npos;
    if (is_mass && is_diagonal && mutant.operation == "insert_minus") return true;
    // The first of the two: a loop from there is as empty.
    if (is_uncoupled && whole.compare(mutant.at, 6, "0, 0};") == 0) return true;
    return line == "    stage.y[i] = Real(0.0);" || line == "    stage.y[i] = 0.0;" ||
           line == "    stage.y[i] = 0.0f;" || (line.starts_with("  for (") && ends_descent) ||
           (is_loop && is_uncoupled) ||
           (is_array && line.ends_with("];") && mutant.operation.starts_with("change_in"));
  }

  /// Operands of a sum or product: in steps, which are compared by their numbers.
  static bool commutes(const TextMutant& mutant) {
    return mutant.operation == "swap_operands" && mutant.replacement.find_first_of("+*") != std::string::npos;
  }

  static std::string line_of(const std::string& whole, const TextMutant& mutant) {
    const std::size_t begin = whole.rfind('\n', mutant.at) + 1;
    return whole.substr(begin, whole.find('\n', mutant.at) - begin);
  }

  std::map<std::string, Tally> tally_;
  std::uint64_t seed_ = 14;
};

TEST(TextMutation, IsRefusedOrMeansTheSame) {
  Suite suite;
  suite.plant("pendulum", every_function());
  suite.plant("crane", {"initial_state", "outputs", "rodas4_step", "rk5_step", "adams_bashforth3_step"});
  suite.plant("flyball_governor", {"rodas4_step", "rk5_step", "adams_bashforth3_step"});
  suite.plant("spring_four_bar", {"initial_state", "linearize", "ros34pw2_step"});
  suite.plant("crane", {"initial_state", "rk4_step"}, {ir::Language::kCpp, true, true, true});
  suite.plant("quadruped", {"mass_matrix"});
}

TEST(TextMutation, OfLongTextsIsRefusedOrMeansTheSame) {
  Suite suite;
  suite.plant("panda");
  suite.plant("four_bar", every_function());
  suite.plant("n_four_bar");
  suite.plant("quadrotor", every_function());
}

TEST(TextMutation, OfCIsRefusedOrMeansTheSame) {
  Suite suite;
  const ir::TextChoices in_c = {ir::Language::kC}, in_double = {ir::Language::kC, true, false},
                        in_float = {ir::Language::kC, false, true};
  suite.plant("pendulum", every_function(), in_c);
  suite.plant("crane", {"initial_state", "outputs", "rodas4_step", "rk5_step", "adams_bashforth3_step"},
              in_float);
  suite.plant("four_bar", every_function(), in_double);
  suite.plant("quadrotor", every_function(), in_double);
  suite.plant("spring_four_bar", {"initial_state", "linearize", "ros34pw2_step"}, in_float);
}

}  // namespace
}  // namespace jourdain::tests
