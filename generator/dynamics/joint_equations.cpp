#include "dynamics/joint_equations.hpp"

#include <fmt/format.h>

#include <map>

#include "dynamics/energy.hpp"
#include "dynamics/solver.hpp"

namespace jourdain::dynamics {

using kinematics::kGround;
using kinematics::Link;

namespace {

std::string named(const std::string& quantity, std::size_t i) { return fmt::format("{}{}", quantity, i); }
std::string named(const std::string& quantity, std::size_t j, std::size_t i) {
  return fmt::format("{}{}_{}", quantity, j, i);
}

/// Links beside link i, outward: their rates are those of link i and of their joints.
std::vector<std::size_t> links_beside(const Scene& scene, std::size_t i) {
  std::vector<std::size_t> result;
  for (std::size_t c = i + 1; c < scene.link_count(); ++c)
    if (scene.tree.links[c].parent == i && scene.tree.turns_beside_parent(c)) result.push_back(c);
  return result;
}

}  // namespace

std::vector<Ex> joint_forces(const Scene& scene, const std::vector<Ex>& f, const std::string& name) {
  std::vector<Ex> sum = f, result(f.size());
  for (std::size_t i = f.size(); i-- > 0;) {
    for (const std::size_t c : links_beside(scene, i))
      sum[i] = scene.statements.bind(named(name + "s", c), sum[i] + sum[c]);
    result[*scene.states[i].entry] = scene.tree.links[i].sign * sum[i];
  }
  return result;
}

namespace {

/// What couples a link with all beside it outward to the links inward of it, and that composite's own inertia.
class JointMasses {
 public:
  JointMasses(const Scene& scene, const LinkEquations& equations)
      : scene_(scene), M_(equations.M), result_(M_.size(), std::vector<Ex>(M_.size(), 0)) {}

  std::vector<std::vector<Ex>> derive() {
    for (std::size_t j = M_.size(); j-- > 0;) add(j);
    return std::move(result_);
  }

 private:
  void add(std::size_t j) {
    Ex own = M_[j][j];
    for (const std::size_t c : links_beside(scene_, j)) {
      for (std::size_t i = scene_.tree.links[j].parent; i != kGround; i = scene_.tree.links[i].parent)
        M_[j][i] = scene_.statements.bind(named("lMc", j, i), M_[j][i] + M_[c][i]);
      own = scene_.statements.bind(named("lJj", c), own + (seen_[c] + M_[c][j]));
    }
    set(j, j, own);
    Ex with = own;
    std::size_t i = scene_.tree.links[j].parent;
    for (std::size_t k = j; i != kGround; k = i, i = scene_.tree.links[i].parent) {
      const bool beside = scene_.tree.turns_beside_parent(k) && scene_.turns(i);
      with = beside ? scene_.statements.bind(named("lMj", j, i), with + M_[j][i]) : M_[j][i];
      set(j, i, with);
      if (k == j) seen_[j] = with;
    }
  }

  void set(std::size_t j, std::size_t i, const Ex& value) {
    const int sign = scene_.tree.links[j].sign * scene_.tree.links[i].sign;
    const std::size_t row = *scene_.states[j].entry, column = *scene_.states[i].entry;
    result_[row][column] = result_[column][row] = sign * value;
  }

