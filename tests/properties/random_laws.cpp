#include "properties/random_laws.hpp"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "model/coordinates.hpp"
#include "model/expression_functions.hpp"
#include "model/lookup_table.hpp"
#include "properties/arithmetic.hpp"
#include "properties/random.hpp"
#include "properties/random_scene.hpp"
#include "properties/random_states.hpp"

namespace jourdain::tests {

namespace {

using model::Expression;
using model::Variable;
using support::Function;

Expression call(const char* name, const std::vector<Expression>& arguments) {
  return model::find_function(name)->of(arguments);
}

class Laws {
 public:
  Laws(model::Mechanism& mechanism, std::uint64_t seed) : mechanism_(mechanism), random_(seed * 77 + 3) {}

  void run() {
    for (std::size_t j = 0; j < mechanism_.joints.size(); ++j)
      for (std::size_t c = 0; c < mechanism_.joints[j].coordinates.size(); ++c) add_to(j, c);
    for (model::Spring& spring : mechanism_.springs) change(spring);
    if (!mechanism_.loads.empty()) mechanism_.loads[0].force[0] = law(quantity(), quantity());
    model::Output output;
    output.name = "law";
    output.kind = model::OutputKind::kExpression;
    output.value = law(quantity(), quantity());
    mechanism_.outputs.push_back(output);
    if (random_.chance(0.5)) add_states();
    lead_motions();
  }

 private:
  double number(double low, double high) { return random_.uniform(low, high); }

  void add_states() {
    tests::add_states(mechanism_, random_.below(1000));
    for (model::StateVariable& state : mechanism_.states)
      state.rate = state.rate + number(-1, 1) * law(quantity(), quantity());
  }

  /// Most prescribed coordinates follow two states: their velocity any smooth law, their acceleration any law of time,
  /// inputs and states.
  void lead_motions() {
    if (model::lay_out_coordinates(mechanism_).position_count() == 0) return;
    for (model::Joint& joint : mechanism_.joints)
      for (model::Coordinate& coordinate : joint.coordinates)
        if (coordinate.motion && random_.chance(0.7)) lead(coordinate);
  }

  void lead(model::Coordinate& coordinate) {
    const std::size_t first = mechanism_.states.size();
    const Expression t = variable(Variable::Kind::kTime), place = variable(Variable::Kind::kState, first),
                     speed = variable(Variable::Kind::kState, first + 1);
    std::vector<Expression> known = {t, place};
    const std::size_t inputs = mechanism_.actuators.size() + mechanism_.inputs.size();
    for (std::size_t i = 0; i < inputs; ++i) known.push_back(variable(Variable::Kind::kInput, i));
    for (std::size_t i = 0; i < first; ++i) known.push_back(variable(Variable::Kind::kState, i));
    const auto any = [&] { return known[random_.below(known.size())]; };
    for (const char* what : {"place", "speed"}) {
      model::StateVariable& state = mechanism_.states.emplace_back();
      state.name = fmt::format("{}_of_{}", what, coordinate.name);
      state.initial = mechanism_.loops.empty() ? number(-1, 1) : 0;
    }
    mechanism_.states[first].rate = number(-1, 1) * speed + number(-0.5, 0.5) * smooth(place, t);
    mechanism_.states[first + 1].rate = number(-1, 1) * law(any(), any()) - number(0, 1) * speed;
    if (mechanism_.loops.empty())
      coordinate.motion = *coordinate.motion + number(-1, 1) * place + number(-0.3, 0.3) * smooth(place, t);
    else  // closed at the start as before
      coordinate.motion = *coordinate.motion + number(-0.3, 0.3) * sine(place);
  }

