#include "commands/model_facts.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "model/joint_kinds.hpp"
#include "model/loop_kinds.hpp"
#include "model/output_kinds.hpp"
#include "programs/entries.hpp"

namespace jourdain::commands {

namespace {

using Json = nlohmann::ordered_json;
using model::Expression;

class Facts {
 public:
  Facts(const LoadedMechanism& loaded, const CompiledModel& compiled)
      : mechanism_(loaded.mechanism),
        loaded_(loaded),
        compiled_(compiled),
        entries_(programs::entries_of(loaded.mechanism, loaded.plan())) {
    for (const model::Parameter& parameter : mechanism_.parameters) values_.push_back(parameter.value);
  }

  Json all() {
    Json facts = head();
    facts["links"] = links();
    facts["frames"] = frames();
    facts["joints"] = joints();
    facts["loops"] = loops();
    facts["positions"] = entries(entries_.positions);
    facts["velocities"] = entries(entries_.velocities);
    facts["inputs"] = inputs();
    facts["outputs"] = outputs();
    facts["parameters"] = parameters();
    return facts;
  }

 private:
  Json head() const {
    Json roots = Json::array();
    for (const model::Joint& joint : mechanism_.joints)
      if (!joint.parent) roots.push_back(mechanism_.bodies[joint.child.value].name);
    Json imported = Json::array();
    for (const support::FileHash& file : loaded_.options.imported)
      imported.push_back({{"model", file.path}, {"sha256", file.sha256}});
    return {{"name", loaded_.options.name},
            {"title", mechanism_.name},
            {"description", mechanism_.description},
            {"source", mechanism_.source},
            {"model", loaded_.options.path},
            {"sha256", loaded_.options.sha256},
            {"imported", imported},
            {"gravity", numbers(mechanism_.gravity)},
            {"degrees_of_freedom", loaded_.freedom()},
            {"roots", roots}};
  }

  double number(const Expression& expression) const {
    return expression.evaluate(std::span<const double>(values_));
  }
  Json numbers(const model::Vector3& vector) const {
    return {number(vector[0]), number(vector[1]), number(vector[2])};
  }

  /// Adds the names of the parameters that the expressions depend on, if there are any.
  void add_dependence(Json& fact, const std::vector<Expression>& expressions) const {
    std::set<std::size_t> used;
    for (const Expression& expression : expressions)
      for (const Expression::Node& node : expression.nodes())
        if (node.op == Expression::Op::kParameter) used.insert(node.parameter.value);
    for (const std::size_t index : used) fact["depends_on"].push_back(mechanism_.parameters[index].name);
  }

  std::string body_name(const std::optional<model::BodyIndex>& body) const {
    return body ? mechanism_.bodies[body->value].name : "world";
  }

  Json links() const {
    Json list = Json::array();
    for (std::size_t b = 0; b < mechanism_.bodies.size(); ++b) {
      const model::Body& body = mechanism_.bodies[b];
      Json link = {{"name", body.name}};
      for (const model::Joint& joint : mechanism_.joints)
        if (joint.child == model::BodyIndex(b)) {
          link["parent"] = body_name(joint.parent);
          link["joint"] = joint.name;
        }
      link["mass"] = number(body.mass);
      link["center_of_mass"] = numbers(body.center_of_mass);
      const model::Vector3& center = body.center_of_mass;
      add_dependence(link, {body.mass, center[0], center[1], center[2]});
      list.push_back(std::move(link));
    }
    return list;
  }

  void add_placement(Json& fact, const model::Placement& placement) const {
    fact["position"] = numbers(placement.position);
    fact["rpy"] = numbers(placement.rotation.rpy);
    std::vector<Expression> all(placement.position.begin(), placement.position.end());
    all.insert(all.end(), placement.rotation.rpy.begin(), placement.rotation.rpy.end());
    add_dependence(fact, all);
  }

  /// Those that the description declares; bodies and the world are frames of their own, too.
  Json frames() const {
    Json list = Json::array();
    for (const model::Frame& frame : mechanism_.frames) {
      const std::string body = body_name(frame.body);
      if (frame.name == body) continue;
      Json fact = {{"name", frame.name}, {"body", body}};
      add_placement(fact, frame.placement);
      list.push_back(std::move(fact));
    }
    return list;
  }

  static Json limits(const model::Limits& limits, const model::Coordinate& coordinate) {
    Json fact = Json::object();
    if (limits.lower) fact["lower"] = *limits.lower;
    if (limits.upper) fact["upper"] = *limits.upper;
    if (limits.velocity) fact["velocity"] = *limits.velocity;
    if (limits.effort) fact["effort"] = *limits.effort;
    fact["units"] = {programs::position_unit(coordinate), programs::velocity_unit(coordinate),
                     programs::force_unit(coordinate)};
    return fact;
  }

