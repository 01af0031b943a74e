// The descriptor form on random chains of every type of joint, against principles that it does not use.
#include <gtest/gtest.h>

#include <cmath>

#include "joint_chains.hpp"
#include "reference/descriptor.hpp"

namespace jourdain::reference {
namespace {

using Long = long double;
using VectorL = Eigen::VectorX<Long>;
using Vector3L = Vector3<Long>;
using model::JointType;

constexpr std::uint64_t kChains = 60;  // each type six times in second place
constexpr double kDifferences =
    1e-10;                           // differences of order 6 in long double: 1e-13 times numbers up to 1e3
constexpr double kRounding = 1e-14;  // long double, condition numbers up to 1e4

/// Derivative of `f` at 0 by central differences of order 6, step 1e-3.
template <class F>
auto derivative(F f) {
  const Long h = 1e-3L;
  using Value = decltype(f(h));
  return Value((Value(f(h) - f(-h)) * 45 - Value(f(2 * h) - f(-2 * h)) * 9 + Value(f(3 * h) - f(-3 * h))) /
               (60 * h));
}

/// A random chain with its state and solution.
struct Case {
  explicit Case(std::uint64_t seed, bool prescribed = true)
      : mechanism(tests::random_chain(seed, prescribed)),
        reference(mechanism),
        state(tests::random_chain_state(reference.layout(), seed)),
        solution(reference.solve(state.t, state.y, state.z, state.u)),
        bodies(reference.absolute_state(state.t, state.y, state.z)),
        ydot(tests::position_rates(mechanism, reference.layout(), state)) {}

  /// Positions and velocities of all bodies at time t + h along the motion that the solution predicts, v_C and ω of
  /// each; correct in its first derivative at h = 0.
  VectorL velocities(Long h) const {
    return stacked(reference.absolute_state(state.t + h, state.y + h * ydot, state.z + h * solution.zdot));
  }
  static VectorL stacked(const std::vector<AbsoluteBody<Long>>& motions) {
    VectorL result(6 * Eigen::Index(motions.size()));
    for (std::size_t i = 0; i < motions.size(); ++i)
      result.segment<6>(6 * Eigen::Index(i)) << motions[i].v_C, motions[i].omega;
    return result;
  }

  Long mass(std::size_t body) const { return mechanism.bodies[body].mass.constant(); }
  Vector3L gravity() const {
    return {mechanism.gravity[0].constant(), mechanism.gravity[1].constant(),
            mechanism.gravity[2].constant()};
  }
  Vector3L p_BC(std::size_t body) const {
    const auto& c = mechanism.bodies[body].center_of_mass;
    return {c[0].constant(), c[1].constant(), c[2].constant()};
  }
  /// Moments of inertia about the body's axes through the centre of mass.
  Vector3L inertia(std::size_t body) const {
    const auto& I = mechanism.bodies[body].inertia;
    return {I.xx.constant(), I.yy.constant(), I.zz.constant()};
  }
  /// m a − m g (inertial frame) and I ω̇ + ω × I ω (body-fixed components) of a body.
  Eigen::Vector<Long, 6> balance(std::size_t body) const {
    const Vector3L I = inertia(body), omega = bodies[body].omega;
    Eigen::Vector<Long, 6> rows;
    rows << mass(body) * (solution.bodies[body].a_C - gravity()),
        I.cwiseProduct(solution.bodies[body].omega_dot) + omega.cross(I.cwiseProduct(omega));
    return rows;
  }

