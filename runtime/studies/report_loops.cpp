#include <fmt/format.h>

#include "studies/report.hpp"

namespace jourdain::studies {

std::vector<std::vector<std::string>> loop_rows(const jourdain_model_table& table, const Study& study) {
  std::vector<std::vector<std::string>> rows;
  for (const LoopRun& run : study.loops) {
    const auto value = [&run](double size) {
      return run.finite ? fmt::format("{:.1e}", size) : std::string("fails");
    };
    rows.push_back({table.methods[run.method].name, time_text(run.h), fmt::format("{}", run.steps),
                    value(run.open.position), value(run.open.velocity)});
  }
  return rows;
}

std::string loops_text(const ReportHead& head, const jourdain_model_table& table, const Study& study) {
  if (head.loops.empty()) return "";
  std::string text = "\n  closed loops\n";
  for (const std::string& sentence : head.loops) text += wrapped("- " + sentence);
  text += wrapped("how far they open over the run, largest of all rows; each step ends with " + head.closing);
  constexpr const char* kRow = "  {:<23} {:>9} {:>8} {:>10} {:>11}\n";
  text += fmt::format(kRow, "method", "h", "steps", "|g|, m", "rate, m/s");
  for (const std::vector<std::string>& row : loop_rows(table, study))
    text += fmt::format(kRow, row[0], row[1], row[2], row[3], row[4]);
  return text;
}

std::string loops_csv(const ReportHead& head, const jourdain_model_table& table, const Study& study) {
  std::string text = "method,step_s,steps,closed_by,largest_residual_m,largest_rate_m_per_s,finite\n";
  for (const LoopRun& run : study.loops)
    text += fmt::format("{},{},{},\"{}\",{},{},{}\n", table.methods[run.method].name, run.h, run.steps,
                        head.closing, run.open.position, run.open.velocity, run.finite ? 1 : 0);
  return text;
}

}  // namespace jourdain::studies
