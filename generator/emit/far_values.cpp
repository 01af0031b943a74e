#include "emit/far_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace jourdain::emit {

namespace {

/// Statements from one read to the next, as many as what 32 registers hold lasts.
constexpr std::size_t kNear = 30;
/// Reads of a window's entry where a variable would take an instruction of its own.
constexpr std::size_t kFewReads = 3;
/// Reals of a window.
constexpr std::size_t kWindow = 32;
/// Addresses that x86-64 has registers for, and compilers a few to spare.
constexpr std::size_t kAddresses = 14;

using Count = std::map<std::string, std::size_t>;

void count_names(const Expression& expression, Count& count) {
  if (expression.kind == Expression::Kind::kName) ++count[expression.name];
  for (const Expression& operand : expression.operands) count_names(operand, count);
}

/// Names that a statement reads or writes, but for those that it declares. Statements that hold others, and
/// calls of other functions, are left as they are.
struct Named {
  Count names;
  bool is_simple = false;

  explicit Named(const Statement& statement) { std::visit(*this, statement.is); }

  void operator()(const Declare& declare) {
    is_simple = true;
    for (const Variable& variable : declare.variables) {
      if (variable.value) count_names(*variable.value, names);
      for (const Expression& entry : variable.entries) count_names(entry, names);
    }
  }
  void operator()(const Set& set) {
    is_simple = true;
    for (const Expression& target : set.targets) count_names(target, names);
    count_names(set.value, names);
  }
  void operator()(const Call& call) {
    is_simple = is_of_sines(call);
    for (const Expression& argument : call.arguments) count_names(argument, names);
  }
  void operator()(const SineCosine& pair) {
    count_names(pair.angle, names);
    ++names[pair.sine];
    ++names[pair.cosine];
  }
  void operator()(const Loop& loop) {
    count_names(loop.first, names);
    count_names(loop.end, names);
    inside(loop.body);
  }
  void operator()(const AtStart& start) {
    count_names(start.left, names);
    count_names(start.right, names);
    inside(start.then);
    inside(start.otherwise);
  }
  void operator()(const Return& result) { count_names(result.value, names); }
  void operator()(const Nearby& nearby) { ++names[nearby.window]; }

  static bool is_of_sines(const Call& call) {
    return call.is_support && call.function.starts_with("sine_cosine");
  }

 private:
  void inside(const Statements& body) {
    for (const Statement& statement : body)
      for (const auto& [name, count] : Named(statement).names) names[name] += count;
  }
};

/// Where a value is computed and read.
struct Value {
  std::size_t computed = 0;  ///< statement
  std::size_t width = 1;     ///< reals
  bool of_sines = false;     ///< is written by a call
  bool stays = false;        ///< in a variable
  std::vector<std::size_t> reads = {};
};

struct Read {
  std::string value;
  std::vector<std::size_t> statements;
};

class FarValues {
 public:
  explicit FarValues(const Statements& body) : body_(body), reads_at_(body.size()) {
    find_values();
    find_far();
  }

  bool any() const { return !slots_.empty(); }

  Statements result() {
    for (std::size_t i = 0; i < body_.size(); ++i) add(i);
    Statements declared;
    for (const auto& [width, count] : used_) declared.push_back(windows(width, count));
    declared.insert(declared.end(), made_.begin(), made_.end());
    return declared;
  }

 private:
  void find_values() {
    for (std::size_t i = 0; i < body_.size(); ++i) {
      const Named named(body_[i]);
      for (const auto& [name, count] : named.names) {
        taken_.insert(name);
        const auto it = values_.find(name);
        if (it == values_.end()) continue;
        if (!named.is_simple) it->second.stays = true;
        if (it->second.computed < i) it->second.reads.push_back(i);
      }
      if (const auto* declare = std::get_if<Declare>(&body_[i].is)) find_declared(*declare, i);
    }
  }

  void find_declared(const Declare& declare, std::size_t i) {
    const bool is_of_numbers =
        declare.type.kind == Type::Kind::kReal || declare.type.kind == Type::Kind::kLanes;
    const auto* call = i + 1 < body_.size() ? std::get_if<Call>(&body_[i + 1].is) : nullptr;
    for (const Variable& variable : declare.variables) {
      taken_.insert(variable.name);
      if (!is_of_numbers || !variable.extents.empty()) continue;
      const std::size_t width = declare.type.kind == Type::Kind::kLanes ? std::size_t(declare.type.depth) : 1;
      if (declare.change == Declare::Change::kConstant && declare.variables.size() == 1 && variable.value)
        values_[variable.name] = {i, width};
      else if (declare.change == Declare::Change::kFree && !variable.value && call &&
               Named::is_of_sines(*call))
        values_[variable.name] = {i + 1, width, true};
    }
  }

  /// In the order of their computation, so that what is computed together is addressed together.
  void find_far() {
    std::vector<std::pair<std::size_t, std::string>> order;
    for (const auto& [name, value] : values_) order.emplace_back(value.computed, name);
    std::sort(order.begin(), order.end());
    for (const auto& [computed, name] : order) {
      const Value& value = values_.at(name);
      std::vector<std::vector<std::size_t>> groups(1);
      std::size_t last = computed;
      for (const std::size_t i : value.reads) {
        if (i - last > kNear) groups.emplace_back();
        groups.back().push_back(i);
        last = i;
      }
      if (value.stays || groups.size() == 1) continue;
      slots_[name] = used_[value.width]++;
      if (!value.of_sines) groups.erase(groups.begin());  // read from the variable
      for (std::vector<std::size_t>& group : groups)
        if (!group.empty()) {
          const std::size_t first = group.front();
          reads_at_[first].push_back({name, std::move(group)});
        }
    }
  }

