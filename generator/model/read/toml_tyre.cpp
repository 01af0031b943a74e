// [[tyre]]: a wheel on the ground with slip that needs a way to build up, made of expressions and two states.
#include <fmt/format.h>

#include <array>

#include "model/expression_sums.hpp"
#include "model/matrix3.hpp"
#include "model/mechanism.hpp"
#include "model/read/ground.hpp"
#include "model/read/pushing.hpp"
#include "model/read/toml_frame.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

const std::vector<std::string> kLaws{"magic_formula", "brush"};

/// Slips below this are as good as none.
constexpr double kNoSlip = 1e-9;

Expression over(const Expression& a, const Expression& b) {
  return Expression::binary(Expression::Op::kDivide, a, b);
}
Expression negative(const Expression& a) { return Expression::unary(Expression::Op::kNegate, a); }
Expression root(const Expression& a) { return Expression::unary(Expression::Op::kSqrt, a); }
Expression call(support::Function function, const Expression& a) { return Expression::function(function, a); }

/// Wheels that lie as flat as this, rad, have no direction forward, and no force along it.
constexpr double kFlat = 1e-9;

/// Its length, but for wheels that lie flat.
Expression length_of(const Vector3& across) { return root(plus(dot(across, across), kFlat * kFlat)); }

/// The direction from a wheel's centre, axle a, down to a plane with the normal n.
Vector3 down_to(const Vector3& n, const Vector3& a) {
  return times(over(1.0, length_of(cross(a, n))), minus(times(dot(n, a), a), n));
}

/// With the axle a and the normal n, c = |a × n|: forward f = a × n/c, to the left l = n × f, down in the wheel's plane
/// q = −(n − (n·a) a)/c. At a depth d = r c − h of the lowest point, h the centre's height:
///   N = max(k d + e d′, 0)                     d′ = −n·v
///   slip speeds w = f·(v + r ω × q), l·(v + r ω × q), rolling speed V = max(|f·v|, r |ω·a|)
///   s′ = −w − V s/L where the wheel touches, −V s/L elsewhere; the slips are σ = s/L, together ρ = |σ|
///   F = N (g₁(ρ) σ₁ f + g₂(ρ) σ₂ l)/ρ + N n    at q h/c from the centre
/// with, by the Magic Formula, g = μ sin(C atan(B ρ − E (B ρ − atan(B ρ)))), and by a brush with a parabolic load,
/// θ = K/(3 μ), g = 3 μ θρ (1 − θρ + (θρ)²/3), μ from θρ = 1 on. H. B. Pacejka, Tyre and Vehicle Dynamics, 2nd ed.
/// 2006: chapters 3, 4, 7 (relaxation), of which these are the isotropic similarity and the single-contact-point forms.
/// Where the ground has a height, the plane is the one that touches it where r q leads from the centre (see
/// ground.hpp), and v is counted from the ground's.
class TyreReader {
 public:
  TyreReader(TomlFile& file, const TomlTable& table, std::string name, Mechanism& mechanism)
      : file_(file), table_(table), name_(std::move(name)), mechanism_(mechanism) {}

