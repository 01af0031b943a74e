// The coefficients that steps are compared with are those that were published.
#include <gtest/gtest.h>

#include <cmath>

#include "readback/methods.hpp"
#include "readback/reals.hpp"

namespace jourdain::tests {
namespace {

using namespace readback;

/// Published coefficients have 16 digits; those in u-form carry their rounding.
constexpr double kPublished = 2e-14;

using Rows = std::vector<std::vector<double>>;

/// α = A Γ, Γ = γ (1 − S)⁻¹, b = Γᵀ m.
struct Classical {
  ExactMatrix alpha, Gamma;
  ExactVector b;
};

Classical classical(const RosenbrockTable& table) {
  const std::size_t s = table.m.size();
  ExactMatrix A = zero_matrix(s, s), inverse = identity(s), Gamma = zero_matrix(s, s);
  for (std::size_t i = 0; i < s; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      A[i][j] = exact(table.A[i][j]);
      inverse[i][j] = -exact(table.S[i][j]);
    }
  const DenseSolver solver(inverse);
  for (std::size_t j = 0; j < s; ++j) {
    ExactVector unit(s, exact(0.0));
    unit[j] = exact(table.gamma);
    const ExactVector column = solver.solve(unit);
    for (std::size_t i = 0; i < s; ++i) Gamma[i][j] = column[i];
  }
  Classical form = {A * Gamma, Gamma, {}};
  for (std::size_t j = 0; j < s; ++j) {
    Exact sum = exact(0.0);
    for (std::size_t i = 0; i < s; ++i) sum = sum + exact(table.m[i]) * Gamma[i][j];
    form.b.push_back(sum);
  }
  return form;
}

void expect_rows(const ExactMatrix& found, const Rows& wanted) {
  for (std::size_t i = 0; i < wanted.size(); ++i)
    for (std::size_t j = 0; j < wanted[i].size(); ++j)
      EXPECT_NEAR(rough(found[i][j]), wanted[i][j], kPublished) << i << ", " << j;
}

TEST(Methods, Ros34pw2HasItsPublishedCoefficients) {
  const RosenbrockTable& table = *find_rosenbrock_table("ros34pw2");
  const Classical form = classical(table);
  constexpr double g = 4.3586652150845900e-01;
  expect_rows(form.alpha,
              {{}, {8.7173304301691801e-01}, {8.4457060015369423e-01, -1.1299064236484185e-01}, {0, 0, 1}});
  expect_rows(form.Gamma, {{g},
                           {-8.7173304301691801e-01, g},
                           {-9.0338057013044082e-01, 5.4180672388095326e-02, g},
                           {2.4212380706095346e-01, -1.2232505839045147e+00, 5.4526025533510214e-01, g}});
  expect_rows({form.b}, {{2.4212380706095346e-01, -1.2232505839045147e+00, 1.5452602553351020e+00, g}});
}

TEST(Methods, Rosw43HasTheCoefficientsOfItsSearch) {
  const Classical form = classical(*find_rosenbrock_table("rosw43"));
  expect_rows(form.alpha,
              {{},
               {0.4048802111500127},
               {0.7897620643739959, 0.11570800218484034},
               {0.16542949275770852, 0.5216431169718515, 0.08399752205688878},
               {0.5210226257779428, 0.3034927706334249, -0.45664476973356555, 0.6321293733221979}});
  expect_rows(form.Gamma,
              {{0.25},
               {-0.6211659471921215, 0.25},
               {-0.1939930382241664, 0.5445674383733331, 0.25},
               {0.6494625210391397, -0.032955815631878445, -0.14316383908891722, 0.25},
               {-0.3752154768282116, 0.16584199672725772, 0.12919371742044858, -0.16982023731949455, 0.25}});
  expect_rows({form.b},
              {{0.14580714894973118, 0.4693347673606826, -0.327451052313117, 0.4623091360027033, 0.25}});
}

/// Σ_j Γ_ij are the shares, Σ_j α_ij the nodes, and b sums to 1, for all of them.
TEST(Methods, SumsOfRowsAreNodesAndShares) {
  for (const char* name : {"linearly_implicit_euler", "ros34pw2", "rosw43", "rodas4"}) {
    const RosenbrockTable& table = *find_rosenbrock_table(name);
    const Classical form = classical(table);
    double total = 0;
    for (std::size_t i = 0; i < table.m.size(); ++i) {
      double node = 0, share = 0;
      for (std::size_t j = 0; j < table.m.size(); ++j) {
        node += rough(form.alpha[i][j]);
        share += rough(form.Gamma[i][j]);
      }
      total += rough(form.b[i]);
      EXPECT_NEAR(node, table.nodes[i], 1e-13) << name << i;
      EXPECT_NEAR(share, table.shares[i], 1e-13) << name << i;
    }
    EXPECT_NEAR(total, 1, 1e-13) << name;
  }
}

/// Order conditions up to 4 of an explicit method: Σ b = 1, Σ b c = 1/2, Σ b c² = 1/3, Σ b a c = 1/6, …
TEST(Methods, TableausHaveTheirOrders) {
  const auto value = [](const Fraction& f) { return double(f.numerator) / double(f.denominator); };
  for (const auto& [name, order] : {std::pair("euler", 1), {"heun", 2}, {"rk4", 4}, {"rk5", 5}}) {
    const Tableau& t = *find_tableau(name);
    const std::size_t s = t.b.size();
    std::vector<double> ac(s), ac2(s), aac(s), ac3(s);
    double row = 0, b1 = 0, bc = 0, bc2 = 0, bac = 0, bc3 = 0, bcac = 0, bac2 = 0, baac = 0, bc4 = 0,
           bac3 = 0;
    for (std::size_t i = 0; i < s; ++i) {
      row = 0;
      const double b = value(t.b[i]), c = value(t.c[i]);
      for (std::size_t j = 0; j < i; ++j) {
        const double a = value(t.a[i][j]), cj = value(t.c[j]);
        row += a;
        ac[i] += a * cj;
        ac2[i] += a * cj * cj;
        ac3[i] += a * cj * cj * cj;
        aac[i] += a * ac[j];
      }
      EXPECT_NEAR(row, c, 1e-14) << name;
      b1 += b;
      bc += b * c;
      bc2 += b * c * c;
      bac += b * ac[i];
      bc3 += b * c * c * c;
      bcac += b * c * ac[i];
      bac2 += b * ac2[i];
      baac += b * aac[i];
      bc4 += b * c * c * c * c;
      bac3 += b * ac3[i];
    }
    const std::vector<std::tuple<int, double, double>> conditions = {
        {1, b1, 1},        {2, bc, 1. / 2},    {3, bc2, 1. / 3},   {3, bac, 1. / 6}, {4, bc3, 1. / 4},
        {4, bcac, 1. / 8}, {4, bac2, 1. / 12}, {4, baac, 1. / 24}, {5, bc4, 1. / 5}, {5, bac3, 1. / 20}};
    for (const auto& [needed, found, wanted] : conditions)
      EXPECT_NEAR(needed <= order ? found : wanted, wanted, 1e-14) << name;
  }
}

TEST(Methods, AdamsBashforthIntegratesPolynomials) {
  for (int steps : {2, 3})
    for (int power = 0; power < steps; ++power) {
      double sum = 0;
      const std::vector<Fraction> weights = adams_bashforth(steps);
      for (std::size_t k = 0; k < weights.size(); ++k)
        sum += double(weights[k].numerator) / double(weights[k].denominator) * std::pow(-double(k), power);
      EXPECT_NEAR(sum, 1. / (power + 1), 1e-15);
    }
}

}  // namespace
}  // namespace jourdain::tests
