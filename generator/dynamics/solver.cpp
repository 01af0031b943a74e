#include "dynamics/solver.hpp"

#include <fmt/format.h>

#include <utility>

#include "dynamics/absolute_rates.hpp"
#include "dynamics/articulated.hpp"
#include "dynamics/energy.hpp"
#include "dynamics/wrenches.hpp"
#include "support/check.hpp"

namespace jourdain::dynamics {

using kinematics::kGround;
using kinematics::Link;

namespace {

/// One velocity on its way through the elimination.
struct Row {
  std::size_t link = 0, column = 0;
  std::size_t head = kGround;       ///< articulated link that its momentum G acts on
  std::vector<std::size_t> inward;  ///< entries between it and the head
  Wrench G;                         ///< on the head, in W of the head
  Ex inverse_D, u;                  ///< right-hand side after elimination of what is outward
  Wrench share;                     ///< G (or U) / D
};

/// Whether x are accelerations of joints, or those of links where the scene moves in planes.
enum class Basis { kJoints, kLinks };

class Solver {
 public:
  Solver(const Scene& scene, const ArticulatedLinks& articulated, const std::vector<Ex>& b, Basis basis)
      : scene_(scene),
        basis_(basis),
        statements_(scene.statements),
        articulated_(articulated),
        count_(b.size()),
        rows_(count_),
        H_(count_, std::vector<Ex>(count_, 0)),
        L_(H_),
        inertias_(scene.frames),
        forces_(scene.frames),
        x_(count_) {
    for (std::size_t k = 0; k < count_; ++k) rows_[k].u = b[k];
  }

  std::vector<Ex> solve() {
    rigid_ = derive_composites(scene_.tree, scene_.frames, statements_, [this](std::size_t i) {
      return articulated_[i] ? Joins::kNot : is_carried_along(i) ? Joins::kMass : Joins::kRigid;
    });
    for (std::size_t i = 0; i < scene_.link_count(); ++i) set_rows(i);
    if (basis_ == Basis::kLinks)
      add_planar_rotors(scene_, H_);
    else
      add_rotors();
    return eliminated();
  }

  /// M given, in lower triangle.
  std::vector<Ex> solve(std::vector<std::vector<Ex>> M) {
    H_ = std::move(M);
    for (std::size_t i = 0; i < scene_.link_count(); ++i)
      for (std::size_t j = scene_.tree.links[i].parent; j != kGround; j = scene_.tree.links[j].parent)
        rows_[*scene_.states[i].entry].inward.push_back(*scene_.states[j].entry);
    return eliminated();
  }

 private:
  std::vector<Ex> eliminated() {
    for (std::size_t i = scene_.link_count(); i-- > 0;)
      if (articulated_[i])
        give_way(i);
      else
        for (std::size_t c = scene_.columns[i].size(); c-- > 0;)
          if (scene_.columns[i][c].entry) eliminate(*scene_.columns[i][c].entry);
    accelerations_.resize(scene_.link_count());
    for (std::size_t i = 0; i < scene_.link_count(); ++i)
      if (articulated_[i])
        accelerate(i);
      else
        for (const Column& column : scene_.columns[i])
          if (column.entry) substitute(*column.entry);
    return x_;
  }

  std::string named(const char* quantity, std::size_t i, std::size_t j) const {
    return fmt::format("{}{}_{}", quantity, i, j);
  }

  /// Moved, but not turned, by its parent.
  bool is_carried_along(std::size_t i) const {
    return basis_ == Basis::kLinks && scene_.tree.turns_beside_parent(i);
  }

  /// Entries of M among the columns of a bundle, and their momenta on its head.
  void set_rows(std::size_t i) {
    for (std::size_t c = 0; c < scene_.columns[i].size(); ++c) {
      const Column& column = scene_.columns[i][c];
      if (!column.entry) continue;
      Row& row = rows_[*column.entry];
      row.link = i;
      row.column = c;
      if (articulated_[i]) continue;
      Wrench moving = bound(scene_, named("p", i, *column.entry), momentum(rigid_[i], column.twist));
      std::size_t j = i;
      for (; j != kGround && !articulated_[j]; j = scene_.tree.links[j].parent) {
        for (std::size_t d = scene_.columns[j].size(); d-- > 0;) {
          const auto entry = scene_.columns[j][d].entry;
          if (!entry || *entry > *column.entry) continue;
          H_[*column.entry][*entry] =
              statements_.bind(named("M", *entry, *column.entry), power(moving, scene_.columns[j][d].twist));
          if (*entry < *column.entry) row.inward.push_back(*entry);
        }
        if (is_carried_along(j)) moving.moment = kinematics::zero_vector();
        if (scene_.tree.links[j].parent != kGround)
          moving = to_parent(scene_, j, moving, named("p", *column.entry, j));
      }
      row.head = j;
      if (j != kGround) row.G = moving;
    }
  }

