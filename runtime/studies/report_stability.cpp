// What a report says about stability, as text and CSV.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/report.hpp"

namespace jourdain::studies {

namespace {

constexpr double kTransient = 100;  ///< growth that eigenvalues hide, worth a remark

std::string instant(double t) { return t == 0 ? "0 s" : time_text(t); }

/// Names of the methods whose limits fulfil something.
template <class Condition>
std::string names_where(const jourdain_model_table& table, const Stability& stability,
                        const Condition& condition) {
  std::string text;
  for (const MethodLimit& limit : stability.limits)
    if (condition(limit)) text += (text.empty() ? "" : ", ") + std::string(table.methods[limit.method].name);
  return text;
}

std::string disagreeing_text(const jourdain_model_table& table, const Stability& stability) {
  constexpr double kAgreement = 0.05;
  return names_where(table, stability, [](const MethodLimit& limit) {
    return limit.predicts && limit.observed && std::fabs(limit.observed->h / limit.h - 1) > kAgreement;
  });
}

std::string unpredicted_text(const jourdain_model_table& table, const Stability& stability) {
  return names_where(table, stability,
                     [](const MethodLimit& limit) { return !limit.predicts && !limit.implicit; });
}

std::string owners_text(const Stability& stability) {
  constexpr std::size_t kMost = 4;
  std::string text;
  for (std::size_t i = 0; i < std::min(kMost, stability.owners.size()); ++i)
    text += fmt::format("{}{} {:.0f}\u00a0%", text.empty() ? "" : ", ", stability.owners[i].name,
                        100 * stability.owners[i].share);
  return text;
}

}  // namespace

std::string wrapped(const std::string& sentence) {
  constexpr std::size_t kWidth = 106;
  std::string text;
  for (std::size_t begin = 0; begin < sentence.size();) {
    std::size_t end = sentence.size();
    if (end - begin > kWidth) end = sentence.rfind(' ', begin + kWidth);
    text += (begin == 0 ? "  " : "    ") + sentence.substr(begin, end - begin) + "\n";
    begin = end + 1;
  }
  return text;
}

std::string mode_text(std::complex<double> mu) {
  return mu.imag() == 0 ? fmt::format("{:.4g}", mu.real())
                        : fmt::format("{:.4g} ± {:.4g}i", mu.real(), std::fabs(mu.imag()));
}

std::string limit_text(const MethodLimit& limit) {
  if (limit.implicit) return "none: L-stable";
  if (!limit.predicts) return "-";
  return limit.h == 0 ? "none: undamped mode" : time_text(limit.h);
}

std::string observed_text(const MethodLimit& limit) {
  if (limit.stable_until) return fmt::format("none up to {}", time_text(*limit.stable_until));
  return limit.observed ? time_text(limit.observed->h) : "-";
}

std::string judged_text(const MethodLimit& limit) {
  if (!limit.predicts) return "-";
  return limit.kind == ModeKind::kDamped ? "damped" : "undamped";
}

std::vector<std::string> stability_remarks(const jourdain_model_table& table, const Study& study) {
  const Stability& s = study.stability;
  std::vector<std::string> list;
  if (s.points.empty()) return list;
  list.push_back(
      fmt::format("fastest mode of {} states along the trajectory: {} /s at t = {}; it belongs to {}",
                  s.points.size(), mode_text(s.fastest), instant(s.fastest_time), owners_text(s)));
  list.push_back(
      s.damps ? fmt::format("the trajectory's own rate is {:.3g} /s; the fastest decay is {:.3g} times that",
                            s.rate, s.stiffness)
              : fmt::format("the trajectory's own rate is {:.3g} /s; the scene damps nothing", s.rate));
  if (std::any_of(s.limits.begin(), s.limits.end(),
                  [](const MethodLimit& l) { return l.predicts && l.observed; }))
    list.push_back(
        "observed where predicted: runs from the state at that t on, velocities displaced by a millionth "
        "along the mode; -: none found");
  if (std::any_of(s.limits.begin(), s.limits.end(), [](const MethodLimit& l) { return l.implicit; }))
    list.push_back(
        "L-stable methods have no limit in linear theory; what is observed of them are runs from the start "
        "over the whole time, until a velocity is ten times the largest of the reference");
  const std::string apart = disagreeing_text(table, s);
  if (!apart.empty())
    list.push_back("NOT TO BE TRUSTED: predicted and observed limits differ by more than 5 % for " + apart);
  const std::string unpredicted = unpredicted_text(table, s);
  if (!unpredicted.empty())
    list.push_back(fmt::format(
        "no prediction for {}: no mode limits them, or it grows, is neither thirty times faster than the "
        "motion nor stays as it is, or allows more than a quarter of the time, or is of positions after "
        "velocities of which constraints bind some, or the method leaves out derivatives of what is carried "
        "along; observed of them are runs from the start over the whole time, until a velocity is ten times "
        "the largest of the reference",
        unpredicted));
  if (s.transient_growth > kTransient)
    list.push_back(
        fmt::format("eigenvalues mislead here: at 0.9 of its limit {} lets some differences grow "
                    "{:.2g}-fold before they die out",
                    s.transient_method, s.transient_growth));
  const std::string stiff = stiff_text(table, study);
  if (!stiff.empty()) list.push_back(stiff);
  return list;
}

std::string stability_text(const jourdain_model_table& table, const Study& study) {
  if (study.stability.points.empty()) return "";
  std::string text = fmt::format("\n  largest stable step\n  {:<24} {:>19} {:>17} {:>10} {:>24}  {}\n",
                                 "method", "predicted", "observed", "at t", "deciding mode, 1/s", "it is");
  for (const MethodLimit& limit : study.stability.limits) {
    const bool any = limit.predicts;
    text += fmt::format("  {:<24} {:>19} {:>17} {:>10} {:>24}  {}\n", table.methods[limit.method].name,
                        limit_text(limit), observed_text(limit), any ? instant(limit.time) : "-",
                        any ? mode_text(limit.mode) : "-", judged_text(limit));
  }
  for (const std::string& remark : stability_remarks(table, study)) text += wrapped(remark);
  return text;
}

std::string stiff_text(const jourdain_model_table& table, const Study& study) {
  constexpr double kNear = 0.4;  // of the limit: a recommended step that short is limited by something else
  const MethodLimit* longest = stiff_limit(study.stability);
  if (!longest) return "";
  std::string recommended;
  if (study.advice) {
    const MethodLimit& limit = study.stability.limits[study.advice->method];
    const double own = largest_stable_step(limit);
    if (std::isfinite(own) && !(study.advice->h > kNear * own)) return "";
    if (std::isfinite(own) && !limit.implicit && &limit != longest)
      recommended = fmt::format(", {} h < {}", table.methods[limit.method].name, time_text(own));
  }
  return fmt::format("stiff: explicit methods need h < {} ({}){}, whatever the accuracy asked for",
                     time_text(largest_stable_step(*longest)), table.methods[longest->method].name,
                     recommended);
}

std::string stability_csv(const jourdain_model_table& table, const Stability& stability) {
  std::string text = "time_s,fastest_per_s,stiffness";
  for (const MethodLimit& limit : stability.limits)
    text += fmt::format(",limit_{}_s", table.methods[limit.method].name);
  for (const StabilityPoint& point : stability.points) {
    text += fmt::format("\n{},{},{}", point.time, point.fastest, point.stiffness);
    for (const double h : point.limits) text += std::isfinite(h) ? fmt::format(",{}", h) : ",";
  }
  return text + "\n";
}

}  // namespace jourdain::studies
