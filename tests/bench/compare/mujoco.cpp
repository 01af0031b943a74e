// MuJoCo: composite bodies and recursive Newton–Euler, without contacts, limits and actuators.
#include "bench/compare/library.hpp"

#ifdef JOURDAIN_MUJOCO
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <stdexcept>

#include "bench/compare/principal.hpp"
#include "support/files.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::compare {

namespace {

std::string text_of(const model::Numbers3& v) { return fmt::format("{} {} {}", v[0], v[1], v[2]); }

/// With principal axes: MuJoCo's own are good to seven digits.
std::string inertial_of(const Link& link) {
  const Principal principal = principal_of(link);
  const Eigen::Quaterniond q(principal.axes);
  const Eigen::Vector3d& moments = principal.moments;
  return fmt::format("<inertial pos=\"{}\" mass=\"{}\" quat=\"{} {} {} {}\" diaginertia=\"{} {} {}\"/>",
                     text_of(link.center), link.mass, q.w(), q.x(), q.y(), q.z(), moments[0], moments[1],
                     moments[2]);
}

/// A link with all that it carries.
std::string body_of(const Robot& robot, std::size_t index) {
  const Link& link = robot.links[index];
  const auto quaternion = model::quaternion_of(link.rotation);
  std::string text = fmt::format("<body pos=\"{}\" quat=\"{} {} {} {}\">", text_of(link.position),
                                 quaternion[0], quaternion[1], quaternion[2], quaternion[3]);
  text += inertial_of(link);
  if (link.motion == Motion::kFree)
    text += "<freejoint/>";
  else
    text += fmt::format("<joint type=\"{}\" axis=\"{}\"/>", link.motion == Motion::kTurn ? "hinge" : "slide",
                        text_of(link.axis));
  for (std::size_t child = index + 1; child < robot.links.size(); ++child)
    if (robot.links[child].parent == static_cast<int>(index)) text += body_of(robot, child);
  return text + "</body>\n";
}

mjModel* model_of(const Robot& robot) {
  std::string text = fmt::format(
      "<mujoco><compiler angle=\"radian\" boundmass=\"0\" boundinertia=\"0\" balanceinertia=\"false\"/>"
      "<option gravity=\"{}\" timestep=\"{}\" integrator=\"RK4\"><flag constraint=\"disable\" "
      "contact=\"disable\" actuation=\"disable\"/></option><worldbody>\n",
      text_of(robot.gravity), kStepLength);
  for (std::size_t i = 0; i < robot.links.size(); ++i)
    if (robot.links[i].parent < 0) text += body_of(robot, i);
  const support::TemporaryFolder folder;
  const std::string file = folder.path() + "/robot.xml";
  support::write_file(file, text + "</worldbody></mujoco>\n");
  char error[1000] = "";
  mjModel* model = mj_loadXML(file.c_str(), nullptr, error, sizeof error);
  if (!model) throw std::runtime_error(error);
  return model;
}

class Mujoco : public Library {
 public:
  Mujoco(const Robot& robot, const std::vector<Sample>& samples)
      : model_(model_of(robot)),
        data_(mj_makeData(model_)),
        samples_(samples),
        filled_(static_cast<std::size_t>(model_->nv * model_->nv)),
        rest_(static_cast<std::size_t>(model_->nv)) {}
  ~Mujoco() override {
    mj_deleteData(data_);
    mj_deleteModel(model_);
  }
  Mujoco(const Mujoco&) = delete;
  Mujoco& operator=(const Mujoco&) = delete;

  std::string name() const override { return fmt::format("MuJoCo {}", mj_versionString()); }
  std::string calls(Quantity quantity) const override {
    switch (quantity) {
      case Quantity::kForward:
        return "mj_crb, mj_factorM, mj_rne, mj_solveM";
      case Quantity::kInverse:
        return "mj_rne";
      case Quantity::kMass:
        return "mj_crb, mj_fullM";
      case Quantity::kStep:
        return "mj_step, RK4";
    }
    return "";
  }

  std::vector<double> result(Quantity quantity, std::size_t sample) override {
    set(samples_[sample]);
    call(quantity, samples_[sample]);
    const auto nv = static_cast<std::ptrdiff_t>(model_->nv);
    if (quantity != Quantity::kStep)
      return {filled_.begin(), filled_.begin() + (quantity == Quantity::kMass ? nv * nv : nv)};
    std::vector<double> values(data_->qpos, data_->qpos + model_->nq);
    values.insert(values.end(), data_->qvel, data_->qvel + nv);
    return values;
  }

  void run(Quantity quantity, int times) override {
    for (const Sample& sample : samples_) {
      set(sample);
      for (int i = 0; i < times; ++i) call(quantity, sample);
    }
  }

 private:
  void set(const Sample& sample) {
    std::copy(sample.y.begin(), sample.y.end(), data_->qpos);
    std::copy(sample.z.begin(), sample.z.end(), data_->qvel);
  }

  void call(Quantity quantity, const Sample& sample) {
    if (quantity == Quantity::kStep) return mj_step(model_, data_);
    mj_kinematics(model_, data_);
    mj_comPos(model_, data_);
    if (quantity == Quantity::kMass) {
      mj_crb(model_, data_);
      mj_fullM(model_, filled_.data(), data_->qM);
      return;
    }
    if (quantity == Quantity::kInverse) {
      mj_comVel(model_, data_);
      std::copy(sample.zdot.begin(), sample.zdot.end(), data_->qacc);
      return mj_rne(model_, data_, 1, filled_.data());
    }
    mj_crb(model_, data_);
    mj_factorM(model_, data_);
    mj_comVel(model_, data_);
    mj_rne(model_, data_, 0, rest_.data());
    for (double& force : rest_) force = -force;
    mj_solveM(model_, data_, filled_.data(), rest_.data(), 1);
  }

  mjModel* model_;
  mjData* data_;
  std::vector<Sample> samples_;
  std::vector<double> filled_, rest_;
};

}  // namespace

std::unique_ptr<Library> make_mujoco(const Robot& robot, const std::vector<Sample>& samples) {
  return std::make_unique<Mujoco>(robot, samples);
}

}  // namespace jourdain::compare
#else
namespace jourdain::compare {
std::unique_ptr<Library> make_mujoco(const Robot&, const std::vector<Sample>&) { return nullptr; }
}  // namespace jourdain::compare
#endif
