// What every library answers about a robot, so that all are compared and timed alike.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/compare/robot.hpp"

namespace jourdain::compare {

enum class Quantity { kForward, kInverse, kMass, kStep };
inline constexpr Quantity kQuantities[] = {Quantity::kForward, Quantity::kInverse, Quantity::kMass,
                                           Quantity::kStep};
const char* name_of(Quantity quantity);

/// State and accelerations as emitted code has them: of a free root position and quaternion w x y z, velocity in the
/// inertial frame and angular velocity in the root's.
struct Sample {
  std::vector<double> y, z, zdot;
};

inline constexpr double kStepLength = 1e-4;  ///< s, of steps

class Library {
 public:
  virtual ~Library() = default;

  virtual std::string name() const = 0;

  /// What it calls for the quantity; empty where it has nothing like it.
  virtual std::string calls(Quantity quantity) const = 0;

  /// Accelerations at no force; forces for the accelerations; M row by row; y and z one step later.
  virtual std::vector<double> result(Quantity quantity, std::size_t sample) = 0;

  /// All samples that often; steps go on from each sample.
  virtual void run(Quantity quantity, int times) = 0;
};

/// The emitted robot again, many samples at once as lanes of vectors.
std::unique_ptr<Library> make_ensemble(const std::string& robot, const std::vector<Sample>& samples);

/// Each may be missing: nothing is returned where the library was not found, or does not take the robot.
std::unique_ptr<Library> make_kdl(const Robot& robot, const std::vector<Sample>& samples);
std::unique_ptr<Library> make_mujoco(const Robot& robot, const std::vector<Sample>& samples);
std::unique_ptr<Library> make_simbody(const Robot& robot, const std::vector<Sample>& samples);
std::unique_ptr<Library> make_bullet(const Robot& robot, const std::vector<Sample>& samples);

}  // namespace jourdain::compare