  void add_rotors() {
    for (const model::Actuator& actuator : scene_.mechanism.actuators) {
      if (actuator.rotor_inertia.is_zero()) continue;
      const std::size_t e = *scene_.states[scene_.link_of(actuator.joint, actuator.coordinate)].entry;
      H_[e][e] = statements_.bind(named("Mr", e, e), H_[e][e] + reflected_inertia(scene_, actuator));
    }
  }

  /// Takes row k out of the rows inward of it and out of its head's inertia.
  void eliminate(std::size_t k) {
    Row& row = rows_[k];
    row.inverse_D = statements_.bind(fmt::format("invD_{}", k), 1 / H_[k][k]);
    for (std::size_t at = 0; at < row.inward.size(); ++at) {
      const std::size_t i = row.inward[at];
      if (H_[k][i].is_zero()) continue;
      L_[k][i] = statements_.bind(named("L_", k, i), H_[k][i] * row.inverse_D);
      for (std::size_t next = at; next < row.inward.size(); ++next) {
        const std::size_t j = row.inward[next];
        H_[i][j] = statements_.bind(fmt::format("H{}_{}_{}", k, i, j), H_[i][j] - L_[k][i] * H_[k][j]);
      }
      rows_[i].G = bound(scene_, named("G", k, i), rows_[i].G + -L_[k][i] * row.G);
    }
    for (const std::size_t i : row.inward)
      rows_[i].u = statements_.bind(named("u", k, i), rows_[i].u - L_[k][i] * row.u);
    if (row.head == kGround) return;
    row.share = bound(scene_, fmt::format("GD{}", k), row.inverse_D * row.G);
    ArticulatedInertia& inertia = inertias_.in_W[row.head];
    inertia = reduced(inertia, row.G, row.share, fmt::format("I{}_{}", row.head, k), statements_);
    Wrench& force = forces_.in_W[row.head];
    force = bound(scene_, fmt::format("f{}_{}", row.head, k), force + row.u * row.share);
  }

  /// Eliminates the joint of an articulated link and hands what is left of its inertia and force to its parent.
  void give_way(std::size_t i) {
    const Link& link = scene_.tree.links[i];
    const std::string name = fmt::format("I{}", i);
    ArticulatedInertia inertia = sum(rigid_inertia(rigid_[i]), inertias_.in_W[i], name + "r", statements_);
    inertia = sum(inertia,
                  turned_to_working(inertias_.in_L[i], scene_.frames.cosine(i), scene_.frames.sine(i),
                                    name + "w", statements_),
                  name + "s", statements_);
    Wrench force = gather(scene_, i, forces_, {name + "ff", name + "fn"}, {name + "f", name + "n"});
    for (std::size_t c = scene_.columns[i].size(); c-- > 0;) {
      const Column& column = scene_.columns[i][c];
      if (!column.entry) continue;
      Row& row = rows_[*column.entry];
      const std::string step = named("U", i, c);
      row.G = bound(scene_, step, product(inertia, column.twist));
      const Ex D =
          statements_.bind(step + "D", power(row.G, column.twist) + H_[*column.entry][*column.entry]);
      row.inverse_D = statements_.bind(step + "i", 1 / D);
      row.share = bound(scene_, step + "s", row.inverse_D * row.G);
      row.u = statements_.bind(step + "u", row.u - power(force, column.twist));
      if (link.parent == kGround && c == 0) break;
      const bool rotor = !H_[*column.entry][*column.entry].is_zero();
      inertia = rotor ? reduced(inertia, row.G, row.share, step + "I", statements_)
                      : dynamics::give_way(inertia, row.G, row.share, column.twist, step + "I", statements_);
      force = bound(scene_, step + "f", force + row.u * row.share);
    }
    if (link.parent == kGround) return;
    ArticulatedInertia& target = inertias_.joined_by(i, scene_.frames);
    target = sum(target, moved_to_parent(scene_.frames, i, inertia, name + "p", statements_), name + "c",
                 statements_);
    const std::string hand = fmt::format("hand{}", i);
    hand_inward(scene_, i, force, {hand + "f", hand + "n"}, {hand + "Rf", hand + "Rn"}, forces_);
  }