  void add_to(std::size_t j, std::size_t c) {
    model::Coordinate& coordinate = mechanism_.joints[j].coordinates[c];
    if (coordinate.motion && mechanism_.loops.empty() && random_.chance(0.7)) {
      const Expression t = variable(Variable::Kind::kTime);
      coordinate.motion = *coordinate.motion + number(-0.3, 0.3) * smooth(t, Expression(0.5) * t);
    }
    if (!random_.chance(0.6)) return;
    model::CoordinateForce force;
    force.name = fmt::format("law{}_{}", j, c);
    force.joint = model::JointIndex(j);
    force.coordinate = c;
    const Expression own = variable(Variable::Kind::kPosition, j, c),
                     rate = variable(Variable::Kind::kVelocity, j, c);
    force.force = law(own, rate) + number(-1, 1) * law(rate, quantity());
    mechanism_.coordinate_forces.push_back(force);
  }

  void change(model::Spring& spring) {
    if (spring.potential) return;
    const Expression length = variable(Variable::Kind::kArgument),
                     rate = variable(Variable::Kind::kArgument, 0, 1);
    spring.law = number(0.5, 3) * law(length, rate, length);
  }

  Expression quantity() {
    std::vector<Expression> choice = {variable(Variable::Kind::kTime)};
    const std::size_t inputs = mechanism_.actuators.size() + mechanism_.inputs.size();
    if (inputs > 0) choice.push_back(variable(Variable::Kind::kInput, random_.below(inputs)));
    if (const std::vector<std::size_t> frames = placed_frames(); !frames.empty()) {
      const std::size_t frame = frames[random_.below(frames.size())], axis = random_.below(3);
      choice.push_back(variable(Variable::Kind::kFramePosition, frame, axis));
      choice.push_back(variable(Variable::Kind::kFrameVelocity, frame, axis));
      choice.push_back(variable(Variable::Kind::kFrameWorldSpin, frame, axis));
      choice.push_back(variable(Variable::Kind::kFrameDirection, frame, 3 * axis + random_.below(3)));
    }
    for (std::size_t i = 0; i < mechanism_.states.size(); ++i)
      choice.push_back(variable(Variable::Kind::kState, i));
    return choice[random_.below(choice.size())];
  }

  /// Those that are not at their body's origin: where that lies on a joint's axis it stands still, and rounding alone
  /// says which way the references see it move.
  std::vector<std::size_t> placed_frames() const {
    std::vector<std::size_t> list;
    for (std::size_t i = 0; i < mechanism_.frames.size(); ++i) {
      const model::Vector3& position = mechanism_.frames[i].placement.position;
      if (!position[0].is_zero() || !position[1].is_zero() || !position[2].is_zero()) list.push_back(i);
    }
    return list;
  }

  /// Of values in the size of one, with slopes in the size of one.
  Expression smooth(const Expression& a, const Expression& b) {
    const Expression one(1.0), square = one + a * a;
    switch (random_.below(9)) {
      case 0:
        return call("exp", {sine(a)});
      case 1:
        return call("log", {square + b * b});
      case 2:
        return call("tanh", {a}) * b;
      case 3:
        return call("sinh", {sine(b)}) + call("cosh", {cosine(a)});
      case 4:
        return call("pow", {square, Expression(number(-1, 0.7))});
      case 5:
        return Expression::function(Function::kPower, one + sine(a) * sine(a), sine(b));
      case 6:
        return call("atan2", {a, one + b * b}) + call("atan", {b});
      case 7:
        return call("asin", {Expression(0.9) * sine(a)}) - call("acos", {Expression(0.8) * cosine(b)});
      default:
        return call("smooth_max", {a, b, Expression(0.2)}) - call("smooth_sign", {b, Expression(0.5)}) +
               call("smooth_step", {a, Expression(0.3)});
    }
  }

