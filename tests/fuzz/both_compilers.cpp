#include "fuzz/both_compilers.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "support/files.hpp"
#include "support/process.hpp"

namespace jourdain::tests {

namespace {

namespace fs = std::filesystem;

/// Prints all numbers of the state, exactly; one that is none as "nan", whatever its sign.
constexpr const char* kProgram = R"(#include "{0}.hpp"
#include <cmath>
#include <cstdio>
#include <cstring>
int main() {{
  const {0}::Model<> model;
  auto state = {0}::initial_state(model);
  for (int i = 0; i < 100; ++i) {0}::rk4_step(model, state, {{}}, 1e-3);
  double numbers[sizeof state / sizeof(double)];
  std::memcpy(numbers, static_cast<const void*>(&state), sizeof numbers);
  for (const double number : numbers) std::isnan(number) ? std::puts("nan") : std::printf("%a\n", number);
}}
)";

std::string emitted_name(const fs::path& sources) {
  for (const auto& entry : fs::directory_iterator(sources))
    if (entry.path().extension() == ".json") return entry.path().stem().string();
  return "";
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// What the program prints, or after '!' what went wrong.
std::string output_of(const std::string& compiler, const fs::path& sources, const std::string& name) {
  const std::string program = (sources / compiler).string();
  const support::ProcessResult compiled =
      support::run_process({compiler, "-std=c++17", "-O0", "-ffp-contract=off", "-Wall", "-Wextra", "-Werror",
                            "-Wno-unused-result", (sources / "steps.cc").string(),
                            (sources / (name + ".cpp")).string(), "-o", program});
  if (compiled.status != 0)
    return "!" + compiler + ": " +
           first_line(compiled.output.substr(
               compiled.output.find("error") == std::string::npos ? 0 : compiled.output.find("error")));
  const support::ProcessResult stepped = support::run_process({program});
  return stepped.status == 0 ? stepped.output
                             : fmt::format("!{}: the program ends with {}", compiler, stepped.status);
}

}  // namespace

std::string compile_and_step(const std::string& folder) {
  const fs::path sources = fs::path(folder) / "case" / "out";
  const std::string name = emitted_name(sources);
  support::write_file((sources / "steps.cc").string(), fmt::format(kProgram, name));
  const std::string gcc = output_of("g++", sources, name), clang = output_of("clang++", sources, name);
  for (const std::string& output : {gcc, clang})
    if (output.starts_with('!')) return output.substr(1);
  if (gcc.empty()) return "no state";
  return gcc == clang ? "" : "g++ and clang++ differ";
}

}  // namespace jourdain::tests
