#include "properties/random_states.hpp"

#include <fmt/format.h>

#include <vector>

#include "model/coordinates.hpp"
#include "properties/arithmetic.hpp"
#include "properties/random.hpp"

namespace jourdain::tests {

namespace {

using model::Expression;
using model::Variable;

class States {
 public:
  States(model::Mechanism& mechanism, std::uint64_t seed)
      : mechanism_(mechanism), seed_(seed), random_(seed * 131 + 7) {
    for (std::size_t j = 0; j < mechanism_.joints.size(); ++j)
      for (std::size_t c = 0; c < mechanism_.joints[j].coordinates.size(); ++c)
        coordinates_.push_back({model::JointIndex(j), c});
  }

  void add() {
    const std::size_t count = 1 + random_.below(3);
    for (std::size_t i = 0; i < count; ++i) {
      model::StateVariable state;
      state.name = fmt::format("state{}", i);
      state.initial = number(-1, 1);
      mechanism_.states.push_back(state);
    }
    for (std::size_t i = 0; i < count; ++i) {
      mechanism_.states[i].rate = number(-3, 0.2) * own(i) + number(-2, 2) * sine(quantity() * own(i)) +
                                  quantity() + number(-1, 1) * own(random_.below(count));
      push(i);
    }
    model::Output output;
    output.name = "beside";
    output.kind = model::OutputKind::kExpression;
    output.value = own(0) * quantity();
    mechanism_.outputs.push_back(output);
    turn_into_memories();
  }

 private:
  double number(double low, double high) { return random_.uniform(low, high); }

  static Expression own(std::size_t i) { return variable(Variable::Kind::kState, i); }

  /// Some of them, by numbers of their own.
  void turn_into_memories() {
    random_ = Random(seed_ * 977 + 5);
    for (std::size_t i = 0; i < mechanism_.states.size(); ++i) {
      if (!random_.chance(0.4)) continue;
      mechanism_.states[i].rate = 0.0;
      mechanism_.states[i].sampled =
          number(-1, 1) * own(i) + number(-2, 2) * sine(quantity() * own(i)) + quantity();
    }
  }

  /// By a state on some coordinate, where joints have any that forces name.
  void push(std::size_t i) {
    if (coordinates_.empty()) return;
    const model::ScalarCoordinate& at = coordinates_[random_.below(coordinates_.size())];
    model::CoordinateForce force;
    force.name = fmt::format("by_state{}", i);
    force.joint = at.joint;
    force.coordinate = at.coordinate;
    force.force = number(-2, 2) * own(i) + number(-1, 1) * sine(own(i) * quantity());
    mechanism_.coordinate_forces.push_back(force);
  }

  Expression quantity() {
    std::vector<Expression> choice = {variable(Variable::Kind::kTime)};
    const std::size_t inputs = mechanism_.actuators.size() + mechanism_.inputs.size();
    if (inputs > 0) choice.push_back(variable(Variable::Kind::kInput, random_.below(inputs)));
    if (!coordinates_.empty()) {
      const model::ScalarCoordinate& at = coordinates_[random_.below(coordinates_.size())];
      choice.push_back(variable(Variable::Kind::kPosition, at.joint.value, at.coordinate));
      choice.push_back(variable(Variable::Kind::kVelocity, at.joint.value, at.coordinate));
    }
    if (!mechanism_.frames.empty()) {
      const std::size_t frame = random_.below(mechanism_.frames.size()), axis = random_.below(3);
      choice.push_back(variable(Variable::Kind::kFramePosition, frame, axis));
      choice.push_back(variable(Variable::Kind::kFrameVelocity, frame, axis));
      choice.push_back(variable(Variable::Kind::kFrameWorldSpin, frame, axis));
    }
    choice.push_back(own(random_.below(mechanism_.states.size())));
    return choice[random_.below(choice.size())];
  }

  model::Mechanism& mechanism_;
  std::uint64_t seed_;
  Random random_;
  std::vector<model::ScalarCoordinate> coordinates_;
};

}  // namespace

void add_states(model::Mechanism& mechanism, std::uint64_t seed) {
  if (model::lay_out_coordinates(mechanism).position_count() > 0) States(mechanism, seed).add();
}

}  // namespace jourdain::tests