  const Scene& scene_;
  std::vector<std::vector<Ex>> M_, result_;
  std::map<std::size_t, Ex> seen_;  ///< entries of joint and parent
};

}  // namespace

std::vector<std::vector<Ex>> joint_mass_matrix(const Scene& scene, const LinkEquations& equations) {
  return JointMasses(scene, equations).derive();
}

std::vector<Ex> link_loads(const Scene& scene, const std::vector<Wrench>& on_link) {
  std::vector<Vector3> force(on_link.size());
  std::vector<Ex> moment(on_link.size()), result(on_link.size());
  for (std::size_t i = 0; i < on_link.size(); ++i) {
    force[i] = on_link[i].force;
    moment[i] = on_link[i].moment[2];
  }
  for (std::size_t i = on_link.size(); i-- > 0;) {
    const Link& link = scene.tree.links[i];
    result[i] = scene.turns(i) ? moment[i] : dot(force[i], scene.frames.direction(i));
    if (link.parent == kGround) continue;
    const Vector3 push = scene.frames.to_parent(i, force[i], named("lfp", i));
    force[link.parent] = scene.statements.bind(named("lf", i), force[link.parent] + push);
    if (!scene.tree.turns_beside_parent(i)) continue;
    const Vector3& r = scene.frames.r_CW(i);
    moment[link.parent] =
        scene.statements.bind(named("ln", i), moment[link.parent] + (r[0] * push[1] - r[1] * push[0]));
  }
  return result;
}

namespace {

/// Forces of joints on links, those along z: that of a joint acts back on the parent.
Ex along(const Scene& scene, const AppliedForces& applied, std::size_t i) {
  Ex sum = scene.tree.links[i].sign * applied.along[i][0];
  for (const std::size_t c : links_beside(scene, i))
    sum = sum - scene.tree.links[c].sign * applied.along[c][0];
  return sum;
}

void add_rotors(const Scene& scene, LinkEquations& equations) {
  for (const model::Actuator& actuator : scene.mechanism.actuators) {
    if (actuator.rotor_inertia.is_zero()) continue;
    const std::size_t i = scene.link_of(actuator.joint, actuator.coordinate), p = scene.tree.links[i].parent;
    const Ex inertia =
        scene.statements.bind(named("lr", i), equations.scale[i] * reflected_inertia(scene, actuator));
    const auto add = [&](std::size_t row, std::size_t column, const Ex& value) {
      equations.M[row][column] =
          scene.statements.bind(named("lMr", row, column), equations.M[row][column] + value);
    };
    add(i, i, inertia);
    if (!scene.tree.turns_beside_parent(i)) continue;
    add(p, p, inertia);
    add(i, p, -inertia);
  }
}

std::vector<Ex> by_entries(const Scene& scene, const std::vector<Ex>& of_links) {
  std::vector<Ex> result(of_links.size());
  for (std::size_t i = 0; i < of_links.size(); ++i) result[*scene.states[i].entry] = of_links[i];
  return result;
}

std::vector<std::vector<Ex>> by_entries(const Scene& scene, const std::vector<std::vector<Ex>>& of_links) {
  std::vector<std::vector<Ex>> result(of_links.size());
  for (std::size_t i = 0; i < of_links.size(); ++i)
    result[*scene.states[i].entry] = by_entries(scene, of_links[i]);
  return result;
}

/// dz/dt from accelerations of links, by entries of z.
std::vector<Ex> from_link_accelerations(const Scene& scene, const std::vector<Ex>& x) {
  std::vector<Ex> zdot(x.size());
  for (std::size_t i = 0; i < scene.link_count(); ++i) {
    const std::size_t e = *scene.states[i].entry;
    Ex joint = x[e];
    if (scene.tree.turns_beside_parent(i)) joint = joint - x[*scene.states[scene.tree.links[i].parent].entry];
    zdot[e] = scene.statements.bind(fmt::format("zdotl_{}", e), scene.tree.links[i].sign * joint);
  }
  return zdot;
}

}  // namespace

std::vector<Ex> link_inverse_dynamics(const Scene& scene, const LinkEquations& equations,
                                      const AppliedForces& applied) {
  const std::size_t n = scene.link_count();
  std::vector<Ex> x, f(n, 0);
  const std::vector<Ex> loads = link_loads(scene, applied.on_link);
  for (std::size_t i = 0; i < n; ++i) {
    const Ex own = scene.tree.links[i].sign * scene.leaves.zdot[*scene.states[i].entry];
    x.push_back(scene.tree.turns_beside_parent(i)
                    ? scene.statements.bind(named("lx", i), x[scene.tree.links[i].parent] + own)
                    : own);
    for (std::size_t j = i; j != kGround; j = scene.tree.links[j].parent) {
      f[i] = f[i] + equations.M[i][j] * x[j];
      if (i != j) f[j] = f[j] + equations.M[i][j] * x[i];
    }
  }
  for (std::size_t i = 0; i < n; ++i)
    f[i] =
        scene.statements.bind(named("la", i), f[i] - (equations.inertia[i] + equations.weight[i] + loads[i]));
  std::vector<Ex> tau = joint_forces(scene, f, "la");
  for (std::size_t i = 0; i < n; ++i) {
    Ex& entry = tau[*scene.states[i].entry];
    entry = scene.statements.bind(named("ltau", i), entry - applied.along[i][0]);
  }
  return tau;
}

Ex link_kinetic_energy(const Scene& scene, const LinkEquations& equations) {
  std::vector<Ex> rates;
  for (std::size_t i = 0; i < scene.link_count(); ++i)
    rates.push_back(scene.turns(i) ? scene.omega.own[i][2] : scene.states[i].rate);
  Ex energy = 0;
  for (std::size_t j = 0; j < rates.size(); ++j) {
    const Ex half = scene.statements.bind(named("lTh", j), equations.M[j][j] / 2);
    Ex momentum = half * rates[j];
    for (std::size_t i = scene.tree.links[j].parent; i != kGround; i = scene.tree.links[i].parent)
      momentum = momentum + equations.M[j][i] * rates[i];
    energy = energy + scene.statements.bind(named("lp", j), momentum) * rates[j];
  }
  return with_rotor_energy(scene, scene.statements.bind("T", energy));
}

std::vector<Ex> solve_link_equations(const Scene& scene, LinkEquations equations,
                                     const AppliedForces& applied) {
  add_rotors(scene, equations);
  const std::vector<Ex> loads = link_loads(scene, applied.on_link);
  std::vector<Ex> f;
  for (std::size_t i = 0; i < scene.link_count(); ++i) {
    const Ex load = scene.statements.bind(named("ll", i), loads[i] + along(scene, applied, i));
    f.push_back(scene.statements.bind(
        named("lu", i), equations.inertia[i] + equations.weight[i] + equations.scale[i] * load));
  }
  return from_link_accelerations(scene,
                                 solve_given(scene, by_entries(scene, equations.M), by_entries(scene, f)));
}

}  // namespace jourdain::dynamics
