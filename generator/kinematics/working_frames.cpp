#include "kinematics/working_frames.hpp"

#include <fmt/format.h>

#include "kinematics/numbers.hpp"

namespace jourdain::kinematics {

WorkingFrames::WorkingFrames(const LinkTree& tree, const std::vector<Ex>& y, Statements& statements)
    : tree_(tree), statements_(statements) {
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    const Link& link = tree.links[i];
    const Ex previous = link.parallel ? angle_[link.parent] : Ex(0);
    const Ex turned = link.revolute ? Ex(link.sign * y[i]) : Ex(0);
    angle_.push_back(statements.bind(fmt::format("angle{}", i), previous + turned));
    if (!link.revolute && link.parallel) {
      cosine_.push_back(cosine_[link.parent]);
      sine_.push_back(sine_[link.parent]);
    } else if (!link.parallel && link.sign < 0) {
      cosine_.push_back(statements.bind(fmt::format("c{}", i), kinematics::cosine(-angle_[i])));
      sine_.push_back(-statements.bind(fmt::format("s{}", i), kinematics::sine(-angle_[i])));
    } else {
      cosine_.push_back(statements.bind(fmt::format("c{}", i), kinematics::cosine(angle_[i])));
      sine_.push_back(statements.bind(fmt::format("s{}", i), kinematics::sine(angle_[i])));
    }
    const std::string name = fmt::format("r{}", i);
    Vector3 offset = link.parallel ? to_working(link.parent, link.r_PL, name) : link.r_PL;
    if (!link.revolute) {
      const Ex travel = link.sign * y[i];
      for (std::size_t k = 0; k < 3; ++k) offset[k] = offset[k] + link.R_PL[k][2] * travel;
    }
    offset_.push_back(statements.bind(name, offset));
  }
}

Vector3 WorkingFrames::to_working(std::size_t link, const Vector3& v, const std::string& name) const {
  const Ex &c = cosine_[link], &s = sine_[link];
  return statements_.bind(name, Vector3{c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]});
}

Vector3 WorkingFrames::to_link(std::size_t link, const Vector3& v, const std::string& name) const {
  const Ex &c = cosine_[link], &s = sine_[link];
  return statements_.bind(name, Vector3{c * v[0] + s * v[1], c * v[1] - s * v[0], v[2]});
}

Vector3 WorkingFrames::from_parent(std::size_t link, const Vector3& v, const std::string& name) const {
  const Link& to = tree_.links[link];
  if (to.parallel) return v;
  const Vector3 v_P = to.parent == kGround ? v : to_link(to.parent, v, name + "p");
  return statements_.bind(name, transpose(to.R_PL) * v_P);
}

}  // namespace jourdain::kinematics
