// [[coupler]]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "model/coupler.hpp"
#include "model/read/keys.hpp"
#include "model/read/toml_coordinate_names.hpp"
#include "model/read/toml_names.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

using support::shown;

/// What the terms of a coupler are in.
enum class Relation { kAngles, kLengths };
constexpr std::array<Relation, 2> kRelations{Relation::kAngles, Relation::kLengths};

class CouplerReader {
 public:
  CouplerReader(TomlFile& file, const toml::table& table, std::size_t number, const Mechanism& mechanism)
      : file_(file),
        source_(table),
        mechanism_(mechanism),
        name_(name_or_number(file, table, "coupler", number)),
        table_(file, table, fmt::format("coupler '{}'", shown(name_)), file.range(table.source()),
               keys_of("coupler")) {}

  /// Nothing after a diagnostic.
  std::optional<Loop> read() {
    const std::size_t mark = file_.error_count();
    const SourceRange where = table_.where("name");
    if (!table_.has("name") || table_.text("name")) check_identifier(file_, where, "coupler", name_);
    is_new_name(file_, where, "loops or couplers", name_, mechanism_.loops);
    std::optional<Loop> loop = table_.has("terms") ? of_terms() : of_follower();
    if (!loop || file_.error_count() != mark) return {};
    if (is_driven(*loop)) {
      file_.error(where, fmt::format("every coordinate of {} has a motion", table_.what()),
                  "one at least must be free to follow");
      return {};
    }
    loop->name = name_;
    loop->where = where;
    return loop;
  }

 private:
  const Coordinate& at(const ScalarCoordinate& c) const {
    return mechanism_.joints[c.joint.value].coordinates[c.coordinate];
  }
  Needed unit_of(const ScalarCoordinate& c) const {
    return coordinate_needs(mechanism_.joints[c.joint.value], c.coordinate).position;
  }
  bool has_unit(const ScalarCoordinate& c) const { return !unit_of(c).units[0].empty(); }

  std::optional<ScalarCoordinate> find(SourceRange where, const std::string& name) {
    return find_scalar(file_, where, table_.what() + " names", name, mechanism_);
  }

  bool is_driven(const Loop& loop) const {
    return !any_variable(loop.residual, [this](const Variable& v) {
      return !mechanism_.joints[v.index].coordinates[v.component].motion;
    });
  }

  std::optional<Loop> of_follower() {
    const auto coordinate = table_.required_text("coordinate"), follows = table_.required_text("follows");
    if (!coordinate || !follows) return {};
    if (*coordinate == *follows) {
      table_.error("follows", fmt::format("coordinate '{}' follows itself", shown(*follows)));
      return {};
    }
    const auto follower = find(table_.where("coordinate"), *coordinate),
               leader = find(table_.where("follows"), *follows);
    if (!follower || !leader) return {};
    const Needed ratio =
        has_unit(*follower) && has_unit(*leader)
            ? factor_of(*leader, at(*follower).angular ? Relation::kAngles : Relation::kLengths)
            : needed::kAnything;
    return coupler("", {.coordinate = *follower,
                        .leader = *leader,
                        .ratio = table_.number("ratio", ratio, 1.0),
                        .offset = table_.number("offset", unit_of(*follower))});
  }

  std::optional<Loop> of_terms() {
    for (const char* key : {"coordinate", "follows", "ratio"})
      if (table_.has(key))
        table_.error(key, fmt::format("{} has 'terms' and '{}'", table_.what(), key),
                     "either terms, or a coordinate that follows another");
    const toml::table* section = table_.table("terms");
    if (!section) return {};
    std::vector<CouplerTerm> terms;
    std::vector<std::string> names;
    for (const auto& [key, node] : *section) {
      names.emplace_back(key.str());
      const SourceRange where = file_.range(key.source());
      if (const auto found = find(where, file_.text(names.back(), where)))
        terms.push_back({found->joint, found->coordinate, 1.0});
    }
    if (names.size() < 2)
      table_.error("terms", fmt::format("{} needs two coordinates or more", table_.quoted("terms")),
                   "their factors: { left = 1, right = 1 }");
    if (names.size() < 2 || terms.size() != names.size()) return {};
    const TomlTable factors(file_, *section, fmt::format("'terms' of {}", table_.what()),
                            table_.where("terms"), names);
    const std::optional<Relation> relation = relation_of(*section, names, terms);
    for (std::size_t k = 0; k < terms.size(); ++k) read_factor(factors, names[k], relation, terms[k]);
    return coupler("", terms, table_.number("offset", offset_needs(relation)));
  }

  void read_factor(const TomlTable& factors, const std::string& name, const std::optional<Relation>& relation,
                   CouplerTerm& term) {
    const std::size_t mark = file_.error_count();
    const ScalarCoordinate coordinate{term.joint, term.coordinate};
    term.factor = factors.number(name, relation ? factor_of(coordinate, *relation) : needed::kAnything);
    if (file_.error_count() == mark && term.factor.is_zero())
      factors.error(name, fmt::format("{} is zero", factors.quoted(name)), "leave the coordinate out");
  }

  /// Of a coordinate's factor, where the products are angles or lengths.
  Needed factor_of(const ScalarCoordinate& coordinate, Relation relation) const {
    if (at(coordinate).angular == (relation == Relation::kAngles)) return needed::kPure;
    return relation == Relation::kLengths ? needed::kPitch : Needed{{"rad/m"}};
  }

  static Needed offset_needs(const std::optional<Relation>& relation) {
    if (!relation) return needed::kAnything;
    return *relation == Relation::kAngles ? needed::kAngle : needed::kLength;
  }

  /// That in which all factors fit; where none is, that of the first coordinate. Nothing where the unit of a
  /// coordinate is not known.
  std::optional<Relation> relation_of(const toml::table& section, const std::vector<std::string>& names,
                                      const std::vector<CouplerTerm>& terms) const {
    const auto has_unit_of = [this](const CouplerTerm& t) { return has_unit({t.joint, t.coordinate}); };
    if (!std::all_of(terms.begin(), terms.end(), has_unit_of)) return {};
    for (const Relation relation : kRelations) {
      support::Diagnostics unseen(file_.diagnostics().path(), file_.diagnostics().text());
      TomlFile trial(unseen);
      trial.declare(mechanism_);
      const TomlTable factors(trial, section, "", {}, names);
      for (std::size_t k = 0; k < terms.size(); ++k)
        factors.number(names[k], factor_of({terms[k].joint, terms[k].coordinate}, relation));
      TomlTable(trial, source_, "", {}, keys_of("coupler")).number("offset", offset_needs(relation));
      if (trial.error_count() == 0) return relation;
    }
    return at({terms[0].joint, terms[0].coordinate}).angular ? Relation::kAngles : Relation::kLengths;
  }

  TomlFile& file_;
  const toml::table& source_;
  const Mechanism& mechanism_;
  std::string name_;
  TomlTable table_;
};

}  // namespace

void read_couplers(TomlFile& file, const TomlTables& section, Mechanism& mechanism) {
  std::size_t number = 0;
  for (const toml::node& node : section)
    if (auto loop = CouplerReader(file, *node.as_table(), ++number, mechanism).read())
      mechanism.loops.push_back(std::move(*loop));
  start_followers(mechanism);
}

}  // namespace jourdain::model
