#include "readback/methods.hpp"

#include <map>

namespace jourdain::readback {

namespace {

Fraction over(long numerator, long denominator) { return {numerator, denominator}; }

/// J. R. Dormand, P. J. Prince: A family of embedded Runge-Kutta formulae, J. Comp. Appl. Math. 6 (1980): the
/// six stages of order 5.
Tableau dormand_prince() {
  Tableau t;
  t.a = {{},
         {over(1, 5)},
         {over(3, 40), over(9, 40)},
         {over(44, 45), over(-56, 15), over(32, 9)},
         {over(19372, 6561), over(-25360, 2187), over(64448, 6561), over(-212, 729)},
         {over(9017, 3168), over(-355, 33), over(46732, 5247), over(49, 176), over(-5103, 18656)}};
  t.b = {over(35, 384), over(0, 1), over(500, 1113), over(125, 192), over(-2187, 6784), over(11, 84)};
  t.c = {over(0, 1), over(1, 5), over(3, 10), over(4, 5), over(8, 9), over(1, 1)};
  return t;
}

std::map<std::string, Tableau> tableaus() {
  const Fraction zero = over(0, 1), half = over(1, 2), one = over(1, 1);
  return {{"euler", {{{}}, {one}, {zero}}},
          {"heun", {{{}, {one}}, {half, half}, {zero, one}}},
          {"rk4",
           {{{}, {half}, {zero, half}, {zero, zero, one}},
            {over(1, 6), over(1, 3), over(1, 3), over(1, 6)},
            {zero, half, half, one}}},
          {"rk5", dormand_prince()}};
}

RosenbrockTable linearly_implicit_euler() { return {1, {{}}, {{}}, {1}, {0}, {1}}; }

/// J. Rang, L. Angermann, BIT 45 (2005), ROS34PW2.
RosenbrockTable ros34pw2() {
  return {0.435866521508459,
          {{},
           {2},
           {1.4192173174557647, -0.2592322116729697},
           {4.18476048231916, -0.28519201735549593, 2.294280360279042}},
          {{},
           {-2},
           {-1.8239969947745136, 0.12430565256672008},
           {-2.7756761163024684, -2.961983662554789, 1.2509798950560604}},
          {4.18476048231916, -0.28519201735549593, 2.294280360279042, 1},
          {0, 0.871733043016918, 0.7315799577888524, 1},
          {0.435866521508459, -0.435866521508459, -0.4133333762338865, 0}};
}

/// Found by its order conditions.
RosenbrockTable rosw43() {
  return {0.25,
          {{},
           {1.6195208446000509},
           {4.3090301898936545, 0.46283200873936137},
           {4.288399581079813, 1.3546954212277664, 0.3359900882275551},
           {1.1152207756767307, 2.3720032034638208, -0.3786099927634268, 2.5285174932887915}},
          {{},
           {-2.484663788768486},
           {4.636295825777874, 2.1782697534933324},
           {4.925313235518252, 1.1155745793979854, -0.5726553563556689},
           {1.0971347873298902, 0.2954814781995645, 0.12778099560739664, -0.6792809492779782}},
          {1.1152207756767307, 2.3720032034638208, -0.3786099927634268, 2.5285174932887915, 1},
          {0, 0.4048802111500127, 0.9054700665588362, 0.7710701317864489, 1},
          {0.25, -0.3711659471921215, 0.6005744001491667, 0.7233428663183441, 0}};
}

/// E. Hairer, G. Wanner: Solving Ordinary Differential Equations II, section VI.4, RODAS. S = γ C of the published C.
RosenbrockTable rodas4() {
  RosenbrockTable table;
  table.gamma = 0.25;
  const std::vector<double> last = {1.221224509226641, 6.019134481288629, 12.53708332932087,
                                    -0.6878860361058950};
  table.A = {{},
             {1.544},
             {0.9466785280815826, 0.2557011698983284},
             {3.314825187068521, 2.896124015972201, 0.9986419139977817},
             last,
             {last[0], last[1], last[2], last[3], 1}};
  table.S = {
      {},
      {-5.6688},
      {-2.430093356833875, -0.2063599157091915},
      {-0.1073529058151375, -9.594562251023355, -20.47028614809616},
      {7.496443313967647, -10.24680431464352, -33.99990352819905, 11.70890893206160},
      {8.083246795921522, -7.981132988064893, -31.52159432874371, 16.31930543123136, -6.058818238834054}};
  for (std::vector<double>& row : table.S)
    for (double& entry : row) entry *= table.gamma;  // a power of two: exact
  table.m = {last[0], last[1], last[2], last[3], 1, 1};
  table.nodes = {0, 0.386, 0.21, 0.63, 1, 1};
  table.shares = {0.25, -0.1043, 0.1035, -0.0362, 0, 0};
  return table;
}

struct Order {
  int all = 0, reduced = 0;
};

}  // namespace

const Tableau* find_tableau(const std::string& method) {
  static const std::map<std::string, Tableau> known = tableaus();
  const auto it = known.find(method);
  return it == known.end() ? nullptr : &it->second;
}

std::vector<Fraction> adams_bashforth(int steps) {
  if (steps == 2) return {over(3, 2), over(-1, 2)};
  return {over(23, 12), over(-16, 12), over(5, 12)};
}

const RosenbrockTable* find_rosenbrock_table(const std::string& method) {
  static const std::map<std::string, RosenbrockTable> known = {
      {"linearly_implicit_euler", linearly_implicit_euler()},
      {"ros34pw2", ros34pw2()},
      {"rosw43", rosw43()},
      {"rodas4", rodas4()}};
  const auto it = known.find(method);
  return it == known.end() ? nullptr : &it->second;
}

int order_of(const std::string& step, bool all_derivatives) {
  static const std::map<std::string, Order> known = {{"euler_step", {1, 1}},
                                                     {"semi_implicit_euler_step", {1, 1}},
                                                     {"heun_step", {2, 2}},
                                                     {"rk4_step", {4, 4}},
                                                     {"rk5_step", {5, 5}},
                                                     {"adams_bashforth2_step", {2, 2}},
                                                     {"adams_bashforth3_step", {3, 3}},
                                                     {"linearly_implicit_euler_step", {1, 1}},
                                                     {"ros34pw2_step", {3, 3}},
                                                     {"rosw43_step", {4, 3}},
                                                     {"rodas4_step", {4, 0}}};
  const auto it = known.find(step);
  if (it == known.end()) return 0;
  return all_derivatives ? it->second.all : it->second.reduced;
}

}  // namespace jourdain::readback
