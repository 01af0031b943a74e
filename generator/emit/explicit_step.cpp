#include "emit/explicit_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "emit/parameters.hpp"
#include "emit/step_functions.hpp"
#include "support/check.hpp"

namespace jourdain::emit {

namespace {

const Expression h = name("h"), state = name("state"), history = name("history");

/// Rates are v, a or v1, a1, v2, a2, …: of y and of z.
using Rates = std::function<Expression(int)>;

/// A sum over rates, for an entry of y or of z.
using Combination = std::function<Expression(const Rates&)>;

/// Statements, as they are added.
class Step {
 public:
  explicit Step(const programs::SceneFacts& scene) : clock_(scene.clock), has_rate_(scene.has_rate()) {}

  bool has_clock() const { return clock_; }
  void add(Statement statement) { statements_.push_back(std::move(statement)); }

  void counts() {
    add({Declare{kIntegerType,
                 Declare::Change::kNever,
                 {{"ny", {}, position_count()}, {"nz", {}, velocity_count()}}}});
  }

  /// Where stage k of the rates is: the first is the state. Velocities that are the rates of positions stay until the
  /// step ends; else stages take turns. No copies of either: wide loads would wait for narrow stores.
  Expression at(int k) const {
    if (k < 2) return state;
    return name(!has_rate_ ? fmt::format("stage{}", k) : k % 2 == 0 ? "stage" : "next");
  }

  void declare_stages(int last) {
    Declare declare{struct_type("State"), Declare::Change::kFree, {}};
    for (int k = 2; k <= (has_rate_ ? std::min(last, 3) : last); ++k)
      declare.variables.push_back({at(k).name});
    add({declare});
  }

  /// Arrays v1, …, a1, …; a single one is without number. Of v where it is computed, or `kept`.
  void rate_arrays(int stages, bool kept = false) {
    const auto add_arrays = [&](const char* letter, const char* count) {
      Declare declare{kRealType, Declare::Change::kFree, {}};
      for (int k = 1; k <= stages; ++k)
        declare.variables.push_back({numbered(letter, stages == 1 ? 0 : k), {name(count)}});
      add({declare});
    };
    if (has_rate_ || kept) add_arrays("v", "ny");
    add_arrays("a", "nz");
  }

  /// At stage k, or v and a at the state.
  void position_rates(int k = 0) {
    if (has_rate_) add({Call{"position_rate", {name("model"), at(k), name(numbered("v", k))}}});
  }
  void accelerations(int k = 0) {
    add({Call{kAccelerations, {name("model"), at(k), name("input"), name(numbered("a", k))}, true}});
  }
  void rates(int k = 0) {
    position_rates(k);
    accelerations(k);
  }

  /// Rates that are needed after the state has changed.
  void kept_rates() {
    const Expression i = name("i");
    if (!has_rate_) add(loop("i", name("ny"), {set(name("v")[i], state.dot("z")[i])}));
    rates();
  }

  /// The rates at stage k, and the next one = state + factor × combination. Positions go ahead of the accelerations,
  /// which they do not need: a processor takes the sines of the next stage meanwhile, as long as no compiler puts the
  /// stores of both together in one vector.
  void stage(int k, const Expression& factor, const Combination& combination) {
    position_rates(k);
    positions(at(k + 1), factor, combination);
    accelerations(k);
    velocities(at(k + 1), factor, combination);
  }

  /// The rates at the last stage, and the state after it; not before, as whoever gives inputs may look at it.
  void last_stage(int k, const Expression& factor, const Combination& combination) {
    rates(k);
    advance(factor, combination);
  }

  Expression scalar(const std::string& variable, const Expression& value) {
    add(constant(variable, value));
    return name(variable);
  }

  void time(const Expression& target, const Expression& change) {
    if (clock_) add(set(target.dot("t"), state.dot("t") + change));
  }

  void same_time(int k, int as) {
    if (clock_) add(set(at(k).dot("t"), at(as).dot("t")));
  }

