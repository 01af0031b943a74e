#include "emit/rosenbrock.hpp"

#include <cmath>

namespace jourdain::emit {

namespace {

using Rows = std::vector<std::vector<double>>;

/// Of sums of coefficients that are zero or equal but for rounding.
constexpr double kRounding = 1e-13;

/// A method by its usual coefficients: α strictly lower, Γ lower with a constant diagonal, b.
Rosenbrock transformed(const std::string& name, const Rows& alpha, const Rows& Gamma,
                       const std::vector<double>& b) {
  const std::size_t s = b.size();
  Rosenbrock method{name, Gamma[0][0], Rows(s, std::vector<double>(s)), Rows(s, std::vector<double>(s)), {},
                    {},   {}};
  Rows inverse(s, std::vector<double>(s));  // of Γ
  for (std::size_t j = 0; j < s; ++j) {
    inverse[j][j] = 1 / Gamma[j][j];
    for (std::size_t i = j + 1; i < s; ++i) {
      double sum = 0;
      for (std::size_t k = j; k < i; ++k) sum += Gamma[i][k] * inverse[k][j];
      inverse[i][j] = -sum / Gamma[i][i];
    }
  }
  for (std::size_t i = 0; i < s; ++i) {
    double node = 0, share = 0;
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = j; k < i; ++k) method.A[i][j] += alpha[i][k] * inverse[k][j];
      method.C[i][j] = -inverse[i][j];
      node += alpha[i][j];
    }
    for (std::size_t j = 0; j <= i; ++j) share += Gamma[i][j];
    method.nodes.push_back(node);
    method.shares.push_back(std::fabs(share) < kRounding ? 0 : share);
  }
  for (std::size_t j = 0; j < s; ++j) {
    method.m.push_back(0);
    for (std::size_t k = j; k < s; ++k) method.m[j] += b[k] * inverse[k][j];
  }
  return method;
}

/// J. Rang, L. Angermann: New Rosenbrock W-methods of order 3 for partial differential algebraic equations of index 1,
/// BIT 45 (2005): ROS34PW2. L-stable, stiffly accurate.
Rosenbrock ros34pw2() {
  constexpr double g = 4.3586652150845900e-01;
  return transformed(
      "ros34pw2",
      {{}, {8.7173304301691801e-01}, {8.4457060015369423e-01, -1.1299064236484185e-01}, {0, 0, 1}},
      {{g},
       {-8.7173304301691801e-01, g},
       {-9.0338057013044082e-01, 5.4180672388095326e-02, g},
       {2.4212380706095346e-01, -1.2232505839045147e+00, 5.4526025533510214e-01, g}},
      {2.4212380706095346e-01, -1.2232505839045147e+00, 1.5452602553351020e+00, 4.3586652150845900e-01});
}

/// Five stages, found by least squares over the order conditions and small coefficients: order 4 for index 1
/// with the full Jacobian, order 3 as a W-method (whichever terms the derivatives leave out). L-stable,
/// stiffly accurate; the conditions hold to 1e-15 and are tested.
Rosenbrock rosw43() {
  constexpr double g = 0.25;
  return transformed(
      "rosw43",
      {{},
       {0.4048802111500127},
       {0.7897620643739959, 0.11570800218484034},
       {0.16542949275770852, 0.5216431169718515, 0.08399752205688878},
       {0.5210226257779428, 0.3034927706334249, -0.45664476973356555, 0.6321293733221979}},
      {{g},
       {-0.6211659471921215, g},
       {-0.1939930382241664, 0.5445674383733331, g},
       {0.6494625210391397, -0.032955815631878445, -0.14316383908891722, g},
       {-0.3752154768282116, 0.16584199672725772, 0.12919371742044858, -0.16982023731949455, g}},
      {0.14580714894973118, 0.4693347673606826, -0.327451052313117, 0.4623091360027033, 0.25});
}

/// E. Hairer, G. Wanner: Solving Ordinary Differential Equations II, section VI.4: RODAS of order 4 for index
/// 1. L-stable, stiffly accurate.
Rosenbrock rodas4() {
  Rosenbrock method;
  method.name = "rodas4";
  method.gamma = 0.25;
  const std::vector<double> last = {1.221224509226641, 6.019134481288629, 12.53708332932087,
                                    -0.6878860361058950};
  method.A = {{},
              {1.544},
              {0.9466785280815826, 0.2557011698983284},
              {3.314825187068521, 2.896124015972201, 0.9986419139977817},
              last,
              {last[0], last[1], last[2], last[3], 1}};
  method.C = {
      {},
      {-5.6688},
      {-2.430093356833875, -0.2063599157091915},
      {-0.1073529058151375, -9.594562251023355, -20.47028614809616},
      {7.496443313967647, -10.24680431464352, -33.99990352819905, 11.70890893206160},
      {8.083246795921522, -7.981132988064893, -31.52159432874371, 16.31930543123136, -6.058818238834054}};
  method.m = {last[0], last[1], last[2], last[3], 1, 1};
  method.nodes = {0, 0.386, 0.21, 0.63, 1, 1};
  method.shares = {0.25, -0.1043, 0.1035, -0.0362, 0, 0};
  for (Rows* rows : {&method.A, &method.C})
    for (std::vector<double>& row : *rows) row.resize(6);
  return method;
}

const std::vector<Rosenbrock>& methods() {
  static const std::vector<Rosenbrock> list = {transformed("linearly_implicit_euler", {{}}, {{1}}, {1}),
                                               ros34pw2(), rosw43(), rodas4()};
  return list;
}

}  // namespace

const Rosenbrock* find_rosenbrock(const std::string& name) {
  for (const Rosenbrock& method : methods())
    if (method.name == name) return &method;
  return nullptr;
}

bool ends_at_last_stage(const Rosenbrock& method) {
  const std::size_t last = method.m.size() - 1;
  bool same = last > 0 && method.m[last] == 1;
  for (std::size_t j = 0; j < last; ++j)
    same = same && std::fabs(method.m[j] - method.A[last][j]) < kRounding;
  return same;
}

}  // namespace jourdain::emit
