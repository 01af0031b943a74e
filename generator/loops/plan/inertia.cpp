#include "loops/plan/inertia.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reference/decompositions.hpp"
#include "reference/massless.hpp"
#include "support/matrix_index.hpp"

namespace jourdain::loops {

using support::shown;

namespace {

using support::at;

/// Configurations at which a motion must be without inertia to be so everywhere.
constexpr std::size_t kConfigurations = 4;
/// Of the term sum of a motion's inertia, and of the largest inertia of all: below is rounding in long double.
constexpr long double kRounding = 1e-13L, kSmallest = 1e-18L;

/// Motions that keep the loops closed, orthonormal columns.
Matrix free_motions(const Matrix& G) { return reference::null_space<long double>(G, kRankTolerance); }

/// The joint that moves most in a motion without inertia; none where all motions have inertia.
std::optional<model::JointIndex> idle_joint(const model::Mechanism& mechanism, const Configuration& config,
                                            const Matrix& G) {
  const Matrix N = free_motions(G);
  if (N.cols() == 0) return {};
  const reference::Reference<long double> reference(mechanism);
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  const auto terms = reference.evaluate({config.t, config.y, Vector::Zero(G.cols())},
                                        Vector::Zero(at(layout.input_count())));
  const auto inertia = reference::symmetric_eigenpairs<long double>(N.transpose() * terms.M * N);
  const Vector motion = N * inertia.vectors.col(0), size = motion.cwiseAbs();
  const long double sum = size.dot(terms.M_scale * size), largest = inertia.values.tail(1)[0];
  if (inertia.values[0] > std::max(kRounding * sum, kSmallest * largest)) return {};
  Eigen::Index most = 0;
  size.maxCoeff(&most);
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j) {
    const Eigen::Index entry = most - at(layout.joints[j].first_velocity);
    if (entry >= 0 && entry < at(layout.joints[j].velocity_count)) return model::JointIndex(j);
  }
  return {};
}

}  // namespace

std::vector<model::JointIndex> massless_in_tree(const model::Mechanism& mechanism,
                                                const Configuration& start) {
  std::vector<model::JointIndex> always = reference::massless_joints(mechanism);
  if (!always.empty()) return always;
  const std::size_t n = model::lay_out_coordinates(mechanism).velocity_count();
  return reference::singular_joints(mechanism, {start.t, start.y, Vector::Zero(at(n))});
}

bool check_moved_inertia(const model::Mechanism& mechanism, const std::vector<Configuration>& configurations,
                         const std::vector<Matrix>& jacobians, support::Diagnostics& diagnostics) {
  const std::optional<model::JointIndex> idle =
      idle_joint(mechanism, configurations.front(), jacobians.front());
  if (!idle) return true;
  bool everywhere = true;
  for (std::size_t k = 1; k < std::min(kConfigurations, configurations.size()); ++k)
    everywhere = everywhere && idle_joint(mechanism, configurations[k], jacobians[k]);
  const model::Joint& joint = mechanism.joints[idle->value];
  diagnostics.error(joint.where,
                    fmt::format("joint '{}' moves no inertia where the loops let it move{}",
                                shown(joint.name), everywhere ? "" : " at the initial state"),
                    everywhere ? "give a body that it moves a mass or an inertia, or make the joint fixed"
                               : "the mass matrix is singular there: start from another position");
  return false;
}

bool check_tree_inertia(const model::Mechanism& mechanism, const std::vector<model::JointIndex>& massless,
                        const LoopPlan& plan, support::Diagnostics& diagnostics) {
  if (plan.is_reduced()) return true;
  for (const model::JointIndex index : massless) {
    const model::Joint& joint = mechanism.joints[index.value];
    diagnostics.error(
        joint.where, fmt::format("joint '{}' moves no inertia, which multipliers need", shown(joint.name)),
        plan.reason.empty()
            ? "give a body that it moves a mass or an inertia, or leave out 'treatment'"
            : fmt::format("multipliers are left because {}; give a body that it moves a mass or an inertia",
                          plan.reason));
  }
  return massless.empty();
}

}  // namespace jourdain::loops
