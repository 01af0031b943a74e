#include "commands/callgrind.hpp"

#include <cstdlib>
#include <map>
#include <sstream>

#include "support/check.hpp"
#include "support/files.hpp"
#include "support/process.hpp"

namespace jourdain::commands {

namespace {

/// Names are written once, behind a number in parentheses that stands for them later: "(12) main", "(12)".
class Names {
 public:
  std::string read(const std::string& text) {
    const std::size_t end = text.find(')');
    if (!text.starts_with('(') || end == std::string::npos) return text;
    std::string& name = names_[text.substr(0, end)];
    if (end + 2 < text.size()) name = text.substr(end + 2);
    return name;
  }

 private:
  std::map<std::string, std::string> names_;
};

}  // namespace

std::vector<CountedCalls> read_callgrind(const std::string& text) {
  std::vector<CountedCalls> list;
  Names names;
  std::string caller, callee;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("fn=")) caller = names.read(line.substr(3));
    if (line.starts_with("cfn=")) callee = names.read(line.substr(4));
    if (!line.starts_with("calls=")) continue;
    CountedCalls counted{caller, callee, std::atoll(line.c_str() + 6), 0};
    // Of the next line: where the call stands, and what it cost.
    if (std::getline(lines, line)) counted.instructions = std::atoll(line.c_str() + line.rfind(' ') + 1);
    list.push_back(counted);
  }
  return list;
}

std::optional<std::string> valgrind_version() try {
  const support::ProcessResult result = support::run_process({"valgrind", "--version"});
  if (result.status != 0) return {};
  return result.output.substr(0, result.output.find('\n'));
} catch (const support::EnvironmentError&) {
  return {};
}

std::optional<std::vector<CountedCalls>> count_calls(const std::string& program, const std::string& folder) {
  const std::string file = folder + "/callgrind.out";
  const support::ProcessResult result =
      support::run_process({"valgrind", "--tool=callgrind", "--callgrind-out-file=" + file, program});
  if (result.status != 0) return {};
  return read_callgrind(support::read_file(file));
}

}  // namespace jourdain::commands
