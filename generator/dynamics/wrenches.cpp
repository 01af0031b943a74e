#include "dynamics/wrenches.hpp"

#include <fmt/format.h>

namespace jourdain::dynamics {

using kinematics::cross;
using kinematics::kGround;

Wrench bound(const Scene& scene, const std::string& name, const Wrench& wrench) {
  return {scene.statements.bind(name + "f", wrench.force), scene.statements.bind(name + "n", wrench.moment)};
}

Wrench gather(const Scene& scene, std::size_t i, const WrenchSums& sums, const WrenchNames& names,
              const WrenchNames& parts) {
  const Wrench &in_W = sums.in_W[i], &in_L = sums.in_L[i];
  const Vector3 force =
      scene.statements.bind(names.force, in_W.force + scene.frames.to_working(i, in_L.force, parts.force));
  return {force, scene.statements.bind(names.moment,
                                       in_W.moment + scene.frames.to_working(i, in_L.moment, parts.moment))};
}

void hand_inward(const Scene& scene, std::size_t i, const Wrench& wrench, const WrenchNames& names,
                 const WrenchNames& turned, WrenchSums& sums) {
  const Vector3 f_C = scene.frames.from_W_to_C(i, wrench.force, turned.force);
  const Vector3 n_C = scene.frames.from_W_to_C(i, wrench.moment, turned.moment);
  Wrench& sum = sums.joined_by(i, scene.frames);
  sum.force = scene.statements.bind(names.force, sum.force + f_C);
  sum.moment = scene.statements.bind(names.moment, sum.moment + (n_C + cross(scene.frames.r_CW(i), f_C)));
}

std::vector<Wrench> accumulate_wrenches(const Scene& scene, const std::vector<Wrench>& own,
                                        const std::string& name) {
  WrenchSums sums(scene.frames);
  std::vector<Wrench> totals(own.size());
  for (std::size_t i = 0; i < own.size(); ++i) sums.in_W[i] = own[i];
  for (std::size_t i = own.size(); i-- > 0;) {
    const std::string f = fmt::format("{}f{}", name, i), n = fmt::format("{}n{}", name, i);
    totals[i] = gather(scene, i, sums, {f, n}, {f + "b", n + "b"});
    if (scene.frames.parent(i) == kGround) continue;
    hand_inward(scene, i, totals[i], {f + "c", n + "c"}, {f + "p", n + "p"}, sums);
  }
  return totals;
}

Wrench to_parent(const Scene& scene, std::size_t i, const Wrench& wrench, const std::string& name) {
  const Vector3 f_C = scene.frames.from_W_to_C(i, wrench.force, name + "f");
  const Vector3 lever = scene.statements.bind(name + "l", cross(scene.frames.r_CW(i), f_C));
  const Vector3 n_C = scene.statements.bind(name + "n", scene.frames.R_CW(i) * wrench.moment + lever);
  return {scene.frames.from_C_to_parent(i, f_C, name + "F"),
          scene.frames.from_C_to_parent(i, n_C, name + "N")};
}

}  // namespace jourdain::dynamics
