#include "dynamics/wrenches.hpp"

#include <fmt/format.h>

namespace jourdain::dynamics {

using kinematics::cross;
using kinematics::kGround;
using kinematics::Statements;
using kinematics::WorkingFrames;

Ex power(const Wrench& wrench, const Twist& twist) {
  return kinematics::dot(wrench.force, twist.linear) + kinematics::dot(wrench.moment, twist.angular);
}

Wrench gather(const WorkingFrames& frames, std::size_t i, const WrenchSums& sums, const WrenchNames& names,
              const WrenchNames& parts, Statements& statements) {
  const Wrench &in_W = sums.in_W(i), &in_L = sums.in_L(i);
  const Vector3 force =
      statements.bind(names.force, in_W.force + frames.to_working(i, in_L.force, parts.force));
  return {force,
          statements.bind(names.moment, in_W.moment + frames.to_working(i, in_L.moment, parts.moment))};
}

void hand_inward(const WorkingFrames& frames, std::size_t i, const Wrench& wrench, const WrenchNames& names,
                 const WrenchNames& turned, WrenchSums& sums, Statements& statements) {
  const Vector3 f_C = frames.from_W_to_C(i, wrench.force, turned.force);
  const Vector3 n_C = frames.from_W_to_C(i, wrench.moment, turned.moment);
  Wrench& sum = sums.joined_by(i);
  sum.force = statements.bind(names.force, sum.force + f_C);
  sum.moment = statements.bind(names.moment, sum.moment + (n_C + cross(frames.r_CW(i), f_C)));
}

std::vector<Wrench> accumulate_wrenches(const WorkingFrames& frames, const std::vector<Wrench>& own,
                                        const std::string& name, Statements& statements) {
  WrenchSums sums(frames);
  std::vector<Wrench> totals(own.size());
  for (std::size_t i = 0; i < own.size(); ++i) sums.in_W(i) = own[i];
  for (std::size_t i = own.size(); i-- > 0;) {
    const std::string f = fmt::format("{}f{}", name, i), n = fmt::format("{}n{}", name, i);
    totals[i] = gather(frames, i, sums, {f, n}, {f + "b", n + "b"}, statements);
    if (frames.parent(i) == kGround) continue;
    hand_inward(frames, i, totals[i], {f + "c", n + "c"}, {f + "p", n + "p"}, sums, statements);
  }
  return totals;
}

Wrench to_parent(const WorkingFrames& frames, std::size_t i, const Wrench& wrench, const std::string& name,
                 Statements& statements) {
  const Vector3 f_C = frames.from_W_to_C(i, wrench.force, name + "f");
  const Vector3 lever = statements.bind(name + "l", cross(frames.r_CW(i), f_C));
  const Vector3 n_C = statements.bind(name + "n", frames.R_CW(i) * wrench.moment + lever);
  return {frames.from_C_to_parent(i, f_C, name + "F"), frames.from_C_to_parent(i, n_C, name + "N")};
}

}  // namespace jourdain::dynamics
