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

  void plant(const std::string& model, const std::vector<std::string>& functions = {}) {
    const CompiledText text = compiled_text(model, functions);
    ASSERT_EQ(text.differences(text.compiled.files), std::vector<std::string>());
    for (std::size_t file = 0; file < text.compiled.files.size(); ++file) {
      const std::size_t count = file == 1 ? per_operator() : std::max<std::size_t>(per_operator() / 3, 1);
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
    if (is_refused(text, file, mutant))
      ++counts.refused;
    else if (changes_only_space_or_comments(whole, mutant.applied_to(whole)))
      ++counts.same_tokens;
    else if (kMayMeanTheSame.count(mutant.operation))
      ++counts.same_results;
    else if (has_same_value(was, mutant.replacement) || names_a_parameter(text, file, mutant) ||
             negates_zero(whole, mutant) || has_no_effect(whole, mutant))
      ++counts.same_value;
    else if (file == 1 && !is_refused(text, file, poisoned))
      ++counts.never_executed;
    else
      ADD_FAILURE() << text.compiled.files[file].name << ": " << mutant.describe(whole) << "\n"
                    << line_of(whole, mutant);
  }

  /// Decimal texts of one double.
  static bool has_same_value(const std::string& was, const std::string& became) {
    return was.find('.') != std::string::npos &&
           std::strtod(was.c_str(), nullptr) == std::strtod(became.c_str(), nullptr);
  }

  /// Of an instantiation: there a name means nothing.
  static bool names_a_parameter(const CompiledText&, std::size_t file, const TextMutant& mutant) {
    return file == 2 && mutant.operation == "replace_name";
  }

  static bool negates_zero(const std::string& whole, const TextMutant& mutant) {
    return mutant.operation == "insert_minus" && (whole.compare(mutant.at, 9, "Real(0.0)") == 0 ||
                                                  whole.compare(mutant.at, 16, "least_regularity") == 0);
  }

  /// The displacement of the first stage, which nothing reads without quaternions; loops to where nothing is
  /// coupled, with one velocity all of them; arrays inside steps that are longer than needed.
  static bool has_no_effect(const std::string& whole, const TextMutant& mutant) {
    const std::string line = line_of(whole, mutant);
    const bool is_loop = line.find("first_coupled[k + 1]") != std::string::npos;
    return line == "    stage.y[i] = Real(0.0);" ||
           (line.starts_with("  for (int k = ") && line.ends_with(" - 1; k >= 0; --k)")) ||
           (is_loop && whole.find("first_coupled[] = {0, 0};") != std::string::npos) ||
           (line.starts_with("  Real y[") && line.ends_with("];") &&
            mutant.operation.starts_with("change_in"));
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
  suite.plant("panda");
  suite.plant("crane", {"initial_state", "outputs", "rodas4_step", "rk5_step", "adams_bashforth3_step"});
  suite.plant("flyball_governor", {"rodas4_step", "rk5_step", "adams_bashforth3_step"});
  suite.plant("four_bar", every_function());
  suite.plant("n_four_bar");
  suite.plant("quadrotor", every_function());
  suite.plant("spring_four_bar", {"initial_state", "linearize", "ros34pw2_step"});
}

}  // namespace
}  // namespace jourdain::tests
