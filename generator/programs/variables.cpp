#include "programs/variables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>

#include "model/joint_kinds.hpp"
#include "model/units.hpp"
#include "programs/entries.hpp"
#include "programs/output_names.hpp"
#include "support/enumerators.hpp"

namespace jourdain::programs {

namespace {

struct RoleRow {
  Role role = Role::kConstant;
  std::string_view name;
};

constexpr auto kRoles = std::to_array<RoleRow>({{Role::kTime, "time"},
                                                {Role::kPosition, "position"},
                                                {Role::kVelocity, "velocity"},
                                                {Role::kPositionRate, "position_rate"},
                                                {Role::kAcceleration, "acceleration"},
                                                {Role::kInput, "input"},
                                                {Role::kOutput, "output"},
                                                {Role::kParameter, "parameter"},
                                                {Role::kConstant, "constant"}});
static_assert(support::is_complete(kRoles, &RoleRow::role), "a row for each Role, in their order");

struct QuantityRow {
  Quantity quantity = Quantity::kOther;
  std::string_view name;
  std::string_view unit;  ///< that tells it; empty: no unit does
};

constexpr auto kQuantities =
    std::to_array<QuantityRow>({{Quantity::kTime, "time", "s"},
                                {Quantity::kAngle, "angle", "rad"},
                                {Quantity::kLength, "length", "m"},
                                {Quantity::kQuaternionPart, "quaternion_part", ""},
                                {Quantity::kQuaternionRate, "quaternion_rate", ""},
                                {Quantity::kAngularVelocity, "angular_velocity", "rad/s"},
                                {Quantity::kVelocity, "velocity", "m/s"},
                                {Quantity::kAngularAcceleration, "angular_acceleration", "rad/s^2"},
                                {Quantity::kAcceleration, "acceleration", "m/s^2"},
                                {Quantity::kForce, "force", "N"},
                                {Quantity::kMoment, "moment", "N m"},
                                {Quantity::kMass, "mass", "kg"},
                                {Quantity::kInertia, "inertia", "kg m^2"},
                                {Quantity::kEnergy, "energy", "J"},
                                {Quantity::kRotationMatrix, "rotation_matrix", ""},
                                {Quantity::kOther, "other", ""}});
static_assert(support::is_complete(kQuantities, &QuantityRow::quantity),
              "a row for each Quantity, in their order");

Quantity quantity_of(std::string_view unit) {
  for (const QuantityRow& row : kQuantities)
    if (!row.unit.empty() && row.unit == unit) return row.quantity;
  return Quantity::kOther;
}

class Table {
 public:
  Table(const model::Mechanism& mechanism, const loops::LoopPlan* plan, const SceneFacts& facts)
      : mechanism_(mechanism),
        facts_(facts),
        entries_(entries_of(mechanism, plan)),
        values_(model::default_values(mechanism)) {}

  std::vector<Variable> all() {
    if (facts_.clock) add_scalar(Role::kTime, "time", "s", "simulation time").start = {0.0};
    const std::size_t first = list_.size();
    states(Role::kPosition, entries_.positions);
    states(Role::kVelocity, entries_.velocities);
    rates(first);
    for (const Entry& entry : entries_.inputs)
      add_scalar(Role::kInput, entry.name, entry.unit, entry.description).start = {0.0};
    outputs();
    const std::set<std::size_t> masses = parameters_that_are_masses();
    for (std::size_t k = 0; k < mechanism_.parameters.size(); ++k) {
      const model::Parameter& parameter = mechanism_.parameters[k];
      Variable& variable =
          add_scalar(Role::kParameter, parameter.name, parameter.unit, parameter.description);
      variable.start = {parameter.value};
      variable.range = parameter.range;
      if (masses.count(k))
        variable.range = parameter.range
                             ? std::array{std::max(0.0, (*parameter.range)[0]), (*parameter.range)[1]}
                             : std::array{0.0, std::numeric_limits<double>::max()};
    }
    constants();
    return std::move(list_);
  }

 private:
  Variable& add(Role role, const std::string& name, const std::string& unit, const std::string& description,
                int rows, int columns) {
    std::string free = name;
    for (int i = 1; !taken_.insert(free).second; ++i)
      free = fmt::format("{}_{}{}", name, role_name(role), i == 1 ? "" : fmt::format("_{}", i));
    Variable& variable = list_.emplace_back();
    variable.name = free;
    variable.description = description;
    variable.unit = unit;
    variable.role = role;
    variable.quantity = quantity_of(unit);
    variable.index = next_[static_cast<std::size_t>(role)];
    variable.rows = rows;
    variable.columns = columns;
    next_[static_cast<std::size_t>(role)] +=
        static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
    return variable;
  }

