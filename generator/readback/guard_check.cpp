// loops_closed and loops_proven at their limits.
#include <cmath>
#include <limits>

#include "readback/header_check.hpp"
#include "readback/interpreter.hpp"
#include "readback/tokens.hpp"

namespace jourdain::readback {

namespace {

/// IEEE numbers of 64 bits, with infinities and NaN.
class Doubles : public Domain {
 public:
  Number literal(double value) override {
    values_.push_back(value);
    return static_cast<Number>(values_.size() - 1);
  }
  bool is_less(Number a, Number b) override { return values_[a] < values_[b]; }
  bool is_at_most(Number a, Number b) override { return values_[a] <= values_[b]; }

 protected:
  Number apply(ir::Op, Number, Number) override { throw Refusal("arithmetic where only comparisons belong"); }
  bool is_literal(Number) const override { return false; }

 private:
  std::vector<double> values_;
};

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

double above(double x) { return std::nextafter(x, kInfinity); }
double below(double x) { return std::nextafter(x, -kInfinity); }

/// A scalar of an object, the values that it takes in turn, and for which of them the answer is yes.
struct Probe {
  std::string member;
  int index = -1;
  double low = -kInfinity, high = kInfinity;  ///< yes from low to high
  std::vector<double> values() const {
    std::vector<double> list = {kNan, kInfinity, -kInfinity, 0};
    for (const double limit : {low, high})
      if (std::isfinite(limit)) list.insert(list.end(), {limit, above(limit), below(limit), -limit});
    return list;
  }
  bool holds(double value) const { return low <= value && value <= high; }
  double good() const { return std::isfinite(low) ? low : std::isfinite(high) ? high : 0; }
  double bad() const { return std::isfinite(low) ? below(low) : above(high); }
};

class GuardCheck {
 public:
  GuardCheck(const Unit& unit, Findings& findings, const std::string& function, const std::string& object)
      : findings_(findings), function_(function), in_c_(unit.is_c), run_(unit, domain_) {
    model_ = of_number("Model");
    object_ = run_.make(of_number(object));
  }

  void check(const std::vector<Probe>& probes) {
    std::vector<double> values;
    for (const Probe& probe : probes) values.push_back(probe.good());
    ask(probes, values);
    for (std::size_t k = 0; k < probes.size(); ++k)
      for (const double value : probes[k].values()) {
        std::vector<double> changed = values;
        changed[k] = value;
        ask(probes, changed);
      }
    for (std::size_t k = 0; k < probes.size(); ++k) values[k] = probes[k].bad();
    ask(probes, values);
  }

 private:
  const Type* of_number(const std::string& name) {
    return run_.types().instance(name, {{0, run_.types().number(), 0}});
  }

  void ask(const std::vector<Probe>& probes, const std::vector<double>& values) {
    bool wanted = true;
    for (std::size_t i = 0; i < object_.type->cells; ++i)
      run_.cell(object_, i) = number_cell(domain_.literal(kNan));
    for (std::size_t k = 0; k < probes.size(); ++k) {
      Value place = run_.field(object_, probes[k].member);
      if (probes[k].index >= 0) place = run_.entry(place, static_cast<std::size_t>(probes[k].index));
      run_.set(place, domain_.literal(values[k]));
      wanted = wanted && probes[k].holds(values[k]);
    }
    ++findings_.numbers;
    const Value argument = Interpreter::as_const(object_);
    const bool holds = in_c_ ? run_.call("", function_, {argument}).integer != 0
                             : run_.call_member(model_, function_, {argument});
    if (holds != wanted)
      findings_.add("{} is {} where it must be {}, at {}", function_, !wanted, wanted,
                    fmt::join(values, ", "));
  }

  Findings& findings_;
  std::string function_;
  bool in_c_;
  Doubles domain_;
  Interpreter run_;
  const Type* model_ = nullptr;
  Value object_;
};

}  // namespace

void check_guards(const Unit& unit, const Expected& expected, Findings& findings) {
  if (expected.constraints.empty()) return;
  findings.guarded("loops_closed", [&] {
    std::vector<Probe> probes = {{"regularity", -1, expected.least_regularity, kInfinity},
                                 {"opening", -1, -kInfinity, expected.greatest_opening}};
    for (std::size_t i = 0; i < expected.proven_positions.size(); ++i)
      probes.push_back({"beyond", static_cast<int>(i), -kInfinity, 0});
    GuardCheck(unit, findings, "loops_closed", "State").check(probes);
  });
  if (expected.proven_parameters.empty()) return;
  findings.guarded("loops_proven", [&] {
    std::vector<Probe> probes;
    for (const ExpectedRange& range : expected.proven_parameters)
      probes.push_back({expected.parameters[range.index].name, -1, range.low, range.high});
    GuardCheck(unit, findings, "loops_proven", "Parameters").check(probes);
  });
}

}  // namespace jourdain::readback