  Json joints() const {
    Json list = Json::array();
    for (const model::JointIndex index : model::depth_first(mechanism_)) {
      const model::Joint& joint = mechanism_.joints[index.value];
      const model::JointKind& kind = model::joint_kind(joint);
      Json fact = {{"name", joint.name},
                   {"type", kind.name},
                   {"parent", body_name(joint.parent)},
                   {"child", body_name(joint.child)}};
      if (kind.takes("axis")) fact["axis"] = joint.axis;
      if (kind.takes("second_axis")) fact["second_axis"] = joint.second_axis;
      if (kind.takes("pitch")) fact["pitch"] = number(joint.pitch);
      if (kind.takes("sequence")) fact["sequence"] = model::sequence_text(joint);
      const auto limited = loaded_.limits.find(joint.name);
      if (limited != loaded_.limits.end() && joint.coordinates.size() == 1)
        fact["limits"] = limits(limited->second, joint.coordinates[0]);
      for (const model::Coordinate& coordinate : joint.coordinates)
        if (coordinate.motion) fact["prescribed"].push_back(coordinate.name);
      add_placement(fact, joint.placement);
      list.push_back(std::move(fact));
    }
    return list;
  }

  Json loops() const {
    Json list = Json::array();
    for (const model::Loop& loop : mechanism_.loops) {
      Json fact = {{"name", loop.name}, {"type", model::loop_kind(loop).name}};
      if (model::loop_kind(loop).has_ends()) {
        fact["from"] = mechanism_.frames[loop.from.value].name;
        fact["to"] = mechanism_.frames[loop.to.value].name;
      }
      list.push_back(std::move(fact));
    }
    return list;
  }

  const model::Coordinate* coordinate_of(const programs::Entry& entry) const {
    return entry.coordinate ? &mechanism_.joints[entry.joint->value].coordinates[*entry.coordinate] : nullptr;
  }

  Json entries(const std::vector<programs::Entry>& list) const {
    Json facts = Json::array();
    for (const programs::Entry& entry : list) {
      Json fact = {{"index", facts.size()}, {"name", entry.name}, {"unit", entry.unit}};
      if (entry.joint)
        fact["joint"] = mechanism_.joints[entry.joint->value].name;
      else
        fact["description"] = entry.description;
      fact["initial"] = entry.initial;
      const model::Coordinate* coordinate = coordinate_of(entry);
      if (&list == &entries_.positions && coordinate && coordinate->range) fact["range"] = *coordinate->range;
      facts.push_back(std::move(fact));
    }
    return facts;
  }

  Json inputs() const {
    Json list = Json::array();
    for (const programs::Entry& entry : entries_.inputs) {
      Json fact = {{"index", list.size()}, {"name", entry.name}, {"unit", entry.unit}};
      if (const model::Coordinate* coordinate = coordinate_of(entry))
        fact["coordinate"] = coordinate->name;
      else
        fact["description"] = mechanism_.inputs[list.size() - mechanism_.actuators.size()].description;
      list.push_back(std::move(fact));
    }
    return list;
  }

  Json outputs() const {
    const std::vector<programs::OutputNumber> numbers =
        programs::output_numbers(mechanism_, compiled_.facts.outputs);
    Json list = Json::array();
    for (const model::Output& output : mechanism_.outputs) {
      Json rows = Json::array();
      for (const programs::OutputNumber& number : numbers)
        if (number.output == output.name) rows.push_back({{"name", number.name}, {"unit", number.unit}});
      Json fact = {{"name", output.name}, {"kind", model::output_kind(output.kind).name}};
      if (const std::string of = model::subject_name(mechanism_, output); !of.empty()) fact["of"] = of;
      fact["numbers"] = rows;
      list.push_back(std::move(fact));
    }
    return list;
  }

  Json parameters() const {
    Json list = Json::array();
    for (const model::Parameter& parameter : mechanism_.parameters) {
      Json fact = {{"name", parameter.name},
                   {"value", parameter.value},
                   {"unit", parameter.unit},
                   {"description", parameter.description}};
      if (parameter.range) fact["range"] = *parameter.range;
      list.push_back(std::move(fact));
    }
    return list;
  }

  const model::Mechanism& mechanism_;
  const LoadedMechanism& loaded_;
  const CompiledModel& compiled_;
  programs::Entries entries_;
  std::vector<double> values_;
};

}  // namespace

nlohmann::ordered_json model_facts(const LoadedMechanism& loaded, const CompiledModel& compiled) {
  return Facts(loaded, compiled).all();
}

}  // namespace jourdain::commands