  model::Mechanism mechanism;
  DescriptorReference<Long> reference;
  tests::ChainState state;
  DescriptorSolution<Long> solution;
  std::vector<AbsoluteBody<Long>> bodies;
  VectorL ydot;
};

/// Force on a free scalar coordinate as the model's comments state it; each coordinate has one actuator, in order.
Long coordinate_force(const Case& chain, const model::Coordinate& coordinate, std::size_t actuator, Long y,
                      Long z) {
  const Long speed = coordinate.friction_speed.constant();
  return -coordinate.stiffness.constant() * (y - coordinate.rest.constant()) -
         coordinate.damping.constant() * z -
         coordinate.friction.constant() * z / std::sqrt(z * z + speed * speed) +
         chain.mechanism.actuators[actuator].gear_ratio.constant() * chain.state.u[Eigen::Index(actuator)];
}

/// Generalized forces beyond gravity minus rotor terms, in z.
VectorL joint_efforts(const Case& chain) {
  VectorL efforts = VectorL::Zero(chain.state.z.size());
  std::size_t actuator = 0;
  for (std::size_t j = 0; j < chain.mechanism.joints.size(); ++j) {
    const model::Joint& joint = chain.mechanism.joints[j];
    const model::JointEntries& entries = chain.reference.layout().joints[j];
    if (joint.type == JointType::kSpherical) {
      const auto first = Eigen::Index(entries.first_velocity);
      efforts.segment<3>(first) -= joint.spin_damping.constant() * chain.state.z.segment<3>(first);
    }
    for (std::size_t i = 0; i < joint.coordinates.size(); ++i, ++actuator) {
      if (!entries.velocity[i]) continue;
      const auto z = Eigen::Index(*entries.velocity[i]);
      const Long gear = chain.mechanism.actuators[actuator].gear_ratio.constant();
      const Long rotor = chain.mechanism.actuators[actuator].rotor_inertia.constant();
      efforts[z] += coordinate_force(chain, joint.coordinates[i], actuator,
                                     chain.state.y[Eigen::Index(*entries.position[i])], chain.state.z[z]) -
                    gear * gear * rotor * chain.solution.zdot[z];
    }
  }
  return efforts;
}

TEST(DescriptorChains, ConsistentStatesKeepAllConstraints) {
  for (std::uint64_t seed = 0; seed < kChains; ++seed) {
    const Case chain(seed);
    EXPECT_EQ(chain.solution.rank, chain.solution.size) << seed;
    EXPECT_LE(chain.solution.g.lpNorm<Eigen::Infinity>(), kRounding) << seed;
    EXPECT_LE(chain.solution.g_rate.lpNorm<Eigen::Infinity>(), kRounding) << seed;
  }
}

// The bodies' accelerations and ż belong to one motion: differentiate the bodies' velocities along it.
TEST(DescriptorChains, AccelerationsAreTheDerivativesOfVelocities) {
  for (std::uint64_t seed = 0; seed < kChains; ++seed) {
    const Case chain(seed);
    const VectorL rates = derivative([&](Long h) { return chain.velocities(h); });
    for (std::size_t b = 0; b < chain.bodies.size(); ++b) {
      const BodyAcceleration<Long>& body = chain.solution.bodies[b];
      const Vector3L a_C = rates.segment<3>(6 * Eigen::Index(b)),
                     omega_dot = rates.segment<3>(6 * Eigen::Index(b) + 3);
      EXPECT_LE((body.a_C - a_C).norm(), kDifferences) << seed << " body " << b;
      EXPECT_LE((body.omega_dot - omega_dot).norm(), kDifferences) << seed << " body " << b;
      const Vector3L a_O = derivative([&](Long h) {
        const auto motion = chain.reference.absolute_state(chain.state.t + h, chain.state.y + h * chain.ydot,
                                                           chain.state.z + h * chain.solution.zdot)[b];
        return Vector3L(motion.v_C - motion.orientation * motion.omega.cross(chain.p_BC(b)));
      });
      EXPECT_LE((body.a_O - a_O).norm(), kDifferences) << seed << " body " << b;
    }
  }
}

// Σ ∂v/∂z · (m a − f) + ∂ω/∂z · (I ω̇ + ω × I ω − ℓ) = 0 with partial velocities that no constraint enters.
TEST(DescriptorChains, JourdainsPrincipleHolds) {
  for (std::uint64_t seed = 0; seed < kChains; ++seed) {
    const Case chain(seed);
    const VectorL efforts = joint_efforts(chain);
    const VectorL actual = chain.velocities(0);
    for (Eigen::Index k = 0; k < chain.state.z.size(); ++k) {
      const VectorL partial =
          Case::stacked(chain.reference.absolute_state(chain.state.t, chain.state.y,
                                                       chain.state.z + VectorL::Unit(efforts.size(), k))) -
          actual;
      Long power = -efforts[k], scale = std::abs(power) + 1;
      for (std::size_t b = 0; b < chain.bodies.size(); ++b) {
        const Long share = partial.segment<6>(6 * Eigen::Index(b)).dot(chain.balance(b));
        power += share;
        scale += std::abs(share);
      }
      EXPECT_LE(std::abs(power), kRounding * scale) << seed << " row " << k;
    }
  }
}

// Newton and Euler for each body, about its origin: what its joint transmits, less what its child's joint does.
TEST(DescriptorChains, ReactionsBalanceEachBody) {
  for (std::uint64_t seed = 0; seed < kChains; ++seed) {
    const Case chain(seed);
    const auto total = [&](std::size_t j) {
      const JointWrench<Long>& reaction = chain.solution.reactions[j];
      const JointWrench<Long>& rotor = chain.solution.rotor_wrenches[j];
      return JointWrench<Long>{reaction.force + rotor.force, reaction.moment + rotor.moment};
    };
    const auto origin = [&](std::size_t b) {
      return Vector3L(chain.bodies[b].p_WC - chain.bodies[b].orientation * chain.p_BC(b));
    };
    for (std::size_t b = 0; b < chain.bodies.size(); ++b) {
      const Eigen::Quaternion<Long> R_WB = chain.bodies[b].orientation;
      const Eigen::Vector<Long, 6> rows = chain.balance(b);
      Vector3L force = R_WB * total(b).force - rows.head<3>();
      Vector3L moment = R_WB * total(b).moment - R_WB * rows.tail<3>() -
                        (R_WB * chain.p_BC(b)).cross(Vector3L(rows.head<3>()));
      if (b + 1 < chain.bodies.size()) {
        const Eigen::Quaternion<Long> R_WD = chain.bodies[b + 1].orientation;
        const Vector3L passed_on = R_WD * total(b + 1).force;
        force -= passed_on;
        moment -= R_WD * total(b + 1).moment + (origin(b + 1) - origin(b)).cross(passed_on);
      }
      const Long scale = 1 + total(b).force.norm() + total(b).moment.norm();
      EXPECT_LE(force.norm(), kRounding * scale) << seed << " body " << b;
      EXPECT_LE(moment.norm(), kRounding * scale) << seed << " body " << b;
    }
  }
}

TEST(DescriptorChains, GroundReactionsAndWeightAccelerateTheCentreOfMass) {
  for (std::uint64_t seed = 0; seed < kChains; ++seed) {
    const Case chain(seed);
    Vector3L force = chain.bodies[0].orientation *
                     (chain.solution.reactions[0].force + chain.solution.rotor_wrenches[0].force);
    for (std::size_t b = 0; b < chain.bodies.size(); ++b)
      force -= chain.mass(b) * (chain.solution.bodies[b].a_C - chain.gravity());
    EXPECT_LE(force.norm(), kRounding * (1 + chain.solution.reactions[0].force.norm())) << seed;
  }
}

/// The value of a motion and its two derivatives.
descriptor::TimeJet<Long> motion_at(const model::Expression& motion, Long t) {
  using T = descriptor::TimeJet<Long>;
  return motion.evaluate<T>(
      {}, [](double value) { return T(value); }, [&](const model::Variable&) { return T(t, 1, 0); });
}

/// Coordinates of `chain` without prescribed motions: where the motions put them, driven by the forces that it found.
struct Released {
  explicit Released(const Case& chain) : mechanism(chain.mechanism) {
    for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
      for (std::size_t i = 0; i < mechanism.joints[j].coordinates.size(); ++i) {
        if (!mechanism.joints[j].coordinates[i].motion) continue;
        mechanism.joints[j].coordinates[i].motion.reset();
        mechanism.coordinate_forces.push_back({.name = "drive",
                                               .joint = model::JointIndex(j),
                                               .coordinate = i,
                                               .force = double(*chain.solution.drives[j][i])});
      }
    layout = model::lay_out_coordinates(mechanism);
    state = {.t = chain.state.t,
             .y = VectorL(Eigen::Index(layout.position_count())),
             .z = VectorL(Eigen::Index(layout.velocity_count())),
             .u = chain.state.u};
    zdot = state.z;
    for (std::size_t j = 0; j < mechanism.joints.size(); ++j) {
      const model::JointEntries& from = chain.reference.layout().joints[j];
      const model::JointEntries& to = layout.joints[j];
      const auto& coordinates = chain.mechanism.joints[j].coordinates;
      for (std::size_t i = 0; i < coordinates.size(); ++i) {
        const auto y = Eigen::Index(*to.position[i]), z = Eigen::Index(*to.velocity[i]);
        const descriptor::TimeJet<Long> jet =
            coordinates[i].motion
                ? motion_at(*coordinates[i].motion, state.t)
                : descriptor::TimeJet<Long>(chain.state.y[Eigen::Index(*from.position[i])],
                                            chain.state.z[Eigen::Index(*from.velocity[i])],
                                            chain.solution.zdot[Eigen::Index(*from.velocity[i])]);
        state.y[y] = jet.value;
        state.z[z] = jet.rate;
        zdot[z] = jet.acceleration;
      }
      if (!coordinates.empty()) continue;
      const auto copy = [](VectorL& target, std::size_t at, const VectorL& source, std::size_t first,
                           std::size_t count) {
        target.segment(Eigen::Index(at), Eigen::Index(count)) =
            source.segment(Eigen::Index(first), Eigen::Index(count));
      };
      copy(state.y, to.first_position, chain.state.y, from.first_position, from.position_count);
      copy(state.z, to.first_velocity, chain.state.z, from.first_velocity, from.velocity_count);
      copy(zdot, to.first_velocity, chain.solution.zdot, from.first_velocity, from.velocity_count);
    }
  }

