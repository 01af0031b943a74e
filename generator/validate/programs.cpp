#include "validate/programs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "ir/function_id.hpp"

namespace jourdain::validate {

using dynamics::ExactDirection;
using ir::FunctionId;

namespace {

/// Component of the direction that a column of an array stands for.
ScaledReal component(const Point& point, const std::string& array, int column) {
  const ExactDirection& d = point.direction;
  if (column < 0) return d.time;
  const auto i = static_cast<std::size_t>(column);
  const std::size_t n = d.displacement.size();
  if (array == "B" || array == "D" || array == "r_u") return d.input[i];
  if (array == "A" || array == "C") return i < n ? d.displacement[i] : d.velocity[i - n];
  if (array != "r_y" && array != "zdot_y") return d.velocity[i];
  const bool is_carried = i >= d.velocity.size();  // behind a column for each velocity, those of states too
  return d.displacement[is_carried ? i - point.states : i];
}

class Contraction {
 public:
  Contraction(const ir::Program& program, const std::vector<ScaledReal>& values, const Point& point)
      : program_(program), values_(values), point_(point) {}

  /// The numbers of one array, in the order of the program's outputs.
  Part entries(const std::string& array) const {
    Part part{program_.name + ", " + array, {}};
    for (std::size_t k = 0; k < values_.size(); ++k)
      if (program_.outputs[k].name == array) part.values.push_back(values_[k]);
    return part;
  }

  /// Rows of these arrays times the direction.
  Part along(const char* name, const std::vector<std::string>& arrays, std::size_t rows) const {
    Part part{program_.name + ", " + name, std::vector<ScaledReal>(rows)};
    for (std::size_t k = 0; k < values_.size(); ++k) {
      const ir::Output& output = program_.outputs[k];
      if (std::find(arrays.begin(), arrays.end(), output.name) == arrays.end()) continue;
      part.values.at(static_cast<std::size_t>(output.row)) +=
          values_[k] * component(point_, output.name, output.column);
    }
    return part;
  }

 private:
  const ir::Program& program_;
  const std::vector<ScaledReal>& values_;
  const Point& point_;
};

std::vector<ScaledReal> widened(const std::vector<double>& values) { return {values.begin(), values.end()}; }

}  // namespace

FunctionId function_of(const ir::Program& program) {
  const std::optional<FunctionId> function = ir::function_named(program.name);
  JD_CHECK(function, "no oracle for '{}'", program.name);
  return *function;
}

bool is_derivative(const ir::Program& program) {
  const std::optional<FunctionId> function = ir::function_named(program.name);
  return function == FunctionId::kLinearize || function == FunctionId::kResidualDerivatives ||
         function == FunctionId::kForwardDynamicsDerivatives;
}

ir::Module without_derivatives(ir::Module module) {
  std::erase_if(module.functions, is_derivative);
  return module;
}

std::vector<Part> parts_of(const ir::Program& program, const std::vector<ScaledReal>& values,
                           const Point& point) {
  const Contraction c(program, values, point);
  const std::size_t n = point.direction.velocity.size();
  const std::optional<FunctionId> function = ir::function_named(program.name);
  if (function == FunctionId::kResidualDerivatives)
    return {c.entries("M"), c.along("derivatives", {"r_y", "r_z", "r_u", "r_t"}, n)};
  if (function == FunctionId::kForwardDynamicsDerivatives)
    return {c.entries("zdot"), c.along("derivatives", {"zdot_y", "zdot_z"}, n)};
  if (function == FunctionId::kLinearize)
    return {c.along("state", {"A", "B", "rate_t"}, point.direction.displacement.size() + n),
            c.along("outputs", {"C", "D", "output_t"}, point.output_numbers)};
  return {{program.name, values}};
}

ir::LeafValues<double> rounded(const ir::LeafValues<ScaledReal>& leaves) {
  ir::LeafValues<double> doubles;
  for (std::size_t kind = 0; kind < ir::kLeafKinds; ++kind)
    for (const ScaledReal& value : leaves.of[kind]) doubles.of[kind].push_back(static_cast<double>(value));
  return doubles;
}

void compare_programs(const ir::Module& module, const Point& point, const Oracle& oracle,
                      Agreement& agreement) {
  const auto at = [&](auto leaves) {
    leaves[ir::LeafKind::kConstant] = ir::interpret(module.constants, leaves);
    return leaves;
  };
  ir::LeafValues<ScaledReal> nearest;
  for (std::size_t kind = 0; kind < ir::kLeafKinds; ++kind)
    nearest.of[kind] = widened(point.rounded.of[kind]);
  const auto exact = at(point.exact), there = at(nearest);
  const auto in_double = at(point.rounded);
  const bool moved = nearest.of != point.exact.of;
  const std::size_t first = depth(module.constants);
  for (const ir::Program& program : module.functions) {
    const auto parts = [&](const std::vector<ScaledReal>& values) {
      return parts_of(program, values, point);
    };
    const std::vector<Part> computed = parts(ir::interpret(program, exact)),
                            same_state = moved ? parts(ir::interpret(program, there)) : computed,
                            doubles = parts(widened(ir::interpret(program, in_double)));
    std::vector<Expected> expected = oracle(program);
    JD_CHECK(expected.size() == computed.size(), "{} has no oracle for each part", program.name);
    for (std::size_t k = 0; k < expected.size(); ++k) {
      if (expected[k].otherwise && !Agreement::agree(computed[k].values, expected[k].values))
        expected[k] = expected[k].otherwise();
      std::vector<ScaledReal> values = expected[k].values;
      for (const std::size_t i : expected[k].shares) {
        values[i] = computed[k].values[i];
        if (!(values[i] > ScaledReal()) ||
            !(static_cast<double>(values[i]) <= expected[k].largest_share * (1 + 1e-15)))
          agreement.fail(fmt::format("{} says that number {} is {:.6g}, which is no share", program.name,
                                     i + 1, static_cast<double>(values[i])));
      }
      for (std::size_t i = 0; i < values.size() && expected[k].scales_are_unknown; ++i)
        values[i] = values[i].with_scale(computed[k].values[i].scale());
      agreement.same(computed[k].name, expected[k].oracle, computed[k].values, values, expected[k].allowed);
      agreement.rounded(computed[k].name, expected[k].oracle, doubles[k].values, same_state[k].values, values,
                        first + depth(program));
    }
  }
}

}  // namespace jourdain::validate