  void read() {
    const std::size_t mark = file_.error_count();
    const auto frame = find_frame(file_, table_, "frame", mechanism_);
    const Ground ground(table_);
    const std::array<double, 3> axis = unit_direction(table_, "axis", {0, 1, 0});
    const Expression radius = table_.positive("radius", needed::kLength),
                     stiffness = table_.positive("stiffness", needed::kStiffness),
                     damping = table_.not_negative("damping", needed::kDamping),
                     relaxation = table_.positive("relaxation_length", needed::kLength);
    read_law();
    if (!table_.has("name")) table_.missing("name", "its states have the name");
    if (!frame || file_.error_count() != mark) return;
    const Frame on = mechanism_.frames[frame->value];
    if (!on.body)
      return table_.error("frame", fmt::format("{} is on the world, which cannot move", table_.what()));
    const auto axle = add_axle(on, axis);
    if (!axle) return;
    first_state_ = mechanism_.states.size();
    if (!declare("_longitudinal") || !declare("_lateral")) return;

    mechanism_.grounds.push_back(ground.drawn(*frame));
    const Vector3 p = frame_components(Variable::Kind::kFramePosition, *frame),
                  w = frame_components(Variable::Kind::kFrameWorldSpin, *frame);
    const Vector3 a = minus(frame_components(Variable::Kind::kFramePosition, *axle), p);
    const Ground::Plane plane =
        ground.touched(p, [&](const Vector3& n) { return times(radius, down_to(n, a)); });
    const Vector3& n = plane.normal;
    const Vector3 v = minus(frame_components(Variable::Kind::kFrameVelocity, *frame), plane.velocity);
    const Vector3 across = cross(a, n);
    const Expression upright = length_of(across), height = negative(plane.behind);
    const Vector3 forward = times(over(1.0, upright), across), left = cross(n, forward);
    const Vector3 down = down_to(n, a);
    const Expression depth = minus(times(radius, upright), height);
    const Expression load = pushing(depth, minus(times(stiffness, depth), times(damping, dot(n, v))));
    const Vector3 slipping = plus(v, times(radius, cross(w, down)));
    const Expression rolling =
        Expression::function(support::Function::kMax, call(support::Function::kAbs, dot(forward, v)),
                             times(radius, call(support::Function::kAbs, dot(w, a))));
    const std::array<Expression, 2> slip = {over(state(0), relaxation), over(state(1), relaxation)};
    const Expression total =
        root(plus(plus(times(slip[0], slip[0]), times(slip[1], slip[1])), kNoSlip * kNoSlip));
    const std::array<Vector3, 2> along = {forward, left};
    Vector3 force = times(load, n);
    for (std::size_t i = 0; i < 2; ++i) {
      StateVariable& own = mechanism_.states[first_state_ + i];
      const Expression back = negative(times(rolling, slip[i]));
      own.rate =
          settled(where_less(0.0, depth, false, minus(back, dot(along[i], slipping)), back), mechanism_);
      own.nominal = over(relaxation, 10.0);
      force = plus(force, times(times(load, times(over(strength(i, total), total), slip[i])), along[i]));
    }
    act(*frame, force, cross(times(over(height, upright), down), force),
        {settled(depth, mechanism_), stiffness, 1});
  }

 private:
  void read_law() {
    friction_ = table_.positive("friction", needed::kPure);
    brush_ = table_.choice("law", kLaws).value_or(0) == 1;
    const std::vector<const char*> factors = {"stiffness_factor", "shape_factor", "curvature_factor"};
    for (const char* key : factors)
      if (brush_ && table_.has(key))
        table_.error(key, fmt::format("{} is a brush and has no '{}'", table_.what(), key));
    if (!brush_ && table_.has("slip_stiffness"))
      table_.error("slip_stiffness", fmt::format("{} has no brush", table_.what()), "law = \"brush\"");
    if (brush_) {
      slip_stiffness_ = table_.positive("slip_stiffness", needed::kPure);
      return;
    }
    B_ = pair("stiffness_factor", {});
    C_ = pair("shape_factor", {});
    E_ = pair("curvature_factor", std::array<Expression, 2>{0.0, 0.0});
    for (std::size_t i = 0; i < 2; ++i) {
      if (!(file_.value(B_[i]) > 0))
        table_.error("stiffness_factor",
                     fmt::format("{} must be positive", table_.quoted("stiffness_factor")));
      if (!(file_.value(C_[i]) > 0))
        table_.error("shape_factor", fmt::format("{} must be positive", table_.quoted("shape_factor")));
      if (!(file_.value(E_[i]) <= 1))
        table_.error("curvature_factor", fmt::format("{} is more than 1", table_.quoted("curvature_factor")),
                     "forces would turn round");
    }
  }

