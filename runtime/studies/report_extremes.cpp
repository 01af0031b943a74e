#include <fmt/format.h>

#include <cmath>

#include "studies/report.hpp"

namespace jourdain::studies {

namespace {

/// The largest of a member over a sweep, with the factor where it is.
std::string worst(const ExtremeSweep& sweep, double ExtremePoint::*member) {
  const ExtremePoint* found = nullptr;
  for (const ExtremePoint& point : sweep.points)
    if (point.finite && point.closes && !std::isnan(point.*member) &&
        (!found || point.*member > found->*member))
      found = &point;
  return found ? fmt::format("{:.2g} ({:g})", found->*member, found->factor) : "-";
}

std::string breaks(const ExtremeSweep& sweep) {
  std::string text;
  for (const ExtremePoint& point : sweep.points)
    if (!point.finite) text += fmt::format("{}{:g}", text.empty() ? "" : ", ", point.factor);
  if (text.empty()) text = "nowhere";
  std::string open;
  for (const ExtremePoint& point : sweep.points)
    if (!point.closes)
      open += fmt::format("{}{:g}", open.empty() ? "; loops do not close at " : ", ", point.factor);
  return text + open;
}

}  // namespace

std::vector<std::vector<std::string>> extremes_rows(const std::vector<ExtremeSweep>& sweeps) {
  std::vector<std::vector<std::string>> rows;
  for (const ExtremeSweep& sweep : sweeps)
    rows.push_back({sweep.quantity,
                    fmt::format("{} {:g} to {:g}", sweep.quantity == "all angles" ? "plus" : "times",
                                sweep.points.front().factor, sweep.points.back().factor),
                    worst(sweep, &ExtremePoint::backward), worst(sweep, &ExtremePoint::forward),
                    breaks(sweep)});
  return rows;
}

std::string extremes_text(const std::vector<ExtremeSweep>& sweeps) {
  if (sweeps.empty()) return "";
  std::string text =
      "\n  accelerations far from the usual, against 50 digits: worst errors in units of rounding, and at "
      "which factor\n";
  constexpr const char* kExtremesRow = "  {:<18} {:<22} {:>18} {:>18}  {}\n";
  text += fmt::format(kExtremesRow, "swept", "range", "backward", "forward", "not finite at");
  for (const std::vector<std::string>& row : extremes_rows(sweeps))
    text += fmt::format(kExtremesRow, row[0], row[1], row[2], row[3], row[4]);
  return text;
}

std::string extremes_csv(const std::vector<ExtremeSweep>& sweeps) {
  std::string text = "quantity,factor,backward_error_u,forward_error_u,finite,closes\n";
  for (const ExtremeSweep& sweep : sweeps)
    for (const ExtremePoint& p : sweep.points)
      text += fmt::format("{},{:g},{},{},{},{}\n", sweep.quantity, p.factor, p.backward, p.forward,
                          p.finite ? 1 : 0, p.closes ? 1 : 0);
  return text;
}

}  // namespace jourdain::studies
