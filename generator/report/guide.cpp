#include "report/guide.hpp"

#include <cmath>

namespace jourdain::report {

namespace {

constexpr double kRounding = 30;  ///< times the floor: rounding has no part in errors above
constexpr double kNear = 2;       ///< factor by which errors may be off the line

bool is_near(double a, double b) { return a < kNear * b && b < kNear * a; }

}  // namespace

Series order_guide(const Series& series, int order, double floor) {
  const Series none{"", {}, {}, series.colour, true, false, true};
  std::size_t count = series.y.size();
  while (count > 0 && !(series.y[count - 1] > kRounding * floor)) --count;
  Series line = none;
  for (std::size_t i = count; i-- > 0;) {
    const double y = series.y[count - 1] * std::pow(series.x[i] / series.x[count - 1], -order);
    if (!is_near(y, series.y[i])) break;
    line.x.push_back(series.x[i]);
    line.y.push_back(y);
  }
  return line.x.size() < 2 ? none : line;
}

}  // namespace jourdain::report
