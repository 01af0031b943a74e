#include "model/read/toml_import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "model/names.hpp"
#include "model/read/followers.hpp"
#include "model/read/import_file.hpp"
#include "model/read/import_merge.hpp"
#include "model/read/keys.hpp"
#include "model/read/lock.hpp"

namespace jourdain::model {

namespace {

using support::shown;

/// An entry of 'parameters': what takes the place of a parameter of the imported file.
struct Bound {
  std::string name;
  const toml::node* node = nullptr;
  SourceRange where;
  Expression expression;
  double value = 0;
};

/// One table [[import]].
class ImportReader {
 public:
  ImportReader(TomlFile& file, const toml::node& node, const ReadOptions& options, const ImportChain& chain)
      : file_(file),
        options_(options),
        chain_(chain),
        table_(file, *node.as_table(), "an import", file.range(node.source()), keys_of("import")) {}

  /// Nothing where nothing was merged, after a diagnostic.
  std::optional<Import> read(Mechanism& mechanism) {
    Import import;
    read_names(import);
    import.placement = {table_.vector("position", needed::kLength), table_.rotation("rpy")};
    read_bound();
    FoundFile found = name_.empty() ? FoundFile() : find_import(name_, file_.diagnostics().path(), chain_);
    if (!found.problem.empty()) error("file", found.problem, found.hint);
    if (name_.empty() || !found.problem.empty()) return {};
    ReadOptions options = part_options();
    options.importing = &found.chain;
    support::Diagnostics diagnostics(found.path, std::move(found.text));
    std::optional<Part> part = read_part(diagnostics, options);
    std::vector<std::string> locked;
    for (const auto& [joint, where] : locked_) locked.push_back(joint);
    if (part && part->complete.structure && !locked.empty())
      settle_followers(part->mechanism, locked, diagnostics);
    const int number = file_.diagnostics().absorb(std::move(diagnostics), table_.where("file"));
    if (!part) return {};
    file_.complete().structure = file_.complete().structure && part->complete.structure;
    file_.complete().numbers = file_.complete().numbers && part->complete.numbers;
    for (const auto& [joint, where] : locked_) lock_joint(joint, where, part->mechanism);
    for (std::size_t k = locked_.size(); k < locked.size(); ++k)
      lock_joint(locked[k], table_.where("lock"), part->mechanism);
    import.has_loop_options = part->mechanism.loop_options.where.line > 0;
    if (!merge(std::move(*part), number, mechanism, import.range)) return {};
    return import;
  }

 private:
  void error(std::string_view key, std::string message, std::string hint = "") {
    file_.complete().structure = false;
    table_.error(key, std::move(message), std::move(hint));
  }

  void read_names(Import& import) {
    name_ = table_.required_text("file").value_or("");
    prefix_ = table_.text("prefix").value_or("");
    if (!prefix_.empty() && !is_identifier(prefix_))
      error("prefix", fmt::format("no name begins with the prefix '{}'", shown(prefix_)),
            "letters, digits and '_' only, and no digit first");
    import.file = name_;
    import.prefix = prefix_;
    import.where = table_.where("file");
    import.parent = table_.has("parent") ? table_.required_text("parent").value_or("world") : "world";
    import.parent_where = table_.where(table_.has("parent") ? "parent" : "file");
  }

  void read_bound() {
    const toml::table* section = table_.table("parameters");
    if (!section) return;
    for (const auto& [key, node] : *section) {
      Bound bound{std::string(key.str()), &node, file_.range(key.source()), 0.0};
      const std::size_t mark = file_.error_count();
      bound.expression =
          file_.expression(node, {fmt::format("parameter '{}'", shown(bound.name)), needed::kAnything});
      if (file_.error_count() != mark) continue;
      bound.value = file_.value(bound.expression);
      bound_.push_back(std::move(bound));
    }
  }

