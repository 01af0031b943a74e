#include "commands/fmu_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "emit/file_text.hpp"
#include "emit/what_depends.hpp"

namespace jourdain::commands {

using programs::Role;
using programs::Variable;

namespace {

bool contains(const std::vector<std::size_t>& list, std::size_t entry) {
  return std::find(list.begin(), list.end(), entry) != list.end();
}

class Numbers {
 public:
  Numbers(const FmuScene& scene, const std::vector<Variable>& table, const ir::Module& module)
      : scene_(scene), facts_(scene.facts) {
    add({"time", "time of the simulation", "s", Role::kTime});
    for (const Variable& variable : table)
      if (variable.role != Role::kTime) add_all(variable);
    for (std::size_t k = 0; k < list_.size(); ++k) references_[{list_[k].role, list_[k].index}] = k;
    std::size_t k = 1;
    for (const Variable& variable : table) {
      if (variable.role == Role::kTime) continue;
      const std::vector<std::string> rows = emit::what_depends(variable, facts_, module);
      for (std::size_t i = 0; i < variable.numbers.size(); ++i, ++k)
        relate(list_[k], i < rows.size() ? rows[i] : "");
    }
  }

  const std::vector<FmuNumber>& list() const { return list_; }

 private:
  void add(FmuNumber number) {
    std::string name = number.name;
    if (used_.count(name)) name += "_" + std::string(programs::role_name(number.role));
    while (!used_.insert(name).second) name += "_";
    number.name = name;
    list_.push_back(std::move(number));
  }

  void add_all(const Variable& variable) {
    for (std::size_t i = 0; i < variable.numbers.size(); ++i) {
      FmuNumber number{variable.numbers[i], variable.description, variable.unit, variable.role,
                       variable.index + i};
      if (i < variable.start.size()) number.start = variable.start[i];
      number.range = variable.range;
      if (variable.role == Role::kVelocity) number.nominal = nominal(number.index);
      number.is_state = variable.role == Role::kVelocity ||
                        (variable.role == Role::kPosition && contains(scene_.positions, number.index));
      if (variable.role == Role::kPosition && !number.is_state) number.start.reset();
      add(std::move(number));
    }
  }

  /// Of an entry of z; nothing but of states.
  std::optional<double> nominal(std::size_t velocity) const {
    if (velocity < scene_.facts.moving()) return {};
    std::vector<double> values;
    for (const model::Parameter& parameter : scene_.facts.parameters) values.push_back(parameter.value);
    const model::StateVariable& state = scene_.facts.states[velocity - scene_.facts.moving()];
    return state.nominal.evaluate<double>(values);
  }

  std::size_t reference(Role role, std::size_t index) const { return references_.at({role, index}); }

  /// What a number is the rate of, and what it depends on.
  void relate(FmuNumber& number, const std::string& row) const {
    if (number.role == Role::kAcceleration) number.derivative_of = reference(Role::kVelocity, number.index);
    if (number.role == Role::kPositionRate && contains(scene_.positions, number.index))
      number.derivative_of = reference(Role::kPosition, number.index);
    if (number.is_state) {
      number.depends_on = {{reference(number.role, number.index)}};
    } else if (number.role == Role::kPosition) {
      std::set<std::size_t> known;
      add_independent(known);
      number.depends_on = std::vector<std::size_t>(known.begin(), known.end());
    } else if (!row.empty() && !(scene_.drifts && !facts_.constraints.empty())) {
      number.depends_on = known_of(row, number);
    }
  }

  /// What dependent positions follow from.
  void add_independent(std::set<std::size_t>& known) const {
    if (facts_.time.positions) known.insert(0);
    for (const std::size_t position : scene_.positions) known.insert(reference(Role::kPosition, position));
  }

  /// With one part of a quaternion all others: they are brought to the norm one first.
  void add_position(std::set<std::size_t>& known, std::size_t position) const {
    if (!contains(scene_.positions, position)) return add_independent(known);
    known.insert(reference(Role::kPosition, position));
    for (const model::Tangent::Scalar& quaternion : facts_.tangent.quaternions)
      for (std::size_t part = 0; part < 4; ++part)
        if (position >= quaternion.position && position < quaternion.position + 4)
          known.insert(reference(Role::kPosition, quaternion.position + part));
  }

  /// `row` has a '1' or '0' for t, each entry of y, of z and of u.
  std::vector<std::size_t> known_of(const std::string& row, const FmuNumber& number) const {
    const std::size_t ny = facts_.positions.size(), nz = facts_.velocities.size();
    std::set<std::size_t> known;
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (row[k] != '1') continue;
      if (k == 0)
        known.insert(0);
      else if (k <= ny)
        add_position(known, k - 1);
      else
        known.insert(k <= ny + nz ? reference(Role::kVelocity, k - 1 - ny)
                                  : reference(Role::kInput, k - 1 - ny - nz));
    }
    if (number.role == Role::kPositionRate && scene_.drifts && number.derivative_of)
      for (const model::Tangent::Scalar& quaternion : facts_.tangent.quaternions)
        if (number.index >= quaternion.position && number.index < quaternion.position + 4)
          add_position(known, number.index);
    return {known.begin(), known.end()};
  }

  const FmuScene& scene_;
  const programs::SceneFacts& facts_;
  std::vector<FmuNumber> list_;
  std::set<std::string> used_;
  std::map<std::pair<Role, std::size_t>, std::size_t> references_;
};

}  // namespace

bool has_fmu_derivatives(const programs::SceneFacts& facts) {
  return !facts.velocities.empty() && facts.tangent.quaternions.empty() &&
         (facts.constraints.empty() || facts.is_reduced) &&
         (facts.carried.empty() || facts.dependents.empty());
}

FmuScene fmu_scene(const model::Mechanism& mechanism, const CompileOptions& options,
                   const CompiledModel& compiled, const std::string& method, double step) {
  FmuScene scene;
  scene.name = options.name;
  scene.title = mechanism.name;
  scene.description = mechanism.description;
  scene.generator = fmt::format("Jourdain {}", emit::kVersion);
  scene.method = method;
  scene.step = step;
  scene.facts = compiled.facts;
  const programs::SceneFacts& facts = scene.facts;
  scene.correction = programs::correction(facts);
  scene.has_derivatives = has_fmu_derivatives(facts);
  scene.drifts = !facts.tangent.quaternions.empty() || (!facts.constraints.empty() && !facts.is_reduced);
  for (std::size_t k = 0; k < facts.positions.size(); ++k)
    if (!contains(facts.dependents, k)) scene.positions.push_back(k);
  scene.numbers =
      Numbers(scene, programs::variables_of(mechanism, options.loops ? &*options.loops : nullptr, facts),
              compiled.module)
          .list();
  return scene;
}

std::vector<std::size_t> state_references(const FmuScene& scene) {
  std::vector<std::size_t> references;
  for (const Role role : {Role::kPosition, Role::kVelocity})
    for (std::size_t k = 0; k < scene.numbers.size(); ++k)
      if (scene.numbers[k].role == role && scene.numbers[k].is_state) references.push_back(k);
  return references;
}

}  // namespace jourdain::commands
