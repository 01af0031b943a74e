// The linear systems along a trajectory and how fast the trajectory itself is: what step limits are judged by.
#pragma once

#include <vector>

#include "model/coordinates.hpp"
#include "studies/linearisation.hpp"
#include "studies/reference_solution.hpp"
#include "studies/tangent_space.hpp"

namespace jourdain::studies {

/// The linear system at one time, of the motions that keep the loops closed. The reference that it comes from
/// must outlive it.
struct Local {
  const Point<double>* point = nullptr;
  LocalCoordinates coordinates;
  Eigen::MatrixXd A;  ///< in those coordinates
  Modes modes;
  Eigen::VectorXcd
      judged;  ///< the modes' values, 1/s, oscillations with their mean damping along the trajectory

  /// Rows of A that are of positions, the first ones.
  Eigen::Index positions() const { return static_cast<Eigen::Index>(coordinates.displacements.size()); }
};

/// What modes are compared with.
struct Scene {
  double rate = 0;      ///< 1/s; trajectory_rate
  double duration = 0;  ///< s
  double roundoff = 0;  ///< of the number type
  bool damps = false;   ///< volumes in phase space shrink, of coordinates and momenta
};

/// At evenly spaced points of the reference, in time.
std::vector<Local> linearise(const Flow<double>& flow, const ReferenceSolution& reference,
                             const model::Tangent& tangent, const Progress& progress);

/// `locals` from `linearise`, at least one. A scene that conserves energy damps nothing, unless there are states or
/// constraints that bind velocities alone.
Scene describe_scene(const Flow<double>& flow, const ReferenceSolution& reference,
                     const std::vector<Local>& locals, const model::Tangent& tangent, bool conserves_energy);

/// rms(ż) over rms(z) along the trajectory, weighed by M, 1/s: a stiff coordinate that vibrates or settles
/// counts with the little energy that it has; of states mean |ẋ| over mean |x|. At least half the largest rate
/// at which a quaternion turns, and one over the duration.
double trajectory_rate(const Flow<double>& flow, const ReferenceSolution& reference,
                       const model::Tangent& tangent);

/// The one nearest in time, s.
const Local& local_at(const std::vector<Local>& locals, double time);

/// Column of the mode µ.
Eigen::Index index_of(std::complex<double> mu, const Modes& modes);

/// Largest |µ|, 1/s.
double fastest_of(const Modes& modes);

/// Modes that are zero but for rounding: of a double zero half the digits are lost.
bool negligible(std::complex<double> mu, const Modes& modes, const Scene& scene);

}  // namespace jourdain::studies