  Variable& add_scalar(Role role, const std::string& name, const std::string& unit,
                       const std::string& description) {
    Variable& variable = add(role, name, unit, description, 1, 1);
    variable.numbers = {variable.name};
    return variable;
  }

  void states(Role role, const std::vector<Entry>& entries) {
    for (const Entry& entry : entries) {
      Variable& variable = add_scalar(role, entry.name, entry.unit, entry.description);
      variable.start = {entry.initial};
      if (variable.unit == "1") variable.quantity = Quantity::kQuaternionPart;
      const model::Coordinate* coordinate =
          entry.coordinate ? &mechanism_.joints[entry.joint->value].coordinates[*entry.coordinate] : nullptr;
      if (role == Role::kPosition && coordinate) variable.range = coordinate->range;
    }
  }

  /// Alone, as in `mass = "payload"`.
  std::set<std::size_t> parameters_that_are_masses() const {
    std::set<std::size_t> result;
    for (const model::Body& body : mechanism_.bodies) {
      const std::vector<model::Expression::Node>& nodes = body.mass.nodes();
      if (nodes.size() == 1 && nodes[0].op == model::Expression::Op::kParameter)
        result.insert(nodes[0].parameter.value);
    }
    return result;
  }

  /// Of all states, which begin at entry `first` of the table.
  void rates(std::size_t first) {
    const std::size_t count = list_.size() - first;
    for (std::size_t k = first; k < first + count; ++k) {
      const Variable state = list_[k];
      Variable& rate =
          add_scalar(state.role == Role::kPosition ? Role::kPositionRate : Role::kAcceleration,
                     "der(" + state.name + ")", model::unit_per_second(state.unit), "rate of " + state.name);
      rate.derivative_of = k;
      if (state.quantity == Quantity::kQuaternionPart) rate.quantity = Quantity::kQuaternionRate;
    }
  }

  void outputs() {
    const std::vector<OutputNumber> numbers = output_numbers(mechanism_, facts_.outputs);
    std::size_t next = 0;
    for (const OutputFacts& output : facts_.outputs)
      for (const OutputMember& member : output.members) {
        const std::string name = output.name + (member.name.empty() ? "" : "." + member.name);
        Variable& variable =
            add(Role::kOutput, name, numbers[next].unit, output.comment, member.rows, member.columns);
        variable.is_array = member.rows > 1 || member.is_matrix;
        variable.numbers = number_names(output, member);
        if (member.rows == 3 && member.columns == 3 && variable.unit == "1")
          variable.quantity = Quantity::kRotationMatrix;
        next += member.numbers();
      }
  }

  void constants() {
    const model::Vector3& gravity = mechanism_.gravity;
    if (std::ranges::all_of(gravity, &model::Expression::is_constant)) {
      Variable& variable = add(Role::kConstant, "gravity", "m/s^2", "gravity, inertial frame", 3, 1);
      variable.is_array = true;
      for (int k = 0; k < 3; ++k) {
        variable.numbers.push_back(fmt::format("{}[{}]", variable.name, k));
        variable.start.push_back(value(gravity[static_cast<std::size_t>(k)]));
      }
    }
    for (const model::Body& body : mechanism_.bodies)
      if (body.mass.is_constant())
        add_scalar(Role::kConstant, body.name + ".mass", "kg", fmt::format("mass of '{}'", body.name))
            .start = {value(body.mass)};
  }

  double value(const model::Expression& expression) const {
    return expression.evaluate(std::span<const double>(values_));
  }

  const model::Mechanism& mechanism_;
  const SceneFacts& facts_;
  Entries entries_;
  std::vector<double> values_;
  std::vector<Variable> list_;
  std::set<std::string> taken_;
  std::array<std::size_t, kRoles.size()> next_{};
};

}  // namespace

std::string_view role_name(Role role) { return kRoles[static_cast<std::size_t>(role)].name; }

std::string_view quantity_name(Quantity quantity) {
  return kQuantities[static_cast<std::size_t>(quantity)].name;
}

std::vector<Variable> variables_of(const model::Mechanism& mechanism, const loops::LoopPlan* plan,
                                   const SceneFacts& facts) {
  return Table(mechanism, plan, facts).all();
}

}  // namespace jourdain::programs