  ReadOptions part_options() {
    ReadOptions options;
    options.damping = options_.damping;
    options.friction = options_.friction;
    options.mimic = options_.mimic;
    options.snap = options_.snap;
    options.external = options_.external;
    options.prefix = options_.prefix + prefix_;
    if (name_.ends_with(".toml")) {
      for (const char* key : {"root", "damping"})
        if (table_.has(key))
          table_.error(key, fmt::format("a TOML file is imported without '{}'", key),
                       "[[override]] changes it");
    } else {
      options.root = table_.choice("root", {"fixed", "free"}) == 1 ? RootJoint::kFree : RootJoint::kFixed;
      read_damping(options);
    }
    read_locked();
    for (const auto& [joint, where] : locked_) options.locked_joints.push_back(joint);
    for (const std::string& name : options_.locked_joints)
      if (name.starts_with(prefix_)) options.locked_joints.push_back(name.substr(prefix_.size()));
    for (const Bound& bound : bound_) options.parameters[bound.name] = bound.value;
    for (const auto& [name, value] : options_.parameters)
      if (name.starts_with(prefix_)) options.parameters.emplace(name.substr(prefix_.size()), value);
    return options;
  }

  void read_damping(ReadOptions& options) {
    if (!table_.has("damping")) return;
    const toml::value<bool>* damping = table_.find("damping")->as_boolean();
    if (!damping)
      return table_.error("damping", fmt::format("{} must be true or false, not {}", table_.quoted("damping"),
                                                 type_in_words(*table_.find("damping"))));
    options.damping = options.damping && damping->get();
  }

  void read_locked() {
    if (!table_.has("lock")) return;
    const toml::array* names = table_.find("lock")->as_array();
    const bool texts = names && (names->empty() || names->is_homogeneous(toml::node_type::string));
    if (!texts)
      return table_.error("lock", fmt::format("{} must be a list of names of joints", table_.quoted("lock")));
    for (const toml::node& node : *names)
      locked_.emplace_back(file_.text(*node.as_string()), file_.range(node.source()));
  }

  void lock_joint(const std::string& name, const SourceRange& where, Mechanism& part) {
    std::vector<std::string> names;
    for (const Joint& joint : part.joints) names.push_back(joint.name);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) return lock(part, JointIndex(static_cast<std::size_t>(found - names.begin())));
    const std::string close = support::nearest(name, names);
    if (!close.empty() || file_.complete().structure)
      file_.error(where, fmt::format("'{}' has no joint '{}' to lock", shown(name_), shown(name)),
                  close.empty() ? "" : fmt::format("did you mean '{}'?", shown(close)));
  }

  bool merge(Part part, int number, Mechanism& mechanism, MergedRange& range) {
    Mechanism& added = part.mechanism;
    const Merge how{bind(added), number};
    add_prefix(added, prefix_);
    check_names(added);
    check_room(added, mechanism);
    for (Body& body : added.bodies)
      body.lenient = body.lenient || part.triangle == support::Severity::kWarning;
    added.imports.insert(added.imports.begin(), {0, prefix_});
    range = {mechanism.joints.size(), mechanism.joints.size() + added.joints.size(),
             mechanism.frames.size(), mechanism.frames.size() + added.frames.size(),
             mechanism.loops.size(),  mechanism.loops.size() + added.loops.size()};
    if (model::merge(mechanism, std::move(added), how)) return true;
    error("parameters", fmt::format("an expression of '{}' would have more than {} operations", shown(name_),
                                    kMaximumExpressionSize));
    return false;
  }

  /// By parameter of the part.
  std::vector<std::optional<Expression>> bind(const Mechanism& part) {
    std::vector<std::optional<Expression>> result(part.parameters.size());
    for (const Bound& bound : bound_) {
      const auto parameter = std::find_if(part.parameters.begin(), part.parameters.end(),
                                          [&](const Parameter& p) { return p.name == bound.name; });
      if (parameter == part.parameters.end())
        report_unknown(part, bound);
      else if (is_fit(bound, *parameter))
        result[static_cast<std::size_t>(parameter - part.parameters.begin())] = bound.expression;
    }
    return result;
  }

  bool is_fit(const Bound& bound, const Parameter& parameter) {
    const std::string what = fmt::format("parameter '{}' of '{}'", shown(bound.name), shown(name_));
    const std::size_t mark = file_.error_count();
    if (!parameter.unit.empty()) file_.expression(*bound.node, {what, {{parameter.unit}}});
    if (file_.error_count() != mark) return false;
    const bool inside =
        !parameter.range || ((*parameter.range)[0] <= bound.value && bound.value <= (*parameter.range)[1]);
    if (!inside)
      file_.error(bound.where, fmt::format("{} is {}, outside its range from {} to {}", what, bound.value,
                                           (*parameter.range)[0], (*parameter.range)[1]));
    return inside;
  }

