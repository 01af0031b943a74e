#include "studies/tables.hpp"

#include <array>

namespace jourdain::tests {

namespace {

using studies::kParts;
using studies::number_at;

void put(double number, double* parts) { *parts = number; }
void put(const LongReal& number, double* parts) { number.split(parts, kParts<LongReal>); }

/// y'' = kStiffness y + u, Real arithmetic.
template <class Real, int kStiffness>
struct System {
  static constexpr int P = kParts<Real>;
  using State = std::array<Real, 2>;

  static State f(const State& x, const Real& u) { return {x[1], Real(double(kStiffness)) * x[0] + u}; }
  static State moved(const State& x, const Real& h, const State& v) {
    return {x[0] + h * v[0], x[1] + h * v[1]};
  }

  static void initial(double* y, double* z) {
    put(Real(kStiffness < 0 ? 1.0 : 1e-3), y);
    put(Real(0.0), z);
  }
  static void rates(const double*, const double* y, const double* z, const double* u, double* ydot,
                    double* zdot) {
    const State v = f({number_at<Real>(y), number_at<Real>(z)}, number_at<Real>(u));
    put(v[0], ydot);
    put(v[1], zdot);
  }
  static Real input(const jourdain_inputs* inputs, const Real& t, const State& x) {
    if (!inputs->at) return number_at<Real>(inputs->held);
    double time[P], y[P], z[P], u[P];
    put(t, time);
    put(x[0], y);
    put(x[1], z);
    inputs->at(inputs->context, time, y, z, u);
    return number_at<Real>(u);
  }
  template <bool kFourthOrder>
  static void steps(double* t, double* y, double* z, const jourdain_inputs* inputs, const double* h_parts,
                    long count, double*) {
    const Real h = number_at<Real>(h_parts), half = Real(0.5) * h, sixth = h / Real(6.0);
    Real time = number_at<Real>(t);
    State x = {number_at<Real>(y), number_at<Real>(z)};
    for (long i = 0; i < count; ++i) {
      const State a = f(x, input(inputs, time, x));
      if constexpr (kFourthOrder) {
        const State x2 = moved(x, half, a), b = f(x2, input(inputs, time + half, x2));
        const State x3 = moved(x, half, b), c = f(x3, input(inputs, time + half, x3));
        const State x4 = moved(x, h, c), d = f(x4, input(inputs, time + h, x4));
        x = moved(moved(moved(moved(x, sixth, a), sixth + sixth, b), sixth + sixth, c), sixth, d);
      } else {
        x = moved(x, h, a);
      }
      time = time + h;
    }
    put(time, t);
    put(x[0], y);
    put(x[1], z);
  }
  static void kinetic(const double*, const double*, const double* z, double* energy) {
    put(Real(0.5) * number_at<Real>(z) * number_at<Real>(z), energy);
  }
  static void potential(const double*, const double* y, const double*, double* energy) {
    put(Real(-0.5 * kStiffness) * number_at<Real>(y) * number_at<Real>(y), energy);
  }

  static const jourdain_model_table& table() {
    static const char* const names[] = {"y", nullptr};
    static const char* const no_names[] = {nullptr};
    static const jourdain_method methods[] = {{"first", 1, 1, 0, 0, 8, steps<false>},
                                              {"fourth", 4, 4, 0, 0, 40, steps<true>}};
    const double roundoff = P == 1 ? 0x1p-53 : 0x1p-166;
    static const jourdain_model_table result = {
        P,         1,       1,        1,       0,       0,       2,     roundoff, 4,       names,
        names,     names,   no_names, methods, nullptr, initial, rates, nullptr,  nullptr, kinetic,
        potential, nullptr, 0,        nullptr, nullptr, nullptr, 0,     0,        nullptr};
    return result;
  }
};

}  // namespace

const jourdain_model_table& oscillator(double) { return System<double, -1>::table(); }
const jourdain_model_table& oscillator(const LongReal&) { return System<LongReal, -1>::table(); }
const jourdain_model_table& unstable(double) { return System<double, 25>::table(); }

}  // namespace jourdain::tests
