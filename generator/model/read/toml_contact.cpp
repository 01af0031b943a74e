// [[stop]] and [[contact]]: forces that push and never pull, made of expressions.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "model/expression_functions.hpp"
#include "model/expression_sums.hpp"
#include "model/read/keys.hpp"
#include "model/read/toml_frame.hpp"
#include "model/read/toml_names.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

using support::shown;

Expression dot(const Vector3& a, const Vector3& b) {
  return plus(plus(times(a[0], b[0]), times(a[1], b[1])), times(a[2], b[2]));
}

Vector3 cross(const Vector3& a, const Vector3& b) {
  return {minus(times(a[1], b[2]), times(a[2], b[1])), minus(times(a[2], b[0]), times(a[0], b[2])),
          minus(times(a[0], b[1]), times(a[1], b[0]))};
}

/// depth^exponent where that is positive; roots instead of powers for halves.
Expression raised(const Expression& depth, double exponent) {
  const double whole = std::floor(exponent);
  if (exponent - whole != 0.5) return real_power(depth, exponent);
  return times(Expression::power(depth, static_cast<int>(whole)),
               Expression::unary(Expression::Op::kSqrt, depth));
}

/// `force` where `depth` is positive, unless it would pull.
Expression pushing(const Expression& depth, const Expression& force) {
  return where_less(0.0, depth, false, Expression::function(support::Function::kMax, force, 0.0), 0.0);
}

void refuse_negative(TomlFile& file, const TomlTable& table, std::string_view key, const Expression& value) {
  if (file.value(value) < 0) table.error(key, fmt::format("{} is negative", table.quoted(key)));
}

/// max(k d + c d′, 0) at a depth d > 0 beyond each limit (Kelvin and Voigt).
void read_stop(TomlFile& file, const TomlTable& table, const std::string& name, Mechanism& mechanism) {
  const std::optional<std::string> joint_name = table.required_text("joint");
  if (!joint_name) return;
  const auto joint = find_named(file, table.where("joint"), table.what() + " names", "joint", *joint_name,
                                mechanism.joints, file.complete().structure);
  const std::size_t j = joint.value_or(0);
  std::size_t c = 0;
  bool is_found = false;
  if (joint)
    if (const auto coordinate = find_coordinate(table, mechanism.joints[j])) {
      c = *coordinate;
      is_found = true;
    }
  const CoordinateNeeds needs = is_found ? coordinate_needs(mechanism.joints[j], c) : CoordinateNeeds{};
  const Expression stiffness = table.positive("stiffness", needs.stiffness);
  const Expression damping = table.number("damping", needs.damping);
  refuse_negative(file, table, "damping", damping);
  const Expression lower = table.number("lower", needs.position),
                   upper = table.number("upper", needs.position);
  const bool has_lower = table.has("lower"), has_upper = table.has("upper");
  if (!has_lower && !has_upper) table.missing("upper", "or 'lower', or both");
  if (has_lower && has_upper && !(file.value(lower) < file.value(upper)))
    table.error("upper", fmt::format("{} is not above 'lower'", table.quoted("upper")));
  if (!is_found) return;
  const Expression at = Expression::variable({Variable::Kind::kPosition, j, c}),
                   rate = Expression::variable({Variable::Kind::kVelocity, j, c});
  const auto force = [&](const Expression& depth, const Expression& speed) {
    return pushing(depth, plus(times(stiffness, depth), times(damping, speed)));
  };
  CoordinateForce stop;
  stop.name = name;
  stop.where = table.where("joint");
  stop.joint = JointIndex(j);
  stop.coordinate = c;
  if (has_lower) stop.force = force(minus(lower, at), Expression::unary(Expression::Op::kNegate, rate));
  if (has_upper) stop.force = minus(stop.force, force(minus(at, upper), rate));
  mechanism.coordinate_forces.push_back(stop);
}

/// What a plane does to a point at depth d > 0 behind it, or to the lowest point of a ball around it, moving with
/// velocity v_t along the plane:
///   N = max(k d^e (1 + c d′), 0)             Hunt and Crossley, J. Appl. Mech. 42 (1975) 440-445
///   F = N n − μ N v_t/sqrt(v_t² + w²)        Coulomb, regularised
class ContactReader {
 public:
  ContactReader(TomlFile& file, const TomlTable& table, std::string name, Mechanism& mechanism)
      : file_(file), table_(table), name_(std::move(name)), mechanism_(mechanism) {}