  /// Along and across; both are 1 after a diagnostic.
  std::array<Expression, 2> pair(const char* key, const std::optional<std::array<Expression, 2>>& otherwise) {
    const std::array<Expression, 2> one = {1.0, 1.0};
    if (table_.has(key)) return table_.pair(key, needed::kPure).value_or(one);
    if (!otherwise) table_.missing(key, "two numbers, forward and sideways");
    return otherwise.value_or(one);
  }

  /// A frame one metre along the axle.
  std::optional<FrameIndex> add_axle(const Frame& on, const std::array<double, 3>& axis) {
    Frame axle = on;
    axle.name = name_ + "_axle";
    std::array<double, 3> rpy{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Expression& angle = on.placement.rotation.rpy[k];
      if (!angle.is_constant()) {
        table_.error("frame", fmt::format("{} is on a frame whose 'rpy' has parameters", table_.what()),
                     "an axle's direction is constant in its body");
        return {};
      }
      rpy[k] = angle.constant();
    }
    const Numbers3 along = product(rotation_from_rpy(rpy), axis);
    for (std::size_t k = 0; k < 3; ++k)
      axle.placement.position[k] = plus(axle.placement.position[k], Expression(along[k]));
    if (!is_new_name(file_, table_.where("name"), "frames", axle.name, mechanism_.frames)) return {};
    axle.where = table_.where("name");
    mechanism_.frames.push_back(axle);
    return FrameIndex(mechanism_.frames.size() - 1);
  }

  bool declare(const char* end) {
    StateVariable state;
    state.name = name_ + end;
    state.where = table_.where("name");
    state.unit = "m";
    state.description = "deflection of a tyre";
    if (!check_signal_name(file_, table_, "state", state.name, mechanism_)) return false;
    mechanism_.states.push_back(state);
    return true;
  }

  Expression state(std::size_t i) const {
    return Expression::variable({Variable::Kind::kState, first_state_ + i});
  }

  /// Force over load, by the slip.
  Expression strength(std::size_t i, const Expression& slip) const {
    if (brush_) {
      const Expression share = Expression::function(
          support::Function::kMin, times(over(slip_stiffness_, times(3.0, friction_)), slip), 1.0);
      return times(times(3.0, friction_),
                   times(share, plus(minus(1.0, share), over(times(share, share), 3.0))));
    }
    const Expression x = times(B_[i], slip);
    const auto arctangent = [](const Expression& tangent) {
      return Expression::function(support::Function::kAtan2, tangent, 1.0);
    };
    const Expression bent = minus(x, times(E_[i], minus(x, arctangent(x))));
    return times(friction_, Expression::unary(Expression::Op::kSin, times(C_[i], arctangent(bent))));
  }

  void act(FrameIndex frame, const Vector3& force, const Vector3& moment, const Touch& touch) {
    Load load;
    load.touch = touch;
    load.name = name_;
    load.frame = frame;
    load.axes = LoadAxes::kWorld;
    load.where = table_.where("frame");
    for (std::size_t k = 0; k < 3; ++k) {
      load.force[k] = settled(force[k], mechanism_);
      load.moment[k] = settled(moment[k], mechanism_);
    }
    mechanism_.loads.push_back(load);
  }

  TomlFile& file_;
  const TomlTable& table_;
  std::string name_;
  Mechanism& mechanism_;
  bool brush_ = false;
  Expression friction_, slip_stiffness_;
  std::array<Expression, 2> B_, C_, E_;
  std::size_t first_state_ = 0;
};

}  // namespace

void read_tyres(TomlFile& file, const TomlTables& section, Mechanism& mechanism) {
  for_each_table(file, section, "tyre", [&](const TomlTable& table, const std::string& name) {
    TyreReader(file, table, name, mechanism).read();
  });
}

}  // namespace jourdain::model
