// Recommended steps against the cheapest that a search through all methods and step lengths finds: all models,
// and random scenes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "model/read/read.hpp"
#include "properties/random_scene.hpp"
#include "studies/emitted.hpp"
#include "studies/report.hpp"
#include "studies/study.hpp"
#include "support/check.hpp"
#include "support/files.hpp"

namespace jourdain::tests {
namespace {

using namespace studies;

constexpr double kTolerance = 1e-6, kSampling = 0.016, kDuration = 2;
/// Neighbouring steps of the search, and the steps in a sampling interval that end it.
constexpr double kFiner = 1.06;
constexpr long kMostSteps = 4096;
constexpr std::uint64_t kRandomScenes = 8;

model::Mechanism model_called(const std::string& name) {
  const std::string path = fmt::format("{}/models/{}.toml", JOURDAIN_SOURCE_DIR, name);
  support::Diagnostics diagnostics(path, support::read_file(path));
  std::optional<model::Mechanism> mechanism = model::read_mechanism(diagnostics);
  JD_CHECK(mechanism.has_value(), "{}", diagnostics.format());
  return *mechanism;
}

struct Found {
  std::size_t method = 0;
  double h = 0, cost = INFINITY;  ///< s of run time per simulated second
};

/// Each method from long steps to short ones, until the tolerance is kept.
Found brute_force(const Flow<double>& flow, const Study& study) {
  Found best;
  const ReferenceSolution& reference = study.reference;
  const auto intervals = static_cast<long>(reference.points.size() - 1);
  const auto tried = [&](std::size_t m, double h, double sampling) {
    const WorkPoint point = measure_errors(flow, m, h, sampling, reference, false);
    if (!point.finite || !(point.largest.position <= kTolerance)) return false;
    const double cost = study.work.step_times[m].least / h;
    if (cost < best.cost) best = {m, h, cost};
    return true;
  };
  for (std::size_t m = 0; m < study.work.step_times.size(); ++m) {
    bool keeps = false;
    for (long steps = 10; steps < intervals && !keeps; ++steps)
      if (const double h = study.judged / static_cast<double>(steps); intervals % steps == 0 && h > kSampling)
        keeps = tried(m, h, h);
    for (long n = 1; n <= kMostSteps && !keeps;
         n = std::max(n + 1, std::lround(static_cast<double>(n) * kFiner)))
      keeps = tried(m, kSampling / static_cast<double>(n), kSampling);
  }
  return best;
}

bool is_wrong(const MethodLimit& limit) {
  constexpr double kRight = 0.05;
  return limit.predicts && limit.observed && std::fabs(limit.h / limit.observed->h - 1) > kRight;
}

/// Predicted limits that runs observed, how many of them within 5 %, and whether the report says that some are
/// not to be trusted.
struct Limits {
  int observed = 0, right = 0;
  bool is_flagged = false, is_flagged_damped = false;
};

Limits limits_of(const jourdain_model_table& table, const Study& study) {
  Limits result;
  for (const MethodLimit& limit : study.stability.limits) {
    if (!limit.predicts || !limit.observed) continue;
    ++result.observed;
    result.right += !is_wrong(limit);
    result.is_flagged_damped =
        result.is_flagged_damped || (is_wrong(limit) && limit.kind == ModeKind::kDamped);
  }
  if (!study.stability.points.empty())
    for (const std::string& remark : stability_remarks(table, study))
      result.is_flagged = result.is_flagged || remark.starts_with("NOT TO BE TRUSTED");
  return result;
}

/// The limits that runs do not show so.
std::string wrong_limits_text(const jourdain_model_table& table, const Study& study) {
  std::string text;
  for (const MethodLimit& limit : study.stability.limits)
    if (is_wrong(limit))
      text += fmt::format("  {:<24} predicted {:.4g} s, {:.3f} times the observed; {} /s at {:.4g} s, {}\n",
                          table.methods[limit.method].name, limit.h, limit.h / limit.observed->h,
                          mode_text(limit.mode), limit.time, judged_text(limit));
  return text;
}

struct Tally {
  int judged = 0, kept = 0, near = 0, whole = 0, flagged = 0;
};

void judge(const std::string& name, const model::Mechanism& mechanism, Tally& tally) {
  const EmittedModel model = emitted_from(mechanism, all_loadable_functions());
  if (model.table().velocity_count == 0) return;
  const ConstantInputs none(std::vector<double>(static_cast<std::size_t>(model.table().input_count)));
  const Flow<double> flow(model.table(), none);
  StudyOptions options;
  options.duration = kDuration;
  options.longest_step = kSampling;
  options.question.tolerance = kTolerance;
  options.forms = false;
  options.seconds = 2;
  std::vector<double> parameters;
  for (const model::Parameter& parameter : mechanism.parameters) parameters.push_back(parameter.value);
  const Study study = run_study(mechanism, model.tangent, parameters, flow, nullptr, nullptr, options,
                                [](const std::string&, double) {});
  const Limits limits = limits_of(model.table(), study);
  tally.flagged += limits.is_flagged;
  const Found best = brute_force(flow, study);
  ++tally.judged;
  tally.whole += study.judged > 0.999 * study.options.duration;
  const auto method = [&](std::size_t m) { return model.table().methods[m].name; };
  if (!study.advice) {
    const bool nothing = !std::isfinite(best.cost);
    tally.kept += nothing, tally.near += nothing;
    fmt::print("{:<24} no recommendation; the search finds {}\n", name,
               nothing ? "none" : method(best.method));
    return;
  }
  const Advice& advice = *study.advice;
  const double ratio = study.work.step_times[advice.method].least / advice.h / best.cost;
  const bool kept = advice.confirmed && advice.error.position <= kTolerance;
  tally.kept += kept;
  tally.near += ratio <= 1.3;
  fmt::print(
      "{:<24} {:<24} {:9.3f} ms  error {:.1e} {}  search {:<24} {:9.3f} ms  {:5.2f} times its cost, judged "
      "{:g} s; {} of {} limits within 5 %{}{}\n",
      name, method(advice.method), 1e3 * advice.h, advice.error.position, kept ? "kept " : "MISSED",
      method(best.method), 1e3 * best.h, ratio, study.judged, limits.right, limits.observed,
      limits.is_flagged ? ", not to be trusted" : "", limits.is_flagged_damped ? " though damped" : "");
  fmt::print("{}", wrong_limits_text(model.table(), study));
  std::fflush(stdout);
}

}  // namespace
}  // namespace jourdain::tests

int main(int count, char** arguments) {
  using namespace jourdain::tests;
  Tally tally;
  for (int i = 1; i < count; ++i) {
    const std::string name = arguments[i];
    const bool is_seed = name.find_first_not_of("0123456789") == std::string::npos;
    judge(name, is_seed ? random_scene(std::stoul(name)) : model_called(name), tally);
  }
  if (count == 1) {
    std::vector<std::string> names;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(JOURDAIN_SOURCE_DIR) + "/models"))
      if (entry.path().extension() == ".toml") names.push_back(entry.path().stem());
    std::sort(names.begin(), names.end());
    for (const std::string& name : names) judge(name, model_called(name), tally);
    for (std::uint64_t seed = 1; seed <= kRandomScenes; ++seed)
      judge(fmt::format("random scene {}", seed), random_scene(seed), tally);
  }
  fmt::print(
      "{} scenes: tolerance kept in {}, within 1.3 times of the search in {}, the whole time judged in {}, "
      "limits not to be "
      "trusted in {}\n",
      tally.judged, tally.kept, tally.near, tally.whole, tally.flagged);
  return tally.kept == tally.judged ? EXIT_SUCCESS : EXIT_FAILURE;
}
