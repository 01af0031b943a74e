// Numbers that are computed with at once, in the interpreter.
#include <fmt/format.h>

#include "readback/interpreter.hpp"

namespace jourdain::readback {

/// From a list of as many numbers.
void Interpreter::initialise_lanes(const Value& place, const Expression& list) {
  if (static_cast<long>(list.arguments.size()) != place.type->extent)
    refuse_at(list.place, fmt::format("{} values for {}", list.arguments.size(), types_.text(place.type)));
  for (std::size_t i = 0; i < list.arguments.size(); ++i)
    store(entry(place, i), evaluate(*list.arguments[i]), *list.arguments[i]);
}

/// `detail::Lanes<2, Real>{a, b}`.
Value Interpreter::lanes_of(const Type* type, const Expression& cast) {
  if (cast.arguments.size() != 1 || cast.arguments[0]->kind != ExpressionKind::kList)
    refuse_at(cast.place, "a conversion to lanes");
  const Value place = place_of(type);
  initialise_lanes(place, *cast.arguments[0]);
  return place;
}

/// A number goes with all lanes.
Value Interpreter::lane_by_lane(ir::Op op, const Value& a, const Value& b, const Expression& expression) {
  const Type* type = is_lanes(a) ? a.type : b.type;
  const auto fits = [&](const Value& value) {
    return value.kind == Value::Kind::kNumber || (is_lanes(value) && value.type == type);
  };
  if (!fits(a) || !fits(b)) refuse_at(expression.place, "an operation on lanes and something else");
  const auto lane = [&](const Value& value, std::size_t i) {
    return is_lanes(value) ? load(entry(value, i), expression).number : value.number;
  };
  const Value result = place_of(type);
  for (std::size_t i = 0; i < type->cells; ++i) {
    const Number x = lane(a, i), y = lane(b, i);
    set(entry(result, i), domain_.operate(op, x, y));
  }
  return result;
}

}  // namespace jourdain::readback
