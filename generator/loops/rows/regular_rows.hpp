// Which rows of the constraints are solved for where some follow from others.
#pragma once

#include <vector>

#include "loops/rows/configuration.hpp"

namespace jourdain::loops {

/// A row that differs from a combination of others by less than this share of the largest row counts as
/// following from them: numbers that a file gives to seven digits differ by no more.
inline constexpr long double kRowTolerance = 1e-6L;

/// As many rows as are independent anywhere: those that stay so best where they do it worst, of the
/// configurations at which that many are; earlier rows where there is little difference. In order. `first` are chosen
/// in any case.
std::vector<std::size_t> regular_rows(const std::vector<Matrix>& jacobians,
                                      long double tolerance = kRowTolerance,
                                      const std::vector<std::size_t>& first = {});

/// What the largest of `others` adds to the rows `regular` of G, over its largest row.
long double largest_rest(const Matrix& G, const std::vector<std::size_t>& regular,
                         const std::vector<std::size_t>& others);

/// Rows 0 … count − 1 without those, in order.
std::vector<std::size_t> all_but(const std::vector<std::size_t>& rows, std::size_t count);

}  // namespace jourdain::loops