  /// Acceleration of an articulated link: its parent's field at its origin, then column by column.
  void accelerate(std::size_t i) {
    const Link& link = scene_.tree.links[i];
    const std::string name = fmt::format("acc{}", i);
    Twist& twist = accelerations_[i];
    if (link.parent != kGround) twist = from_parent(i, name);
    for (std::size_t c = 0; c < scene_.columns[i].size(); ++c) {
      const Column& column = scene_.columns[i][c];
      if (!column.entry) continue;
      const Row& row = rows_[*column.entry];
      const Ex own = statements_.bind(name + "u", row.inverse_D * row.u);
      x_[*column.entry] =
          statements_.bind(fmt::format("zdot_{}", *column.entry), own - power(row.share, twist));
      twist.angular =
          statements_.bind(named("al", i, c), twist.angular + x_[*column.entry] * column.twist.angular);
      twist.linear =
          statements_.bind(named("ac", i, c), twist.linear + x_[*column.entry] * column.twist.linear);
    }
  }

  Twist from_parent(std::size_t i, const std::string& name) {
    const kinematics::WorkingFrames& frames = scene_.frames;
    const Twist& outer = accelerations_[scene_.tree.links[i].parent];
    const Vector3 alpha_C = frames.from_parent_to_C(i, outer.angular, name + "al");
    const Vector3 a_C = frames.from_parent_to_C(i, outer.linear, name + "a");
    const Vector3 at_origin = statements_.bind(name + "o", a_C + kinematics::cross(alpha_C, frames.r_CW(i)));
    const Vector3 alpha = frames.from_C_to_W(i, alpha_C, name + "W");
    return {alpha, frames.from_C_to_W(i, at_origin, name + "w")};
  }

  void substitute(std::size_t k) {
    const Row& row = rows_[k];
    Ex sum = statements_.bind(fmt::format("y_{}", k), row.inverse_D * row.u);
    if (row.head != kGround)
      sum = statements_.bind(fmt::format("yh_{}", k), sum - power(row.share, accelerations_[row.head]));
    for (const std::size_t i : row.inward) sum = sum - L_[k][i] * x_[i];
    x_[k] = statements_.bind(fmt::format("zdot_{}", k), sum);
  }

  const Scene& scene_;
  Basis basis_;
  kinematics::Statements& statements_;
  const ArticulatedLinks& articulated_;
  std::size_t count_;
  std::vector<Row> rows_;               // by entry of z
  std::vector<std::vector<Ex>> H_, L_;  // lower triangle: remainder of M within bundles, and its factor
  std::vector<CompositeBody> rigid_;    // bundles, without what is outward of articulated links
  kinematics::InwardSums<ArticulatedInertia> inertias_;  // from outward
  WrenchSums forces_;
  std::vector<Twist> accelerations_;
  std::vector<Ex> x_;
};

}  // namespace

std::vector<Ex> solve_accelerations(const Scene& scene, const ArticulatedLinks& articulated,
                                    const std::vector<Ex>& b) {
  return Solver(scene, articulated, b, Basis::kJoints).solve();
}

std::vector<Ex> solve_planar_accelerations(const Scene& scene, const std::vector<Ex>& u) {
  const ArticulatedLinks none(scene.link_count(), false);
  return joint_rates_of(scene, Solver(scene, none, u, Basis::kLinks).solve());
}

std::vector<Ex> solve_given(const Scene& scene, std::vector<std::vector<Ex>> M, const std::vector<Ex>& b) {
  const ArticulatedLinks none(scene.link_count(), false);
  return Solver(scene, none, b, Basis::kLinks).solve(std::move(M));
}

}  // namespace jourdain::dynamics
