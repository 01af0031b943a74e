// [[contact]]: the ground against a point or a ball, made of expressions.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "model/expression_sums.hpp"
#include "model/mechanism.hpp"
#include "model/read/ground.hpp"
#include "model/read/pushing.hpp"
#include "model/read/toml_frame.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

/// depth^exponent where that is positive; roots instead of powers for halves.
Expression raised(const Expression& depth, double exponent) {
  const double whole = std::floor(exponent);
  if (exponent - whole != 0.5) return real_power(depth, exponent);
  return times(Expression::power(depth, static_cast<int>(whole)),
               Expression::unary(Expression::Op::kSqrt, depth));
}

/// Below this speed, m/s, bristles give way by themselves: what they hold creeps with about that.
constexpr double kHeldSlip = 1e-8;

/// What a plane does to a point at depth d > 0 behind it, or to the lowest point of a ball around it, moving with
/// velocity v_t along the plane; where the ground has a height, the plane that touches it there:
///   N = max(k d^e (1 + c d′), 0)             Hunt and Crossley, J. Appl. Mech. 42 (1975) 440-445
///   F = N n − μ N v_t/sqrt(v_t² + w²)        Coulomb, regularised, or
///   F = N n − N (σ0 s + σ1 s′)               LuGre (see toml_friction.cpp), bristles s in the plane,
///   s′ = v_t − σ0 sqrt(v_t² + w²) s/μ
class ContactReader {
 public:
  ContactReader(TomlFile& file, const TomlTable& table, std::string name, Mechanism& mechanism)
      : file_(file), table_(table), name_(std::move(name)), mechanism_(mechanism) {}

  void read() {
    const auto frame = find_frame(file_, table_, "frame", mechanism_);
    const Ground ground(table_, "a normal points out of the ground, such as [0, 0, 1]");
    const Expression radius = table_.not_negative("radius", needed::kLength);
    const std::size_t before = file_.error_count();
    const double exponent =
        table_.has("exponent") ? file_.constant(*table_.find("exponent"), place("exponent")) : 1;
    if (file_.error_count() == before && !(exponent >= 1 && exponent <= 10))
      table_.error("exponent", fmt::format("{} is not between 1 and 10", table_.quoted("exponent")),
                   "spheres have 1.5");
    const Expression stiffness =
        table_.positive("stiffness", exponent == 1 ? needed::kStiffness : needed::kAnything);
    const Expression damping = table_.not_negative("damping", Needed{{"s/m"}});
    const bool holds = read_friction();
    const std::size_t mark = file_.error_count();
    if (holds) declare_bristles();
    if (!frame || file_.error_count() != mark) return;
    if (!mechanism_.frames[frame->value].body)
      table_.error("frame", fmt::format("{} acts on the world, which cannot move", table_.what()));
    Load load;
    load.name = name_;
    load.frame = *frame;
    load.axes = LoadAxes::kWorld;
    load.where = table_.where("frame");
    const Vector3 p = frame_components(Variable::Kind::kFramePosition, *frame);
    const Ground::Plane plane =
        ground.touched(p, [&radius](const Vector3& n) { return times(times(-1.0, radius), n); });
    const Vector3& n = plane.normal;
    const Vector3 v = minus(frame_components(Variable::Kind::kFrameVelocity, *frame), plane.velocity);
    const Expression depth = plus(plane.behind, radius), out = dot(n, v);
    const Expression elastic = times(stiffness, raised(depth, exponent));
    const Expression push = pushing(depth, times(elastic, minus(1.0, times(damping, out))));
    // Of the ball's lowest point, v − r ω × n, along the plane.
    const Vector3 turning = cross(frame_components(Variable::Kind::kFrameWorldSpin, *frame), n);
    Vector3 along;
    for (std::size_t k = 0; k < 3; ++k)
      along[k] = minus(minus(v[k], times(n[k], out)), times(radius, turning[k]));
    const Expression speed =
        Expression::unary(Expression::Op::kSqrt, plus(dot(along, along), times(slip_, slip_)));
    const auto act = [&](const Vector3& force, const Vector3& lever) {
      const Vector3 moment = cross(n, lever);
      for (std::size_t k = 0; k < 3; ++k) {
        load.force[k] = settled(force[k], mechanism_);
        load.moment[k] = settled(moment[k], mechanism_);
      }
    };
    if (holds) {
      const Vector3 held = bristle_force(ground.along(plane), along, speed, push);
      act({plus(times(n[0], push), held[0]), plus(times(n[1], push), held[1]),
           plus(times(n[2], push), held[2])},
          {minus(0.0, times(radius, held[0])), minus(0.0, times(radius, held[1])),
           minus(0.0, times(radius, held[2]))});
    } else {
      const Expression drag = Expression::binary(Expression::Op::kDivide, times(friction_, push), speed);
      act({minus(times(n[0], push), times(drag, along[0])), minus(times(n[1], push), times(drag, along[1])),
           minus(times(n[2], push), times(drag, along[2]))},
          {times(drag, times(radius, along[0])), times(drag, times(radius, along[1])),
           times(drag, times(radius, along[2]))});
    }
    load.touch = {settled(depth, mechanism_), stiffness, exponent};
    mechanism_.loads.push_back(load);
    mechanism_.grounds.push_back(ground.drawn(*frame));
  }