  void add(std::size_t i) {
    for (const Read& read : reads_at_[i]) begin(read);
    Statement statement = body_[i];
    std::visit([this, i](auto& is) { replace(is, i); }, statement.is);
    if (const auto* declare = std::get_if<Declare>(&statement.is); !declare || !declare->variables.empty())
      made_.push_back(std::move(statement));
    if (const auto* declare = std::get_if<Declare>(&body_[i].is))
      for (const Variable& variable : declare->variables)
        if (slots_.count(variable.name) && !values_.at(variable.name).of_sines) {
          const Expression entry = entry_of(variable.name);
          made_.push_back(set(entry, name(variable.name)));
        }
  }

  /// Reads that follow each other closely: of the entry itself where they are few, otherwise of a variable.
  void begin(const Read& read) {
    const bool is_read_itself =
        read.statements.size() <= kFewReads &&
        std::all_of(read.statements.begin(), read.statements.end(),
                    [&](std::size_t i) { return Named(body_[i]).names.at(read.value) == 1; });
    for (const std::size_t i : read.statements) replaced_[{i, read.value}] = "";
    if (is_read_itself) return;
    const std::string variable = unique(read.value + "_");
    const Expression entry = entry_of(read.value);
    made_.push_back({Declare{
        type_of(values_.at(read.value).width), Declare::Change::kConstant, {{variable, {}, entry}}}});
    for (const std::size_t i : read.statements) replaced_[{i, read.value}] = variable;
  }

  void replace(Declare& declare, std::size_t i) {
    std::erase_if(declare.variables, [this](const Variable& variable) {
      return slots_.count(variable.name) && values_.at(variable.name).of_sines;
    });
    for (Variable& variable : declare.variables)
      if (variable.value) replace(*variable.value, i);
  }
  void replace(Set& set, std::size_t i) {
    for (Expression& target : set.targets) replace(target, i);
    replace(set.value, i);
  }
  void replace(Call& call, std::size_t i) {
    for (Expression& argument : call.arguments) replace(argument, i);
  }
  void replace(Expression& expression, std::size_t i) {
    for (Expression& operand : expression.operands) replace(operand, i);
    if (expression.kind != Expression::Kind::kName) return;
    const auto it = slots_.find(expression.name);
    if (it == slots_.end()) return;
    const Value& value = values_.at(expression.name);
    const auto read = replaced_.find({i, expression.name});
    if (read != replaced_.end() && !read->second.empty())
      expression.name = read->second;
    else if (read != replaced_.end() || (value.of_sines && value.computed == i))
      expression = entry_of(expression.name);
  }
  template <class Other>
  void replace(Other&, std::size_t) {}  // has no values that move

  /// The entry of a window that is addressed, now if it was not.
  Expression entry_of(const std::string& value) {
    const std::size_t width = values_.at(value).width, of_window = kWindow / width, slot = slots_.at(value);
    const std::pair<std::size_t, std::size_t> window = {width, slot / of_window};
    const auto at = std::find_if(addressed_.begin(), addressed_.end(),
                                 [&](const auto& known) { return known.first == window; });
    if (at == addressed_.end()) {
      if (addressed_.size() == kAddresses) addressed_.erase(addressed_.begin());
      const std::string variable = unique(fmt::format("near{}", addresses_++));
      made_.push_back({Nearby{type_of(width), of_window, variable, window_name(width, window.second)}});
      addressed_.emplace_back(window, variable);
    } else {
      std::rotate(at, at + 1, addressed_.end());
    }
    return name(addressed_.back().second)[slot % of_window];
  }

  Statement windows(std::size_t width, std::size_t count) {
    Declare declare{type_of(width), Declare::Change::kFree, {}};
    for (std::size_t k = 0; k * kWindow < count * width; ++k)
      declare.variables.push_back({window_name(width, k), {kWindow / width}});
    return {std::move(declare)};
  }

  std::string window_name(std::size_t width, std::size_t k) {
    std::string& name = window_names_[{width, k}];
    if (name.empty()) name = unique(fmt::format("far{}_{}", width, k));
    return name;
  }

  static Type type_of(std::size_t width) {
    return width == 1 ? Type{} : Type{Type::Kind::kLanes, {}, false, int(width)};
  }

  std::string unique(std::string wanted) {
    while (!taken_.insert(wanted).second) wanted += "_";
    return wanted;
  }

  const Statements& body_;
  std::set<std::string> taken_;
  std::map<std::string, Value> values_;
  std::map<std::string, std::size_t> slots_;  ///< of values that are far from a read, by width
  std::map<std::size_t, std::size_t> used_;   ///< slots of each width
  std::vector<std::vector<Read>> reads_at_;   ///< that begin at a statement
  std::map<std::pair<std::size_t, std::string>, std::string> replaced_;  ///< variable; empty: the entry
  std::map<std::pair<std::size_t, std::size_t>, std::string> window_names_;
  std::vector<std::pair<std::pair<std::size_t, std::size_t>, std::string>>
      addressed_;  ///< the last ones, by use
  std::size_t addresses_ = 0;
  Statements made_;
};

}  // namespace

std::optional<Statements> with_far_values(const Statements& body) {
  FarValues values(body);
  if (!values.any()) return {};
  return values.result();
}

}  // namespace jourdain::emit
