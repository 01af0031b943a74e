#include "validate/kinematic_arrays.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "dynamics/kinematic_functions.hpp"
#include "support/check.hpp"

namespace jourdain::validate {

KinematicArrays kinematic_arrays(const std::vector<dynamics::KinematicValues>& arrays,
                                 const dynamics::HighPrecision& exact) {
  KinematicArrays values;
  for (const dynamics::KinematicValues& array : arrays) {
    const std::vector<ScaledReal> entries = exact.values(array.values);
    const Eigen::Index columns = std::max(array.columns, 1);
    ExactMatrix& matrix = values[array.name];
    matrix.resize(array.rows, columns);
    for (Eigen::Index i = 0; i < matrix.size(); ++i)
      matrix(i / columns, i % columns) = entries[static_cast<std::size_t>(i)];
  }
  return values;
}

std::vector<ScaledReal> entries_of(const ir::Program& program, const KinematicArrays& arrays) {
  std::vector<ScaledReal> values;
  std::set<std::pair<std::string, Eigen::Index>> written;
  for (const ir::Output& output : program.outputs) {
    const ExactMatrix& array = arrays.at(output.name);
    const int column = std::max(output.column, 0);
    values.push_back(array(output.row, column));
    written.insert({output.name, output.row * array.cols() + column});
  }
  for (const auto& [name, array] : arrays)
    for (Eigen::Index i = 0; i < array.size() && name != dynamics::kOperationalJacobian; ++i) {
      const ScaledReal& entry = array(i / array.cols(), i % array.cols());
      constexpr long double kZero = 1e-40L;
      const bool is_zero = std::fabs(static_cast<long double>(entry)) <= kZero * entry.scale();
      JD_CHECK(is_zero || written.contains({name, i}), "{} leaves out entry {} of {}", program.name, i, name);
    }
  return values;
}

}  // namespace jourdain::validate
