#include <fmt/format.h>

#include "studies/report.hpp"

namespace jourdain::studies {

std::vector<std::string> touches_head(const Study& study) {
  std::vector<std::string> head = {"element", "deepest", "at t", "touches", "stiffness"};
  if (study.options.penetration) head.insert(head.end(), {"within depth: stiffness", "steps"});
  return head;
}

std::vector<std::vector<std::string>> touches_rows(const Study& study) {
  std::vector<std::vector<std::string>> rows;
  if (!study.touches) return rows;
  for (std::size_t i = 0; i < study.touches->runs.size(); ++i) {
    const TouchFacts& element = study.options.touches[i];
    const TouchRun& run = study.touches->runs[i];
    const bool touched = run.deepest > 0;
    rows.push_back({element.name, touched ? fmt::format("{:.3g} {}", run.deepest, element.unit) : "never",
                    touched ? time_text(run.at) : "-", fmt::format("{:.2g} %", 100 * run.share),
                    fmt::format("{:.4g}", element.stiffness)});
    if (!study.options.penetration) continue;
    const Stiffening needed = stiffening(element, run.deepest, *study.options.penetration);
    const bool is_deeper = run.deepest > *study.options.penetration;
    const bool starts_deeper = run.start > *study.options.penetration;
    rows.back().push_back(starts_deeper ? "none: it starts deeper"
                          : is_deeper   ? fmt::format("{:.4g}", needed.stiffness)
                                        : "as it is");
    rows.back().push_back(starts_deeper ? "-"
                          : is_deeper   ? fmt::format("times {:.3g}", needed.step_share)
                                        : "as they are");
  }
  return rows;
}

std::vector<std::string> touches_remarks(const jourdain_model_table& table, const Study& study) {
  std::vector<std::string> list = {fmt::format(
      "depths at the ends of steps of {}, h = {}, the most accurate run (position error {:.1e}); touches: "
      "share of its steps that end so",
      table.methods[study.touches->method].name, time_text(study.touches->h), study.touches->error.position)};
  if (study.options.penetration)
    list.push_back(fmt::format(
        "estimated, to stay within a depth of {:g} with a fifth of it in reserve: the depth of an impact "
        "falls with stiffness^(-1/(e + 1)) for a force k d^e, that of what rests with stiffness^(-1/e), so "
        "that less does for it; what touches then "
        "lasts that much shorter, and steps have to be shorter alike. Run the report again with that "
        "stiffness: it measures",
        *study.options.penetration));
  return list;
}

std::string touches_text(const jourdain_model_table& table, const Study& study) {
  if (!study.touches) return "";
  std::string text = "\n  one-sided elements\n";
  for (const std::string& remark : touches_remarks(table, study)) text += wrapped(remark);
  std::vector<std::vector<std::string>> rows = touches_rows(study);
  rows.insert(rows.begin(), touches_head(study));
  for (const std::vector<std::string>& row : rows) {
    text += fmt::format("  {:<23} {:>12} {:>9} {:>8} {:>10}", row[0], row[1], row[2], row[3], row[4]);
    if (row.size() > 5) text += fmt::format(" {:>24} {:>12}", row[5], row[6]);
    text += '\n';
  }
  return text;
}

}  // namespace jourdain::studies
