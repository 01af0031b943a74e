#include "validate/loops/rays.hpp"

#include <algorithm>

#include "model/motion_sources.hpp"
#include "model/time_dependence.hpp"
#include "support/matrix_index.hpp"
#include "support/uniform.hpp"

namespace jourdain::validate {

namespace {

using support::at;

}  // namespace

std::vector<Ray> draw_rays(const loops::NumericClosure& closure, const loops::LoopPlan& plan,
                           const model::Mechanism& mechanism, std::size_t count) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  support::Uniform uniform(17);
  const auto fill = [&](std::vector<double>& list, std::size_t size, double largest) {
    for (std::size_t k = 0; k < size; ++k) list.push_back(uniform(-largest, largest));
  };
  loops::Configuration start;
  start.y = Eigen::Map<const Eigen::VectorXd>(plan.y.data(), at(plan.y.size())).cast<long double>();
  std::vector<Ray> rays;
  for (const loops::Configuration& configuration : walk(closure, start, mechanism, count)) {
    Ray& ray = rays.emplace_back();
    ray.configuration = configuration;
    loops::Vector z(at(layout.velocity_count()));
    for (long double& entry : z) entry = uniform(-2, 2);
    for (std::size_t k = layout.first_state(); k < plan.z.size(); ++k)
      z[at(k)] = plan.z[k] + z[at(k)] * mechanism.states[k - layout.first_state()].nominal.evaluate<double>(
                                            model::default_values(mechanism));
    if (model::motions_follow_states(mechanism)) {
      ray.configuration.states = z.tail(at(layout.state_count));
      ray.configuration = closure.assembled(ray.configuration, {});
    }
    z = closure.consistent(ray.configuration, z, {});
    for (std::size_t k = 0; k < plan.z.size(); ++k)
      if (!plan.is_reduced() ||
          std::find(plan.independent.begin(), plan.independent.end(), k) != plan.independent.end())
        ray.z.push_back(static_cast<double>(z[at(k)]));
    fill(ray.zdot, ray.z.size(), 5);
    fill(ray.u, layout.input_count(), 5);
    fill(ray.displacement, ray.z.size() - layout.state_count + plan.carried().size(), 1);
    fill(ray.velocity, ray.z.size(), 1);
    fill(ray.input, layout.input_count(), 1);
    if (model::time_dependence(mechanism).any()) ray.time = uniform(-1, 1);
  }
  return rays;
}

}  // namespace jourdain::validate
