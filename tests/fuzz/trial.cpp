#include "fuzz/trial.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "fuzz/both_compilers.hpp"

namespace jourdain::tests {

namespace {

namespace fs = std::filesystem;

/// One in fifty of all cases; the number decides, so that it is the same ones in every run.
bool is_compiled(std::uint64_t index) {
  constexpr std::uint64_t kOneIn = 50;
  return (index / 20) % kOneIn ==
         index % 20;  // of every twenty, which go through all kinds, another one each time
}

void prepare(const Case& tried, const fs::path& folder) {
  fs::remove_all(folder);
  for (const char* part : {"case", "tmp"}) fs::create_directories(folder / part);
  for (const support::FileText& file : tried.files)
    support::write_file((folder / "case" / file.name).string(), file.text);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Without lines `begin` to `end`, exclusive.
std::string without(const std::vector<std::string>& lines, std::size_t begin, std::size_t end) {
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (i < begin || i >= end) text += lines[i] + "\n";
  return text;
}

}  // namespace

Trial try_case(const Case& tried, std::uint64_t index, const std::string& folder) {
  prepare(tried, folder);
  const ChildResult result = run_in_child(folder, tried.arguments);
  Trial trial;
  trial.verdict = judge(tried, result, folder);
  trial.read = result.read;
  trial.seconds = result.seconds;
  trial.emitted = result.status == 0;
  if (trial.verdict.outcome == Outcome::kDone && tried.kind != CaseKind::kOptions && is_compiled(index)) {
    trial.compiled = true;
    if (const std::string wrong = compile_and_step(folder); !wrong.empty())
      trial.verdict = {Outcome::kNotCompiled, wrong};
  }
  trial.shown = fmt::format("jourdain {}\nstatus {}, {:.2f} s\n{}", fmt::join(tried.arguments, " "),
                            result.status, result.seconds, result.errors);
  return trial;
}

Case minimised(Case tried, const Verdict& verdict, std::uint64_t index, const std::string& folder) {
  int left = 300;
  const auto still = [&](const Case& smaller) {
    const Trial trial = try_case(smaller, index, folder);
    return trial.verdict.outcome == verdict.outcome && trial.verdict.why == verdict.why;
  };
  for (std::size_t size = lines_of(tried.files[0].text).size(); size > 0; size /= 2)
    for (std::size_t begin = 0; left > 0;) {
      const std::vector<std::string> lines = lines_of(tried.files[0].text);
      if (begin >= lines.size()) break;
      Case smaller = tried;
      smaller.files[0].text = without(lines, begin, begin + size);
      --left;
      still(smaller) ? (void)(tried = smaller) : (void)(begin += size);
    }
  return tried;
}

}  // namespace jourdain::tests
