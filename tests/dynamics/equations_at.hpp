// The equations of a small scene in numbers, for comparison with printed formulas.
#pragma once

#include <string>
#include <vector>

#include "model/mechanism.hpp"

namespace jourdain::tests {

/// Where the equations are evaluated; parameters have their default values.
struct StateNumbers {
  std::vector<double> y, z, u = {};
  double t = 0;
};

/// In 60 digits from the symbolic statements, then rounded to double.
struct EquationsAt {
  std::vector<std::vector<double>> M;
  std::vector<double> k_bar, q_bar, ydot;
  double kinetic_energy = 0, potential_energy = 0;
};

EquationsAt equations_at(const model::Mechanism& mechanism, const StateNumbers& state);

/// A scene of one body "b" on one joint "j" to the world. `body` and `joint` are the lines of their tables;
/// gravity is (0, 0, −9.81).
model::Mechanism one_body(const std::string& body, const std::string& joint, const std::string& more = "");

}  // namespace jourdain::tests
