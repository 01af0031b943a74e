#include "loops/derivative_check.hpp"

#include <algorithm>

#include "model/time_dependence.hpp"
#include "support/uniform.hpp"

namespace jourdain::loops {

using ir::LeafKind;

namespace {

Eigen::Index at(std::size_t i) { return static_cast<Eigen::Index>(i); }

class Differences {
 public:
  Differences(const NumericClosure& closure, const LoopPlan& plan, const ir::Module& module,
              const std::vector<double>& parameters, const Ray& ray)
      : closure_(closure), plan_(plan), ray_(ray) {
    leaves_[LeafKind::kParameter].assign(parameters.begin(), parameters.end());
    leaves_[LeafKind::kConstant] = ir::interpret(module.constants, leaves_);
    leaves_[LeafKind::kAcceleration].assign(ray.zdot.begin(), ray.zdot.end());
    moving_.assign(closure.velocity_count(), true);
    for (const std::size_t k : plan.independent) moving_[k] = false;
  }

  /// Derivative of a program's outputs along the ray.
  Vector along(const ir::Program& program) const {
    const long double h = 1e-3L;
    const auto f = [&](long double step) { return values(program, step * h); };
    return ((f(1) - f(-1)) * 45 - (f(2) - f(-2)) * 9 + (f(3) - f(-3))) / (60 * h);
  }

 private:
  Vector values(const ir::Program& program, long double step) const {
    Vector displacement = Vector::Zero(at(closure_.velocity_count()));
    for (std::size_t j = 0; j < ray_.displacement.size(); ++j)
      displacement[at(plan_.is_reduced() ? plan_.independent[j] : j)] = step * ray_.displacement[j];
    Configuration moved = closure_.displaced(ray_.configuration, displacement);
    moved.t += step * ray_.time;
    if (plan_.is_reduced()) moved = closure_.assembled(moved, moving_);
    ir::LeafValues<long double> leaves = leaves_;
    leaves[LeafKind::kPosition].assign(moved.y.begin(), moved.y.end());
    leaves[LeafKind::kTime] = {moved.t};
    for (std::size_t k = 0; k < ray_.z.size(); ++k)
      leaves[LeafKind::kVelocity].push_back(ray_.z[k] + step * ray_.velocity[k]);
    for (std::size_t k = 0; k < ray_.u.size(); ++k)
      leaves[LeafKind::kInput].push_back(ray_.u[k] + step * ray_.input[k]);
    const std::vector<long double> results = ir::interpret(program, leaves);
    return Eigen::Map<const Vector>(results.data(), at(results.size()));
  }

  const NumericClosure& closure_;
  const LoopPlan& plan_;
  const Ray& ray_;
  ir::LeafValues<long double> leaves_;
  std::vector<bool> moving_;
};

/// Component of the ray that a column of an array stands for.
double component(const Ray& ray, const std::string& array, int column) {
  const auto i = static_cast<std::size_t>(std::max(column, 0));
  const std::size_t n = ray.velocity.size();
  if (column < 0) return ray.time;
  if (array == "B" || array == "D" || array == "r_u") return ray.input[i];
  if (array == "A" || array == "C") return i < n ? ray.displacement[i] : ray.velocity[i - n];
  return array == "r_y" || array == "zdot_y" ? ray.displacement[i] : ray.velocity[i];
}

}  // namespace

std::vector<Ray> draw_rays(const NumericClosure& closure, const LoopPlan& plan,
                           const model::Mechanism& mechanism, std::size_t count) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  support::Uniform uniform(17);
  const auto fill = [&](std::vector<double>& list, std::size_t size, double largest) {
    for (std::size_t k = 0; k < size; ++k) list.push_back(uniform(-largest, largest));
  };
  Configuration start;
  start.y = Eigen::Map<const Eigen::VectorXd>(plan.y.data(), at(plan.y.size())).cast<long double>();
  std::vector<Ray> rays;
  for (const Configuration& configuration : walk(closure, start, mechanism, count)) {
    Ray& ray = rays.emplace_back();
    ray.configuration = configuration;
    Vector z(at(layout.velocity_count()));
    for (long double& entry : z) entry = uniform(-2, 2);
    z = closure.consistent(configuration, z, {});
    for (std::size_t k = 0; k < plan.z.size(); ++k)
      if (!plan.is_reduced() ||
          std::find(plan.independent.begin(), plan.independent.end(), k) != plan.independent.end())
        ray.z.push_back(static_cast<double>(z[at(k)]));
    fill(ray.zdot, ray.z.size(), 5);
    fill(ray.u, layout.input_count(), 5);
    fill(ray.displacement, ray.z.size(), 1);
    fill(ray.velocity, ray.z.size(), 1);
    fill(ray.input, layout.input_count(), 1);
    if (model::time_dependence(mechanism).any()) ray.time = uniform(-1, 1);
  }
  return rays;
}

double derivative_error(const NumericClosure& closure, const LoopPlan& plan, const ir::Module& module,
                        const std::vector<double>& parameters, const Ray& ray, const ir::Program& program,
                        const std::vector<double>& values) {
  const Differences differences(closure, plan, module, parameters, ray);
  const auto compare = [&](const char* function, const std::vector<std::string>& arrays, std::size_t first) {
    const ir::Program* differentiated = ir::find_program(module, function);
    if (!differentiated) return 0.0;
    const Vector expected = differences.along(*differentiated);
    Vector sum = Vector::Zero(expected.size()), terms = sum;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const ir::Output& output = program.outputs[k];
      const long row = output.row - static_cast<long>(first);
      if (std::find(arrays.begin(), arrays.end(), output.name) == arrays.end() || row < 0) continue;
      const long double term =
          static_cast<long double>(values[k]) * component(ray, output.name, output.column);
      sum[row] += term;
      terms[row] += std::abs(term);
    }
    return static_cast<double>((sum - expected).norm() / (terms.norm() + expected.norm() + 1));
  };
  if (program.name == "residual_derivatives") return compare("residual", {"r_y", "r_z", "r_u", "r_t"}, 0);
  if (program.name == "forward_dynamics_derivatives") {
    Ray still = ray;  // inputs and time are no columns of it
    std::fill(still.input.begin(), still.input.end(), 0);
    still.time = 0;
    if (ray.time != 0 || still.input != ray.input)
      return derivative_error(closure, plan, module, parameters, still, program, values);
    return compare("forward_dynamics", {"zdot_y", "zdot_z"}, 0);
  }
  if (program.name != "linearize") return 0;
  return std::max(compare("forward_dynamics", {"A", "B", "rate_t"}, ray.velocity.size()),
                  compare("outputs", {"C", "D", "output_t"}, 0));
}

}  // namespace jourdain::loops