  /// Whole numbers follow from `clock`.
  Expression law(const Expression& a, const Expression& b,
                 const Expression& clock = variable(Variable::Kind::kTime)) {
    const Expression zero(0.0), limit(number(-0.5, 0.5));
    switch (random_.below(10)) {
      case 0:
        return call("abs", {a}) * b;
      case 1:
        return call("max", {a - limit, zero}) + call("min", {a, b});
      case 2:
        return call("sign", {b}) * smooth(a, b);
      case 3:
        return model::where_less(limit, a, random_.chance(0.5),
                                 Expression::unary(Expression::Op::kSqrt, a - limit), zero) *
               b;
      case 4:
        return model::where_less(a, b, random_.chance(0.5), smooth(a, b), a - b);
      case 5:
        return model::where_less(zero, a, false, call("log", {a + Expression(0.1)}),
                                 call("pow", {zero - a, Expression(1.5)}));
      case 6:
        return model::looked_up(table(1), {&a, 1});
      case 7: {
        const std::array<Expression, 2> arguments = {a, b};
        return model::looked_up(table(2), arguments);
      }
      case 8:
        return call("mod", {clock, Expression(0.7)}) * a + call("floor", {Expression(2.3) * clock});
      default:
        return smooth(a, b);
    }
  }

  model::LookupTable table(std::size_t axes) {
    model::LookupTable table;
    std::size_t values = 1;
    for (std::size_t i = 0; i < axes; ++i) {
      std::vector<double> points = {number(-2, 0)};
      const std::size_t count = 2 + random_.below(5);
      while (points.size() < count) points.push_back(points.back() + number(0.3, 1));
      values *= count;
      table.axes.push_back({points});
    }
    table.beyond = random_.chance(0.5) ? model::Beyond::kHold : model::Beyond::kExtend;
    for (std::size_t i = 0; i < values; ++i) table.values.emplace_back(number(-1, 1));
    if (axes == 1) table.interpolation = static_cast<model::Interpolation>(random_.below(3));
    return table;
  }

  model::Mechanism& mechanism_;
  Random random_;
};

}  // namespace

void add_laws(model::Mechanism& mechanism, std::uint64_t seed) { Laws(mechanism, seed).run(); }

model::Mechanism random_scene_with_laws(std::uint64_t seed) {
  model::Mechanism mechanism = random_scene(seed);
  add_laws(mechanism, seed);
  return mechanism;
}

model::Mechanism random_scene_with_calls(std::uint64_t seed) {
  model::Mechanism mechanism = random_scene_with_laws(seed);
  Random random(seed);
  const Expression time = variable(Variable::Kind::kTime);
  const auto call = [&](Expression& expression, const Expression& other) {
    if (expression.has_no_variable()) return;
    std::vector<Expression> arguments = {expression, Expression(random.uniform(-1, 1)), other};
    std::swap(arguments[0], arguments[random.below(3)]);
    arguments.resize(arguments[0].has_no_variable() ? 3 : 1 + random.below(3));
    support::CalledFunction called{
        fmt::format("{}{}", random.chance(0.5) ? "f" : "g", arguments.size()), {}, -1, 1};
    for (std::size_t k = 0; k < arguments.size(); ++k)
      called.arguments.push_back(std::string(1, char('a' + k)));
    Expression list(0.0);
    for (const Expression& argument : arguments)
      list = Expression::function(Function::kArgument, argument, list);
    const double number = support::number_of_called(called);
    expression = Expression::function(Function::kCall, list, Expression(number));
  };
  for (model::CoordinateForce& force : mechanism.coordinate_forces) call(force.force, time);
  for (model::Spring& spring : mechanism.springs)
    if (!spring.potential) call(spring.law, variable(Variable::Kind::kArgument));
  for (model::StateVariable& state : mechanism.states) call(state.rate, time);
  for (model::Joint& joint : mechanism.joints) {
    call(joint.curve[2], variable(Variable::Kind::kArgument));
    for (model::Coordinate& coordinate : joint.coordinates)
      if (coordinate.motion) call(*coordinate.motion, time);
  }
  for (model::Load& load : mechanism.loads)
    for (std::size_t k = 0; k < 3; ++k) call(load.force[k], time);
  return mechanism;
}

}  // namespace jourdain::tests
