#include "commands/figure.hpp"

#include <fmt/format.h>

namespace jourdain::commands {

namespace {

using model::Frame;
using model::Mechanism;

class FigureMaker {
 public:
  explicit FigureMaker(const Mechanism& mechanism) { figure_.mechanism = mechanism; }

  Figure make() {
    figure_.mechanism.outputs.clear();
    for (std::size_t b = 0; b < figure_.mechanism.bodies.size(); ++b) add_body(b);
    for (std::size_t j = 0; j < figure_.mechanism.joints.size(); ++j) add_joint(j);
    for (std::size_t k = 0; k < figure_.mechanism.loops.size(); ++k) add_loop(k);
    const std::size_t springs = figure_.mechanism.springs.size();
    for (std::size_t i = 0; i < springs; ++i) {
      const model::Spring& spring = figure_.mechanism.springs[i];
      const std::size_t from = add_output(spring.from), to = add_output(spring.to);
      figure_.lines.push_back({LineKind::kSpring, from, to});
    }
    return std::move(figure_);
  }

 private:
  std::size_t add_output(model::FrameIndex frame) {
    model::Output output;
    output.name = fmt::format("figure_point_{}", figure_.point_count);
    output.kind = model::OutputKind::kPose;
    output.frame = frame;
    figure_.mechanism.outputs.push_back(output);
    return figure_.point_count++;
  }

  std::size_t add_point(std::optional<model::BodyIndex> body, const model::Placement& placement) {
    Frame frame;
    frame.name = fmt::format("figure_frame_{}", figure_.point_count);
    frame.body = body;
    frame.placement = placement;
    figure_.mechanism.frames.push_back(frame);
    return add_output(model::FrameIndex(figure_.mechanism.frames.size() - 1));
  }

  void add_body(std::size_t index) {
    const model::Body body = figure_.mechanism.bodies[index];
    origins_.push_back(add_point(model::BodyIndex(index), {}));
    const double mass = body.mass.evaluate<double>(parameter_values());
    if (mass <= 0) return;
    model::Placement center;
    center.position = body.center_of_mass;
    const std::size_t point = add_point(model::BodyIndex(index), center);
    figure_.lines.push_back({LineKind::kBody, origins_.back(), point});
    figure_.masses.push_back({point, mass, body.name});
  }

  void add_joint(std::size_t index) {
    const model::Joint joint = figure_.mechanism.joints[index];
    if (joint.type == model::JointType::kFree) return;
    const std::size_t child = origins_[joint.child.value];
    const std::size_t anchor = add_point(joint.parent, joint.placement);
    if (joint.parent) figure_.lines.push_back({LineKind::kBody, origins_[joint.parent->value], anchor});
    figure_.lines.push_back({LineKind::kSlide, anchor, child});
  }

  /// Each body reaches to its end of the loop; a rod joins the ends.
  void add_loop(std::size_t index) {
    const model::Loop loop = figure_.mechanism.loops[index];
    if (loop.type == model::LoopType::kResidual) return;
    const std::size_t from = add_end(loop.from), to = add_end(loop.to);
    figure_.lines.push_back(
        {loop.type == model::LoopType::kRod ? LineKind::kBody : LineKind::kSlide, from, to});
  }

  std::size_t add_end(model::FrameIndex index) {
    const std::optional<model::BodyIndex> body = figure_.mechanism.frames[index.value].body;
    const std::size_t point = add_output(index);
    if (body) figure_.lines.push_back({LineKind::kBody, origins_[body->value], point});
    return point;
  }

  std::vector<double> parameter_values() const {
    std::vector<double> values;
    for (const model::Parameter& parameter : figure_.mechanism.parameters) values.push_back(parameter.value);
    return values;
  }

  Figure figure_;
  std::vector<std::size_t> origins_;  // point of each body's origin
};

}  // namespace

Figure make_figure(const Mechanism& mechanism) { return FigureMaker(mechanism).make(); }

}  // namespace jourdain::commands
