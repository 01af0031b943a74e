#include "mutants/scenes.hpp"

#include "agreement/shared_data.hpp"
#include "extremes/extreme_scenes.hpp"

namespace jourdain::tests {

namespace {

model::Mechanism model(const std::string& name) { return read_model(model_path(name + ".toml")); }

model::Mechanism treated(const std::string& name, model::LoopTreatment treatment, double stabilisation = 0) {
  model::Mechanism mechanism = model(name);
  mechanism.name += "_" + std::to_string(static_cast<int>(treatment));
  if (treatment == model::LoopTreatment::kMultipliers) mechanism.loop_options.independent.clear();
  mechanism.loop_options.treatment = treatment;
  mechanism.loop_options.stabilisation = stabilisation;
  return mechanism;
}

std::vector<Subject> subjects(const std::vector<model::Mechanism>& scenes) {
  std::vector<Subject> list;
  for (const model::Mechanism& scene : scenes) list.push_back(subject_of(scene.name, scene));
  return list;
}

}  // namespace

std::vector<model::Mechanism> tree_scenes() {
  std::vector<model::Mechanism> scenes;
  for (const char* name : {"double_pendulum", "cart_pole", "hoop_bead", "quadrotor", "crane", "shaking_cart",
                           "spring_pendulum", "gimbal_gyroscope", "tumbling_body"})
    scenes.push_back(model(name));
  return scenes;
}

std::vector<model::Mechanism> loop_scenes() {
  using enum model::LoopTreatment;
  return {treated("four_bar", kExplicit),           treated("four_bar", kPartitioned),
          treated("slider_crank", kExplicit),       treated("slider_crank", kMultipliers, 5),
          treated("spring_four_bar", kPartitioned), treated("spring_four_bar", kMultipliers, 2)};
}

std::vector<Subject> tree_subjects() { return subjects(tree_scenes()); }
std::vector<Subject> loop_subjects() { return subjects(loop_scenes()); }

}  // namespace jourdain::tests