  void read() {
    const auto frame = find_frame(file_, table_, "frame", mechanism_);
    const std::array<double, 3> normal = direction();
    const Vector3 origin = table_.vector("point", needed::kLength, {0.0, 0.0, 0.0});
    const Expression radius = table_.number("radius", needed::kLength);
    refuse_negative(file_, table_, "radius", radius);
    const double exponent =
        table_.has("exponent") ? file_.constant(*table_.find("exponent"), place("exponent")) : 1;
    if (!(exponent >= 1 && exponent <= 10))
      table_.error("exponent", fmt::format("{} is not between 1 and 10", table_.quoted("exponent")),
                   "spheres have 1.5");
    const Expression stiffness =
        table_.positive("stiffness", exponent == 1 ? needed::kStiffness : needed::kAnything);
    const Expression damping = table_.number("damping", Needed{{"s/m"}});
    refuse_negative(file_, table_, "damping", damping);
    const Expression friction = table_.number("friction", needed::kPure);
    refuse_negative(file_, table_, "friction", friction);
    const Expression slip =
        table_.has("friction") ? table_.positive("slip_speed", needed::kSpeed) : Expression(1.0);
    if (table_.has("slip_speed") && !table_.has("friction"))
      table_.error("slip_speed", fmt::format("{} has no 'friction'", table_.what()));
    if (!frame) return;
    if (!mechanism_.frames[frame->value].body)
      table_.error("frame", fmt::format("{} acts on the world, which cannot move", table_.what()));
    Load load;
    load.name = name_;
    load.frame = *frame;
    load.axes = LoadAxes::kWorld;
    load.where = table_.where("frame");
    const Vector3 n = {normal[0], normal[1], normal[2]};
    const Vector3 p = components(Variable::Kind::kFramePosition, *frame),
                  v = components(Variable::Kind::kFrameVelocity, *frame);
    const Vector3 behind = {minus(origin[0], p[0]), minus(origin[1], p[1]), minus(origin[2], p[2])};
    const Expression depth = plus(dot(n, behind), radius), out = dot(n, v);
    const Expression elastic = times(stiffness, raised(depth, exponent));
    const Expression push = pushing(depth, times(elastic, minus(1.0, times(damping, out))));
    // Of the ball's lowest point, v − r ω × n, along the plane.
    const Vector3 turning = cross(components(Variable::Kind::kFrameWorldSpin, *frame), n);
    Vector3 along;
    for (std::size_t k = 0; k < 3; ++k)
      along[k] = minus(minus(v[k], times(n[k], out)), times(radius, turning[k]));
    const Expression speed =
        Expression::unary(Expression::Op::kSqrt, plus(dot(along, along), times(slip, slip)));
    const Expression drag = Expression::binary(Expression::Op::kDivide, times(friction, push), speed);
    const Vector3 lever = {times(drag, times(radius, along[0])), times(drag, times(radius, along[1])),
                           times(drag, times(radius, along[2]))};
    const Vector3 moment = cross(n, lever);
    for (std::size_t k = 0; k < 3; ++k) {
      load.force[k] = settled(minus(times(n[k], push), times(drag, along[k])), mechanism_);
      load.moment[k] = settled(moment[k], mechanism_);
    }
    mechanism_.loads.push_back(load);
  }

 private:
  Place place(const char* key) const { return {table_.quoted(key), needed::kPure}; }

  static Vector3 components(Variable::Kind kind, FrameIndex frame) {
    Vector3 vector;
    for (std::size_t k = 0; k < 3; ++k) vector[k] = Expression::variable({kind, frame.value, k});
    return vector;
  }

  /// Of unit length; [0, 0, 1] after a diagnostic.
  std::array<double, 3> direction() {
    std::array<double, 3> normal = table_.direction("normal", {0, 0, 1});
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    if (!(length > 0) || !std::isfinite(length)) {
      table_.error("normal", fmt::format("{} has no direction", table_.quoted("normal")),
                   "a normal points out of the ground, such as [0, 0, 1]");
      return {0, 0, 1};
    }
    for (double& component : normal) component /= length;
    return normal;
  }

  TomlFile& file_;
  const TomlTable& table_;
  std::string name_;
  Mechanism& mechanism_;
};

template <class Read>
void for_each_table(TomlFile& file, const TomlTables& section, const char* kind, const Read& read) {
  std::size_t number = 0;
  for (const toml::node& node : section) {
    const std::string name = name_or_number(file, *node.as_table(), kind, ++number);
    const TomlTable table(file, *node.as_table(), fmt::format("{} '{}'", kind, shown(name)),
                          file.range(node.source()), keys_of(kind));
    read(table, name);
  }
}

}  // namespace

void read_stops(TomlFile& file, const TomlTables& section, Mechanism& mechanism) {
  for_each_table(file, section, "stop", [&](const TomlTable& table, const std::string& name) {
    read_stop(file, table, name, mechanism);
  });
}

void read_contacts(TomlFile& file, const TomlTables& section, Mechanism& mechanism) {
  for_each_table(file, section, "contact", [&](const TomlTable& table, const std::string& name) {
    ContactReader(file, table, name, mechanism).read();
  });
}

}  // namespace jourdain::model