  void report_unknown(const Mechanism& part, const Bound& bound) {
    std::vector<std::string> names;
    for (const Parameter& parameter : part.parameters) names.push_back(parameter.name);
    const bool derived = std::any_of(part.derived.begin(), part.derived.end(),
                                     [&](const DerivedParameter& d) { return d.name == bound.name; });
    const std::string close = support::nearest(bound.name, names);
    if (derived)
      file_.error(bound.where,
                  fmt::format("parameter '{}' of '{}' follows from others", shown(bound.name), shown(name_)),
                  "give those");
    else
      file_.error(bound.where, fmt::format("'{}' has no parameter '{}'", shown(name_), shown(bound.name)),
                  close.empty() ? "" : fmt::format("did you mean '{}'?", shown(close)));
  }

  /// Names that go into emitted code as they are.
  void check_names(const Mechanism& added) {
    std::vector<std::string> names;
    for (const Parameter& parameter : added.parameters) names.push_back(parameter.name);
    for (const Output& output : added.outputs) names.push_back(output.name);
    for (const KinematicFunction& function : added.kinematics) names.push_back(function.name);
    for (const std::string& name : names)
      if (is_reserved(name) || name.find("__") != std::string::npos)
        return error(
            prefix_.empty() ? "file" : "prefix",
            fmt::format("'{}' of '{}' would be a name that is reserved in C++", shown(name), shown(name_)),
            "another prefix makes it another one");
  }

  void check_room(const Mechanism& added, const Mechanism& mechanism) {
    if (const std::optional<NameClash> clash = name_clash(mechanism, added))
      error("file", fmt::format("there are two {}, one in '{}'", clash->what, shown(name_)),
            fmt::format("{}a prefix tells them apart",
                        clash->first.line > 0
                            ? fmt::format("the first at {}; ", file_.line_in_words(clash->first))
                            : ""));
    if (mechanism.bodies.size() + added.bodies.size() > kMaximumBodies)
      error("file", fmt::format("with '{}' there are more than {} bodies", shown(name_), kMaximumBodies));
  }

  TomlFile& file_;
  const ReadOptions& options_;
  const ImportChain& chain_;
  TomlTable table_;
  std::string name_, prefix_;
  std::vector<Bound> bound_;
  std::vector<std::pair<std::string, SourceRange>> locked_;
};

/// What 'parent' names; nothing after a diagnostic.
std::optional<Attachment> find_place(TomlFile& file, const Import& import, const Mechanism& mechanism) {
  Attachment place{{}, {}, import.placement, import.prefix, import.where};
  if (import.parent == "world") return place;
  std::vector<std::string> names;
  for (std::size_t b = 0; b < mechanism.bodies.size(); ++b) {
    names.push_back(mechanism.bodies[b].name);
    place.body = BodyIndex(b);
    if (names.back() == import.parent) return place;
  }
  for (const Frame& frame : mechanism.frames) {
    names.push_back(frame.name);
    place.body = frame.body;
    place.outer = frame.placement;
    if (frame.name == import.parent) return place;
  }
  const std::string close = support::nearest(import.parent, names);
  if (!close.empty() || file.complete().structure)
    file.error(import.parent_where,
               fmt::format("an import names unknown frame or body '{}'", shown(import.parent)),
               close.empty() ? "" : fmt::format("did you mean '{}'?", shown(close)));
  file.complete().structure = false;
  return {};
}

}  // namespace

std::vector<Import> read_imports(TomlFile& file, const TomlTables& section, const ReadOptions& options,
                                 const ImportChain& chain, Mechanism& mechanism) {
  std::vector<Import> imports;
  for (const toml::node& node : section) {
    std::optional<Import> import = ImportReader(file, node, options, chain).read(mechanism);
    if (import)
      imports.push_back(std::move(*import));
    else
      file.complete().structure = false;
    file.declare(mechanism);
  }
  return imports;
}

void attach_imports(TomlFile& file, const std::vector<Import>& imports, Mechanism& mechanism) {
  for (const Import& import : imports) {
    const std::optional<Attachment> place = find_place(file, import, mechanism);
    if (!place) continue;
    if (const std::optional<JointIndex> free = attach(mechanism, import.range, *place))
      file.error(import.parent_where,
                 fmt::format("joint '{}' of '{}' is free: its parent can be the world only",
                             shown(mechanism.joints[free->value].name), shown(import.file)));
  }
}

}  // namespace jourdain::model