  model::Mechanism mechanism;
  model::CoordinateLayout layout;
  tests::ChainState state;
  VectorL zdot;  ///< expected
};

TEST(DescriptorChains, DrivesMakeReleasedCoordinatesFollowTheirMotion) {
  const Long tolerance = 1e-12L;  // the drive passes through a double
  for (std::uint64_t seed = 0; seed < kChains; ++seed) {
    const Released released((Case(seed)));
    const auto& [t, y, z, u] = released.state;
    const VectorL zdot = DescriptorReference<Long>(released.mechanism).solve(t, y, z, u).zdot;
    EXPECT_LE((zdot - released.zdot).norm(), tolerance * (1 + zdot.norm())) << seed;
  }
}

TEST(DescriptorChains, BothFormsOfParallelAxesAgree) {
  const double tolerance = 1e-12;
  const model::Mechanism mechanism =
      tests::random_chain({JointType::kSpherical, JointType::kRevolute, JointType::kScrew,
                           JointType::kRevolute, JointType::kPlanar, JointType::kCylindrical},
                          7);
  const DescriptorReference<Long> normals(mechanism);
  const DescriptorReference<Long> products(mechanism, {.parallel_axes = ParallelAxes::kCrossProduct});
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const auto [t, y, z, u] = tests::random_chain_state(normals.layout(), seed);
    const DescriptorSolution<Long> a = normals.solve(t, y, z, u), b = products.solve(t, y, z, u);
    EXPECT_EQ(b.rank, b.size) << seed;
    EXPECT_LE((a.zdot - b.zdot).norm(), tolerance * (1 + a.zdot.norm())) << seed;
    for (std::size_t j = 0; j < a.reactions.size(); ++j) {
      const Long scale = tolerance * (1 + a.reactions[j].force.norm() + a.reactions[j].moment.norm());
      EXPECT_LE((a.reactions[j].force - b.reactions[j].force).norm(), scale) << seed;
      EXPECT_LE((a.reactions[j].moment - b.reactions[j].moment).norm(), scale) << seed;
    }
  }
}

}  // namespace
}  // namespace jourdain::reference