 private:
  /// Whether friction holds, by bristles.
  bool read_friction() {
    friction_ = table_.not_negative("friction", needed::kPure);
    const bool holds = table_.choice("friction_model", {"smoothed", "lugre"}).value_or(0) == 1;
    if (!table_.has("friction"))
      for (const char* key : {"slip_speed", "friction_model", "bristle_stiffness", "bristle_damping"})
        if (table_.has(key)) table_.error(key, fmt::format("{} has no 'friction'", table_.what()));
    if (table_.has("friction") && (!holds || table_.has("slip_speed")))
      slip_ = table_.positive("slip_speed", needed::kSpeed);
    if (!holds) {
      for (const char* key : {"bristle_stiffness", "bristle_damping"})
        if (table_.has("friction") && table_.has(key))
          table_.error(key, fmt::format("{} has no bristles", table_.what()), "friction_model = \"lugre\"");
      return false;
    }
    if (!table_.has("slip_speed")) slip_ = kHeldSlip;
    if (table_.has("friction")) table_.positive("friction", needed::kPure);
    bristle_stiffness_ = table_.positive("bristle_stiffness", Needed{{"1/m"}});
    bristle_damping_ = table_.not_negative("bristle_damping", Needed{{"s/m"}});
    return table_.has("friction");
  }

  /// Two states.
  void declare_bristles() {
    first_bristle_ = mechanism_.states.size();
    if (!table_.has("name")) return table_.missing("name", "its states have the name");
    for (const char* end : {"_1", "_2"}) {
      StateVariable state;
      state.name = name_ + end;
      state.where = table_.where("name");
      state.unit = "m";
      state.nominal = Expression::binary(Expression::Op::kDivide, friction_, bristle_stiffness_);
      state.description = "deflection of friction's bristles";
      if (!check_signal_name(file_, table_, "state", state.name, mechanism_)) return;
      mechanism_.states.push_back(state);
    }
  }

  /// On the plane's point; sets the rates of the bristles, which stand in the directions of the plane.
  Vector3 bristle_force(const std::array<Vector3, 2>& directions, const Vector3& along,
                        const Expression& speed, const Expression& push) {
    Vector3 force = {0.0, 0.0, 0.0};
    for (std::size_t i = 0; i < 2; ++i) {
      const Vector3& a = directions[i];
      const Expression s = Expression::variable({Variable::Kind::kState, first_bristle_ + i});
      const Expression pull = times(bristle_stiffness_, s);
      const Expression back = Expression::binary(Expression::Op::kDivide, times(pull, speed), friction_);
      const Expression rate = minus(dot(a, along), back);
      mechanism_.states[first_bristle_ + i].rate = settled(rate, mechanism_);
      const Expression share = times(push, plus(pull, times(bristle_damping_, rate)));
      for (std::size_t k = 0; k < 3; ++k) force[k] = minus(force[k], times(a[k], share));
    }
    return force;
  }

  Place place(const char* key) const { return {table_.quoted(key), needed::kPure}; }

  TomlFile& file_;
  const TomlTable& table_;
  std::string name_;
  Mechanism& mechanism_;
  Expression friction_, bristle_stiffness_, bristle_damping_;
  Expression slip_ = 1.0;
  std::size_t first_bristle_ = 0;
};

}  // namespace

void read_contacts(TomlFile& file, const TomlTables& section, Mechanism& mechanism) {
  for_each_table(file, section, "contact", [&](const TomlTable& table, const std::string& name) {
    ContactReader(file, table, name, mechanism).read();
  });
}

}  // namespace jourdain::model
