#include "readback/readback.hpp"

#include "readback/c_parser.hpp"
#include "readback/findings.hpp"
#include "readback/header_check.hpp"
#include "readback/manifest_check.hpp"
#include "readback/parser.hpp"
#include "readback/program_check.hpp"
#include "readback/scope_check.hpp"
#include "readback/step_check.hpp"

namespace jourdain::readback {

namespace {

using Files = std::vector<support::FileText>;

/// What C++ and C have in common once they are read.
void check_functions(const Unit& unit, const Expected& expected, Findings& findings, Record& record) {
  check_scopes(unit, findings);
  NodeTable table(expected.is_float);
  check_programs(unit, expected, table, findings);
  check_library(unit, expected, findings);
  check_guards(unit, expected, findings);
  record.functions += findings.counts.size();
  record.nodes += table.size();
  check_steps(unit, expected, findings);
  record.steps += findings.steps.size();
  check_declarations(unit, expected, findings);
}

void check_cpp(const Files& files, const Expected& expected, Findings& findings, Record& record) {
  Unit unit;
  unit.called = expected.user_functions();
  parse(unit, {&files[0], &files[1], &files[2]}, expected.choices.packs);
  check_structs(unit, expected, findings);
  check_indices(unit, expected, findings);
  check_functions(unit, expected, findings, record);
}

double in_float(double value) { return static_cast<double>(static_cast<float>(value)); }

/// What files for float must say: every number rounded.
Expected rounded(Expected expected) {
  expected.is_float = true;
  expected.least_regularity = in_float(expected.least_regularity);
  expected.greatest_opening = in_float(expected.greatest_opening);
  for (ExpectedRange& range : expected.proven_parameters)
    range = {range.index, in_float(range.low), in_float(range.high)};
  return expected;
}

void check_c(const Files& files, const Expected& expected, Findings& findings, Record& record) {
  std::size_t next = 0;
  for (const bool is_float : {false, true}) {
    if (!(is_float ? expected.choices.has_float : expected.choices.has_double)) continue;
    const CText c = {expected.name + (is_float ? "_f_" : "_"), is_float};
    const Expected wanted = is_float ? rounded(expected) : expected;
    Unit unit;
    unit.called = expected.user_functions();
    parse_c(unit, files[next], files[next + 1], c);
    next += 2;
    findings.counts.clear();
    findings.steps.clear();
    check_c_structs(unit, wanted, c.prefix, findings);
    check_functions(unit, wanted, findings, record);
  }
}

std::vector<std::string> file_names(const Expected& expected) {
  std::vector<std::string> names;
  const auto add = [&](std::initializer_list<const char*> endings) {
    for (const char* ending : endings) names.push_back(expected.name + ending);
  };
  const bool in_c = expected.choices.language == ir::Language::kC;
  if (!in_c) add({".hpp", "_kernels.hpp", ".cpp"});
  if (in_c && expected.choices.has_double) add({".h", ".c"});
  if (in_c && expected.choices.has_float) add({"_f.h", "_f.c"});
  add({".json"});
  return names;
}

}  // namespace

Readback read_back(const Files& files, const Expected& expected) {
  Findings findings;
  Readback result;
  const std::vector<std::string> names = file_names(expected);
  findings.expect("number of files", files.size(), names.size());
  for (std::size_t i = 0; i < std::min(files.size(), names.size()); ++i)
    findings.expect("name of a file", files[i].name, names[i]);
  if (findings.differences.empty()) {
    const auto check = expected.choices.language == ir::Language::kC ? check_c : check_cpp;
    findings.guarded("sources", [&] { check(files, expected, findings, result.record); });
    check_manifest(files.back().text, expected, findings);
  }
  result.differences = std::move(findings.differences);
  result.record.numbers = findings.numbers;
  result.record.points = findings.points;
  return result;
}

std::vector<std::string> differences(const Files& files, const Expected& expected) {
  return read_back(files, expected).differences;
}

}  // namespace jourdain::readback
