#include "readback/readback.hpp"

#include "readback/findings.hpp"
#include "readback/header_check.hpp"
#include "readback/manifest_check.hpp"
#include "readback/parser.hpp"
#include "readback/program_check.hpp"
#include "readback/scope_check.hpp"
#include "readback/step_check.hpp"

namespace jourdain::readback {

namespace {

void check_sources(const std::vector<support::FileText>& files, const Expected& expected, Findings& findings,
                   Record& record) {
  Unit unit;
  parse(unit, {&files[0], &files[1], &files[2]});
  check_structs(unit, expected, findings);
  check_indices(unit, expected, findings);
  check_scopes(unit, findings);
  NodeTable table;
  check_programs(unit, expected, table, findings);
  check_library(unit, findings);
  check_guards(unit, expected, findings);
  record.functions = findings.counts.size();
  record.nodes = table.size();
  check_steps(unit, expected, findings);
  check_declarations(unit, expected, findings);
}

}  // namespace

Readback read_back(const std::vector<support::FileText>& files, const Expected& expected) {
  Findings findings;
  Readback result;
  const char* const endings[] = {".hpp", "_kernels.hpp", ".cpp", ".json"};
  findings.expect("number of files", files.size(), std::size(endings));
  for (std::size_t i = 0; i < std::min(files.size(), std::size(endings)); ++i)
    findings.expect("name of a file", files[i].name, expected.name + endings[i]);
  if (findings.differences.empty()) {
    findings.guarded("sources", [&] { check_sources(files, expected, findings, result.record); });
    check_manifest(files[3].text, expected, findings);
  }
  result.differences = std::move(findings.differences);
  result.record.numbers = findings.numbers;
  result.record.steps = findings.steps.size();
  result.record.points = findings.points;
  return result;
}

std::vector<std::string> differences(const std::vector<support::FileText>& files, const Expected& expected) {
  return read_back(files, expected).differences;
}

}  // namespace jourdain::readback