  /// state += factor × combination.
  void advance(const Expression& factor, const Combination& combination) {
    positions(state, factor, combination);
    velocities(state, factor, combination);
  }
  void positions(const Expression& target, const Expression& factor, const Combination& combination) {
    entries(target, "y", "ny", factor, combination([this](int k) {
              return (has_rate_ ? name(numbered("v", k)) : at(k).dot("z"))[name("i")];
            }));
  }
  void velocities(const Expression& target, const Expression& factor, const Combination& combination) {
    entries(target, "z", "nz", factor, combination([](int k) { return name(numbered("a", k))[name("i")]; }));
  }

  Statements take() { return std::move(statements_); }

 private:
  static std::string numbered(const std::string& letter, int k) {
    return k == 0 ? letter : fmt::format("{}{}", letter, k);
  }

  void entries(const Expression& target, const char* member, const char* count, const Expression& factor,
               const Expression& sum) {
    const Expression i = name("i");
    add(loop("i", name(count), {set(target.dot(member)[i], state.dot(member)[i] + factor * sum)}));
  }

  bool clock_, has_rate_;
  Statements statements_;
};

Expression first(const Rates& k) { return k(0); }

void euler(Step& step) {
  step.rate_arrays(1);
  step.rates();
  step.advance(h, first);
  step.time(state, h);
}

/// Velocities first, positions with the new velocities.
void semi_implicit_euler(Step& step) {
  step.rate_arrays(1);
  step.accelerations();
  step.velocities(state, h, first);
  step.position_rates();
  step.positions(state, h, first);
  step.time(state, h);
}

void heun(Step& step) {
  step.declare_stages(2);
  step.rate_arrays(2);
  step.time(step.at(2), h);
  step.stage(1, h, [](const Rates& k) { return k(1); });
  const Expression half = step.scalar("half", 0.5 * h);
  step.last_stage(2, half, [](const Rates& k) { return k(1) + k(2); });
  step.time(state, h);
}

/// W. Kutta, Zeitschrift für Mathematik und Physik 46 (1901).
void rk4(Step& step) {
  const Expression half = step.scalar("half", 0.5 * h);
  step.declare_stages(4);
  step.rate_arrays(4);
  step.time(step.at(2), half);
  step.stage(1, half, [](const Rates& k) { return k(1); });
  step.same_time(3, 2);
  step.stage(2, half, [](const Rates& k) { return k(2); });
  step.time(step.at(4), h);
  step.stage(3, h, [](const Rates& k) { return k(3); });
  const Expression sixth = step.scalar("sixth", h / 6.0);
  step.last_stage(4, sixth, [](const Rates& k) { return k(1) + 2.0 * (k(2) + k(3)) + k(4); });
  step.time(state, h);
}

struct Fraction {
  int numerator = 0, denominator = 1;
};

Expression quotient(const Fraction& f) {
  return Expression(double(f.numerator)) / Expression(double(f.denominator));
}

/// Coefficients of a Runge-Kutta method, by stage: rows of A and nodes but for the first stage, b.
struct Tableau {
  std::vector<std::vector<Fraction>> A;
  std::vector<Fraction> nodes, b;
};

/// Declares the coefficients of a row as NAME1, NAME2, … and gives their sum over the rates; signs are written, not
/// stored.
Combination combination(Step& step, const std::string& letter, const std::vector<Fraction>& row) {
  Declare declare{kRealType, Declare::Change::kConstant, {}};
  for (std::size_t j = 0; j < row.size(); ++j)
    if (row[j].numerator != 0)
      declare.variables.push_back({fmt::format("{}{}", letter, j + 1),
                                   {},
                                   quotient({std::abs(row[j].numerator), row[j].denominator})});
  step.add({declare});
  return [letter, row](const Rates& k) {
    std::optional<Expression> sum;
    for (std::size_t j = 0; j < row.size(); ++j) {
      if (row[j].numerator == 0) continue;
      const Expression term = name(fmt::format("{}{}", letter, j + 1)) * k(int(j) + 1);
      sum = !sum ? term : row[j].numerator < 0 ? *sum - term : *sum + term;
    }
    return *sum;
  };
}

void runge_kutta(Step& step, const Tableau& tableau) {
  const std::size_t stages = tableau.b.size();
  step.declare_stages(int(stages));
  step.rate_arrays(int(stages));
  for (int k = 1; k < int(stages); ++k) {
    const Combination sum = combination(step, fmt::format("a{}", k + 1), tableau.A[std::size_t(k) - 1]);
    const Fraction& node = tableau.nodes[std::size_t(k) - 1];
    step.time(step.at(k + 1), node.numerator == node.denominator ? h : quotient(node) * h);
    step.stage(k, h, sum);
  }
  step.last_stage(int(stages), h, combination(step, "b", tableau.b));
  step.time(state, h);
}

/// J. R. Dormand, P. J. Prince, Journal of Computational and Applied Mathematics 6 (1980).
void rk5(Step& step) {
  runge_kutta(step, {{{{1, 5}},
                      {{3, 40}, {9, 40}},
                      {{44, 45}, {-56, 15}, {32, 9}},
                      {{19372, 6561}, {-25360, 2187}, {64448, 6561}, {-212, 729}},
                      {{9017, 3168}, {-355, 33}, {46732, 5247}, {49, 176}, {-5103, 18656}}},
                     {{1, 5}, {3, 10}, {4, 5}, {8, 9}, {1, 1}},
                     {{35, 384}, {}, {500, 1113}, {125, 192}, {-2187, 6784}, {11, 84}}});
}

/// Until `earlier` steps are remembered a step of rk4; then state + scale × combination. k(0) are the rates of now,
/// k(1), … the remembered ones, newest first.
void adams_bashforth(Step& step, int earlier, const char* scale, const Expression& factor,
                     const Combination& sum) {
  const Expression i = name("i"), count = history.dot("count");
  step.rate_arrays(1, true);
  step.kept_rates();
  const auto remembered = [&](const char* member, const char* now) -> Rates {
    return [member, now, i](int k) { return k == 0 ? name(now)[i] : history.dot(member)[k - 1][i]; };
  };
  AtStart start{count, earlier, true, {}, {}};
  start.then = {{Call{"rk4_step", {name("model"), state, name("input"), h}}},
                set(count, earlier == 1 ? Expression(1) : count + 1)};
  start.otherwise = {
      constant(scale, factor),
      loop("i", name("ny"),
           {set(state.dot("y")[i], state.dot("y")[i] + name(scale) * sum(remembered("ydot", "v")))}),
      loop("i", name("nz"),
           {set(state.dot("z")[i], state.dot("z")[i] + name(scale) * sum(remembered("zdot", "a")))})};
  if (step.has_clock()) start.otherwise.push_back(set(state.dot("t"), state.dot("t") + h));
  step.add({start});
  for (const auto& [member, rate, entries] : {std::tuple("ydot", "v", "ny"), {"zdot", "a", "nz"}}) {
    Statements moves;
    for (int k = earlier - 1; k > 0; --k)
      moves.push_back(set(history.dot(member)[k][i], history.dot(member)[k - 1][i]));
    moves.push_back(set(history.dot(member)[0][i], name(rate)[i]));
    step.add(loop("i", name(entries), moves));
  }
}

void adams_bashforth2(Step& step) {
  adams_bashforth(step, 1, "half", 0.5 * h, [](const Rates& k) { return 3.0 * k(0) - k(1); });
}

void adams_bashforth3(Step& step) {
  adams_bashforth(step, 2, "twelfth", h / 12.0,
                  [](const Rates& k) { return 23.0 * k(0) - 16.0 * k(1) + 5.0 * k(2); });
}

constexpr std::pair<const char*, void (*)(Step&)> kMethods[] = {{"euler", euler},
                                                                {"semi_implicit_euler", semi_implicit_euler},
                                                                {"heun", heun},
                                                                {"rk4", rk4},
                                                                {"rk5", rk5},
                                                                {"adams_bashforth2", adams_bashforth2},
                                                                {"adams_bashforth3", adams_bashforth3}};

}  // namespace

Statements explicit_step(const programs::Stepper& stepper, const programs::SceneFacts& scene) {
  for (const auto& [name, method] : kMethods)
    if (name == stepper.name) {
      Step step(scene);
      step.counts();
      method(step);
      return step.take();
    }
  JD_CHECK(false, "no method '{}'", stepper.name);
  return {};
}

}  // namespace jourdain::emit
