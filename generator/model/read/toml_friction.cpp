// [[friction]]: LuGre friction on a coordinate, a force and the state that its bristles are.
#include <fmt/format.h>

#include <array>

#include "model/composition.hpp"
#include "model/expression_functions.hpp"
#include "model/read/keys.hpp"
#include "model/read/toml_frame.hpp"
#include "model/read/toml_names.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

using support::shown;

/// Numbers of one element, at the speed v of its coordinate:
///   g = Fc + (Fs − Fc) exp(−(v/vs)²)     z′ = v − σ0 |v| z/g     F = −(σ0 z + σ1 z′ + σ2 v)
/// C. Canudas de Wit, H. Olsson, K. J. Åström, P. Lischinsky, IEEE Transactions on Automatic Control 40 (1995).
struct Bristles {
  Expression coulomb, breakaway, stribeck_speed;  ///< Fc, Fs, vs
  Expression stiffness, damping, viscous;         ///< σ0, σ1, σ2
  bool has_stribeck = false;

  Expression rate(const Expression& v, const Expression& z) const {
    const std::array<Expression, 6> all = {v, z, coulomb, breakaway, stribeck_speed, stiffness};
    Composition c(all);
    finish_rate(c);
    return c.finish();
  }

  Expression force(const Expression& v, const Expression& z) const {
    const std::array<Expression, 8> all = {v,         z,       coulomb, breakaway, stribeck_speed,
                                           stiffness, damping, viscous};
    Composition c(all);
    const std::size_t of_rate = damping.is_zero() ? kStiffness : finish_rate(c);
    std::size_t sum = c.product(kStiffness, kZ);
    if (!damping.is_zero()) sum = c.sum(sum, c.product(kDamping, of_rate));
    if (!viscous.is_zero()) sum = c.sum(sum, c.product(kViscous, kV));
    c.operation(Composition::Op::kNegate, sum);
    return c.finish();
  }

 private:
  enum Argument : std::size_t { kV, kZ, kCoulomb, kBreakaway, kStribeck, kStiffness, kDamping, kViscous };

  std::size_t finish_rate(Composition& c) const {
    std::size_t g = kCoulomb;
    if (has_stribeck) {
      const std::size_t ratio = c.quotient(kV, kStribeck);
      const std::size_t share =
          c.function(support::Function::kExp, c.operation(Composition::Op::kNegate, c.square(ratio)));
      g = c.sum(kCoulomb, c.product(c.difference(kBreakaway, kCoulomb), share));
    }
    const std::size_t speed = c.function(support::Function::kAbs, kV);
    return c.difference(kV, c.quotient(c.product(c.product(kStiffness, speed), kZ), g));
  }
};

class FrictionReader {
 public:
  FrictionReader(TomlFile& file, const TomlTable& table, Mechanism& mechanism)
      : file_(file), table_(table), mechanism_(mechanism) {}

  void read() {
    const std::optional<std::string> name = table_.required_text("name");
    const std::optional<ScalarCoordinate> at = find_coordinate(file_, table_, mechanism_);
    const Bristles bristles = read_numbers(coordinate_needs(mechanism_, at));
    if (!name || !at) return;
    StateVariable state;
    state.name = *name;
    state.where = table_.where("name");
    state.unit = mechanism_.joints[at->joint.value].coordinates[at->coordinate].angular ? "rad" : "m";
    state.nominal = Expression::binary(Expression::Op::kDivide, bristles.coulomb, bristles.stiffness);
    state.description = "deflection of friction's bristles";
    if (!check_signal_name(file_, table_, "state", state.name, mechanism_)) return;
    const Expression v = Expression::variable({Variable::Kind::kVelocity, at->joint.value, at->coordinate}),
                     z = Expression::variable({Variable::Kind::kState, mechanism_.states.size()});
    state.rate = bristles.rate(v, z);
    CoordinateForce force;
    force.name = *name;
    force.where = table_.where("joint");
    force.joint = at->joint;
    force.coordinate = at->coordinate;
    force.force = bristles.force(v, z);
    mechanism_.states.push_back(state);
    mechanism_.coordinate_forces.push_back(force);
  }

 private:
  Bristles read_numbers(const CoordinateNeeds& needs) {
    Bristles b;
    b.coulomb = table_.positive("coulomb", needs.force);
    b.stiffness = table_.positive("bristle_stiffness", needs.stiffness);
    b.damping = table_.not_negative("bristle_damping", needs.damping);
    b.viscous = table_.not_negative("viscous", needs.damping);
    b.has_stribeck = table_.has("breakaway");
    if (b.has_stribeck) {
      b.breakaway = table_.positive("breakaway", needs.force);
      b.stribeck_speed = table_.positive("stribeck_speed", needs.rate);
      if (file_.value(b.breakaway) < file_.value(b.coulomb))
        table_.error("breakaway", fmt::format("{} is less than 'coulomb'", table_.quoted("breakaway")));
    } else if (table_.has("stribeck_speed")) {
      table_.error("stribeck_speed", fmt::format("{} has no 'breakaway'", table_.what()));
    }
    return b;
  }

  TomlFile& file_;
  const TomlTable& table_;
  Mechanism& mechanism_;
};

}  // namespace

void read_frictions(TomlFile& file, const TomlTables& section, Mechanism& mechanism) {
  for (const toml::node& node : section) {
    const std::string name = file.text_or(*node.as_table(), "name");
    const TomlTable table(file, *node.as_table(), fmt::format("friction '{}'", shown(name)),
                          file.range(node.source()), keys_of("friction"));
    FrictionReader(file, table, mechanism).read();
  }
}

}  // namespace jourdain::model
