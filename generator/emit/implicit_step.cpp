#include "emit/implicit_step.hpp"

#include <fmt/format.h>

#include <cmath>

#include "emit/parameters.hpp"

namespace jourdain::emit {

namespace {

const Expression h = name("h"), i = name("i"), model = name("model"), state = name("state"),
                 stage = name("stage"), input = name("input"), step = name("step"),
                 accelerations = name("accelerations");

Expression increment(std::size_t number, const char* member) {
  return name(fmt::format("u{}", number + 1)).dot(member)[i];
}

/// A sum with signs; terms are added to each other before they are added to anything else: rounding at the size of
/// what they are added to is the largest there is.
struct Terms {
  struct Term {
    double factor = 1;
    Expression value;
  };
  std::vector<Term> terms;

  Expression sum() const {
    if (terms.empty()) return 0.0;
    Expression total = scaled(terms[0].factor, terms[0].value);
    for (std::size_t k = 1; k < terms.size(); ++k) {
      const Expression term = scaled(std::fabs(terms[k].factor), terms[k].value);
      total = terms[k].factor < 0 ? total - term : total + term;
    }
    return total;
  }

  Expression added_to(const Expression& base) const {
    if (terms.empty()) return base;
    if (terms.size() > 1 || terms[0].factor > 0) return base + sum();
    return base - scaled(-terms[0].factor, terms[0].value);
  }

 private:
  static Expression scaled(double factor, const Expression& value) {
    if (factor == 1) return value;
    return factor == -1 ? -value : factor * value;
  }
};

/// Σ scale factor[j] u_j.member[i], j < count.
Terms combination(const std::vector<double>& factors, double scale, std::size_t count, const char* member) {
  Terms sum;
  for (std::size_t j = 0; j < count; ++j)
    if (factors[j] != 0) sum.terms.push_back({scale * factors[j], increment(j, member)});
  return sum;
}

void add_stage(const programs::SceneFacts& scene, const Rosenbrock& method, std::size_t number,
               Statements& body) {
  const std::vector<double>&A = method.A[number], &C = method.C[number];
  const auto sum = [&](const std::vector<double>& factors, double scale, const char* member) {
    return combination(factors, scale, number, member);
  };
  Statements entries = {set(stage.dot("y")[i], sum(A, 1, "y").sum())};
  const Terms moved = sum(A, 1, "z");
  const bool moves = !moved.terms.empty();
  if (moves) entries.push_back(set(stage.dot("z")[i], moved.sum()));
  const Expression start = state.dot("z")[i];
  entries.push_back(set(stage.dot("state").dot("z")[i], moves ? start + stage.dot("z")[i] : start));
  entries.push_back(set(stage.dot("a")[i], sum(A, 1, "a").added_to(accelerations.dot("zdot")[i])));
  entries.push_back(set(stage.dot("sum_y")[i], sum(C, method.gamma, "y").sum()));
  entries.push_back(set(stage.dot("sum_z")[i], sum(C, method.gamma, "z").sum()));
  body.push_back(loop("i", scene.velocities.size(), entries));
  if (!scene.carried.empty())
    body.push_back(loop("i", scene.carried.size(),
                        {set(stage.dot("carried")[i], sum(A, 1, "carried").sum()),
                         set(stage.dot("sum_carried")[i], sum(C, method.gamma, "carried").sum())}));
  if (number > 0) {
    const double node = method.nodes[number];
    if (scene.clock && node != 0)
      body.push_back(set(stage.dot("state").dot("t"), state.dot("t") + (node == 1 ? h : node * h)));
    body.push_back({Call{"displace", {state, stage.dot("y"), stage.dot("state")}, true}});
    for (std::size_t k = 0; k < scene.carried.size(); ++k) {
      const std::size_t entry = scene.carried[k];
      body.push_back(
          set(stage.dot("state").dot("y")[entry], state.dot("y")[entry] + stage.dot("carried")[k]));
    }
    for (int k = 0; k < scene.closings && !scene.dependents.empty(); ++k)
      body.push_back({Call{"close_loops", {model, stage.dot("state")}}});
  }
  std::vector<Expression> arguments = {model, step, stage, input};
  if (residual_changes(scene)) arguments.push_back(method.shares[number]);
  arguments.push_back(name(fmt::format("u{}", number + 1)));
  body.push_back({Call{"solve_stage", arguments, true}});
}

Type support_type(const char* name) { return {Type::Kind::kStruct, name, true}; }

/// The state after the last stage.
void add_end(const programs::SceneFacts& scene, const Rosenbrock& method, Statements& body) {
  const std::size_t stages = method.m.size();
  const bool at_last = ends_at_last_stage(method);
  const auto gained = [&](const char* member) {
    return at_last ? Terms{{{1, increment(stages - 1, member)}}} : combination(method.m, 1, stages, member);
  };
  const Expression y = stage.dot("y")[i], z = state.dot("z")[i], zdot = accelerations.dot("zdot")[i];
  body.push_back(
      loop("i", scene.velocities.size(),
           {set(y, at_last ? gained("y").added_to(y) : gained("y").sum()),
            set(z, at_last ? z + (stage.dot("z")[i] + increment(stages - 1, "z")) : gained("z").added_to(z)),
            set(zdot, gained("a").added_to(at_last ? stage.dot("a")[i] : zdot))}));
  if (!scene.carried.empty()) {
    const Expression moved = stage.dot("carried")[i];
    body.push_back(loop("i", scene.carried.size(),
                        {set(moved, at_last ? gained("carried").added_to(moved) : gained("carried").sum())}));
  }
  for (std::size_t k = 0; k < scene.carried.size(); ++k) {
    const Expression y_of_it = state.dot("y")[scene.carried[k]];
    body.push_back(set(y_of_it, y_of_it + stage.dot("carried")[k]));
  }
  for (const std::size_t entry : scene.dependents)
    body.push_back(set(state.dot("y")[entry], stage.dot("state").dot("y")[entry]));
  const bool turns = !scene.tangent.quaternions.empty();
  if (turns) body.push_back(set(stage.dot("state"), state));
  body.push_back({Call{"displace", {turns ? stage.dot("state") : state, stage.dot("y"), state}, true}});
  if (scene.clock) body.push_back(set(state.dot("t"), state.dot("t") + h));
}

}  // namespace

bool residual_changes(const programs::SceneFacts& scene) {
  return scene.time.dynamics || !scene.inputs.empty();
}

Statements rosenbrock_step(const programs::SceneFacts& scene, const Rosenbrock& method) {
  std::vector<Expression> start = {model, state, input};
  if (residual_changes(scene)) start.push_back(h);
  start.insert(start.end(), {method.gamma == 1 ? h : method.gamma * h, accelerations, step});
  Declare increments{support_type("Increment"), Declare::Change::kFree, {}};
  for (std::size_t k = 0; k < method.m.size(); ++k)
    increments.variables.push_back({fmt::format("u{}", k + 1)});
  Statements body = {{Declare{support_type("ImplicitStep"), Declare::Change::kFree, {{"step"}}}},
                     {Call{"begin_step", start, true}},
                     {increments},
                     {Declare{support_type("ImplicitStage"), Declare::Change::kFree, {{"stage"}}}},
                     set(stage.dot("state"), state)};
  for (std::size_t k = 0; k < method.m.size(); ++k) add_stage(scene, method, k, body);
  add_end(scene, method, body);
  return body;
}

}  // namespace jourdain::emit
