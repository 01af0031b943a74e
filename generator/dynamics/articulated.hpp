// Articulated bodies: what a link with everything outward of it resists, when the joints outward are free to give way.
#pragma once

#include <string>

#include "dynamics/composite.hpp"

namespace jourdain::dynamics {

using kinematics::Matrix3;

/// Symmetric 6 × 6 inertia about the origin of a link, in its working frame:
/// force = A a + H α, moment about the origin = Hᵀ a + J α.
struct ArticulatedInertia {
  Matrix3 A = kinematics::zero_matrix();
  Matrix3 H = kinematics::zero_matrix();
  Matrix3 J = kinematics::zero_matrix();
};

ArticulatedInertia rigid_inertia(const CompositeBody& body);

ArticulatedInertia sum(const ArticulatedInertia& a, const ArticulatedInertia& b, const std::string& name,
                       kinematics::Statements& statements);

/// Wrench that the acceleration `twist` needs.
Wrench product(const ArticulatedInertia& inertia, const Twist& twist);

/// inertia − U Uᵀ/D for U = inertia · twist and D = twist · U, with `share` = U/D. Where the twist that gives
/// way is along one axis, its row becomes exactly 0.
ArticulatedInertia give_way(const ArticulatedInertia& inertia, const Wrench& U, const Wrench& share,
                            const Twist& twist, const std::string& name, kinematics::Statements& statements);

/// inertia − G Gᵀ/D with `share` = G/D: for the momentum G of a joint further out, or with a rotor's inertia in D.
ArticulatedInertia reduced(const ArticulatedInertia& inertia, const Wrench& G, const Wrench& share,
                           const std::string& name, kinematics::Statements& statements);

/// The inertia of link i seen from its parent's origin, in C.
ArticulatedInertia moved_to_parent(const kinematics::WorkingFrames& frames, std::size_t i,
                                   const ArticulatedInertia& inertia, const std::string& name,
                                   kinematics::Statements& statements);

/// From link axes to the working frame: turned about z by the angle with cosine c and sine s.
ArticulatedInertia turned_to_working(const ArticulatedInertia& inertia, const Ex& c, const Ex& s,
                                     const std::string& name, kinematics::Statements& statements);

}  // namespace jourdain::dynamics
