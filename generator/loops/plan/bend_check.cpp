#include "loops/plan/bend_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "loops/record/loop_plan.hpp"
#include "model/coordinates.hpp"
#include "model/loop_kinds.hpp"
#include "support/matrix_index.hpp"

namespace jourdain::loops {

namespace {

/// Of what accelerations undo, and of squares of velocities: numbers of the description are rounded.
constexpr long double kBent = 1e-5L;

std::string in_words(const model::CoordinateLayout& layout, const Vector& z) {
  constexpr std::size_t kMost = 6;
  std::vector<std::string> list;
  for (Eigen::Index k = 0; k < z.size(); ++k)
    if (z[k] != 0)
      list.push_back(fmt::format("{} = {:.4g}",
                                 support::shown(layout.velocity_names[static_cast<std::size_t>(k)]),
                                 static_cast<double>(z[k])));
  if (list.size() > kMost) {
    list.resize(kMost);
    list.emplace_back("...");
  }
  return fmt::format("{}", fmt::join(list, ", "));
}

}  // namespace

bool check_bend(const model::Mechanism& mechanism, const NumericClosure& closure, const Configuration& start,
                const Vector& z, const std::vector<std::size_t>& rows, support::Diagnostics& diagnostics) {
  if (rows.empty()) return true;
  const auto [bent, largest] = closure.bend(start, z, rows);
  const long double fastest = closure.extent(z);
  Eigen::Index worst = 0;
  if (!(bent.cwiseAbs().maxCoeff(&worst) > kBent * (fastest * fastest + largest))) return true;
  const std::size_t row = rows[static_cast<std::size_t>(worst)];
  const model::Loop& loop = model::loop_of_row(mechanism, row);
  diagnostics.error(
      loop.where,
      fmt::format(
          "no motion starts with these velocities: {} is at a dead point, where they do not follow from each "
          "other",
          model::in_words(loop)),
      fmt::format("whatever the accelerations are, constraint {} opens by {:.3g}/s^2 with {}: give "
                  "velocities of more joints, or start elsewhere",
                  row_names(mechanism)[row],
                  static_cast<double>(std::abs(bent[worst]) * closure.units().rows[row]),
                  in_words(model::lay_out_coordinates(mechanism), z)));
  return false;
}

}  // namespace jourdain::loops
