#include "loops/closed_form/dyad.hpp"

#include <algorithm>
#include <cmath>

namespace jourdain::loops {

namespace {

using Result = std::variant<Solution, std::string>;

constexpr const char* kOtherForm = "its constraint is none of those that are solved in closed form";
constexpr const char* kUndetermined = "its constraint does not determine it at the initial state";
constexpr const char* kDead = "the initial state is a dead position";

class Solver {
 public:
  Solver(ir::Builder& builder, std::vector<Polynomial> rows, const std::vector<double>& initial,
         const Samples& samples)
      : roots_(builder, samples), rows_(std::move(rows)), initial_(initial), samples_(samples) {}

  Result run() {
    const std::size_t count = initial_.size();
    for (std::size_t k = 0; k < count; ++k)
      if (!has(cos_of(k), sin_of(k)) && !has(value_of(k), value_of(k))) return kUndetermined;
    for (std::size_t k = 0; k < count; ++k) is_angle_[k] = has(cos_of(k), sin_of(k));
    if (count == 1) return is_angle_[0] ? one_angle() : one_slide();
    if (count == 3) return three_spheres();
    if (is_angle_[0] && is_angle_[1]) return two_angles();
    if (!is_angle_[0] && !is_angle_[1]) return two_slides();
    return is_angle_[0] ? angle_and_slide(0, 1) : swapped(angle_and_slide(1, 0));
  }

 private:
  Scalar number(double value) const { return roots_.number(value); }
  double at_start(Scalar value) const { return roots_.at_start(value); }

  /// Do monomials with either factor occur?
  bool has(const Monomial& a, const Monomial& b) const {
    const auto divides = [](const Monomial& factor, const Monomial& product) {
      for (std::size_t i = 0; i < factor.size(); ++i)
        if (product[i] < factor[i]) return false;
      return true;
    };
    for (const Polynomial& row : rows_)
      for (const auto& [powers, coefficient] : row)
        if (divides(a, powers) || divides(b, powers)) return true;
    return false;
  }

  Scalar coefficient(std::size_t row, const Monomial& powers) const {
    const auto it = rows_[row].find(powers);
    return it == rows_[row].end() ? number(0) : it->second;
  }

  Vector2 column(const Monomial& powers) const { return {coefficient(0, powers), coefficient(1, powers)}; }

  /// Of the direction of an angle, times another monomial.
  Matrix2 matrix(std::size_t angle, const Monomial& factor = kConstant) const {
    return {column(cos_of(angle) * factor), column(sin_of(angle) * factor)};
  }

  bool is_zero(Vector2 v) const { return loops::is_zero(v.x) && loops::is_zero(v.y); }
  bool is_zero(const Matrix2& m) const { return is_zero(m.first) && is_zero(m.second); }

  bool only(const std::vector<Monomial>& allowed) const {
    for (const Polynomial& row : rows_)
      for (const auto& [powers, coefficient] : row)
        if (std::find(allowed.begin(), allowed.end(), powers) == allowed.end()) return false;
    return true;
  }

  /// Regular at the initial state: its columns are not parallel.
  bool is_regular(const Matrix2& m) const {
    const double det = at_start(determinant(m)), size = at_start(size_of(m));
    return std::fabs(det) > Roots::kDeadPosition * size;
  }

  /// The sum of the squares of its entries.
  static Scalar size_of(const Matrix2& m) { return sum({dot(m.first, m.first), dot(m.second, m.second)}); }

  /// Are lengths of all directions scaled alike: a rotation or reflection, times a number?
  bool is_similarity(const Matrix2& m) const {
    const Scalar size = dot(m.first, m.first);
    return agree(size, dot(m.second, m.second), size, samples_) &&
           vanishes(dot(m.first, m.second), size, samples_);
  }

  /// Multiplication with a complex number: its second column is the first turned by a quarter.
  bool is_complex(const Matrix2& m) const {
    const Vector2 turned = quarter(m.first);
    const Scalar size = square_root(size_of(m));
    return agree(m.second.x, turned.x, size, samples_) && agree(m.second.y, turned.y, size, samples_);
  }

  Known known(Vector2 e) const { return {{}, e}; }
  Known known(Scalar value) const { return {value, std::nullopt}; }

  Result solution(Known first, Known second) { return Solution{{first, second}, roots_.conditions()}; }

  static Result swapped(Result result) {
    if (Solution* solution = std::get_if<Solution>(&result))
      std::swap(solution->unknowns[0], solution->unknowns[1]);
    return result;
  }

  Result one_slide() {
    if (!only({kConstant, value_of(0)})) return kOtherForm;
    const Scalar factor = coefficient(0, value_of(0));
    roots_.require(factor * factor, false);
    return Solution{{known(-coefficient(0, kConstant) / factor)}, roots_.conditions()};
  }

  Result one_angle() {
    if (!only({kConstant, cos_of(0), sin_of(0)})) return kOtherForm;
    const Vector2 n = {coefficient(0, cos_of(0)), coefficient(0, sin_of(0))};
    const auto e = roots_.direction(n, -coefficient(0, kConstant), initial_[0]);
    if (!e) return kDead;
    return Solution{{known(*e)}, roots_.conditions()};
  }

  Result two_slides() {
    if (!only({kConstant, value_of(0), value_of(1)})) return kOtherForm;
    const Matrix2 m = {column(value_of(0)), column(value_of(1))};
    if (!is_regular(m)) return kUndetermined;
    const Scalar det = determinant(m);
    const Scalar squares[] = {dot(m.first, m.first), dot(m.second, m.second)}, size = squares[0] * squares[1];
    roots_.require(det * det / size, true);
    const Matrix2 inverse_m = inverse(m);
    const Vector2 s = inverse_m * -column(kConstant);
    return solution(known(s.x), known(s.y));
  }

  /// x·x + n_k·x + w_k = 0 for three slides x: the differences are two planes, which meet in x₀ + s m.
  Result three_spheres() {
    std::vector<Monomial> allowed = {kConstant};
    for (std::size_t k = 0; k < 3; ++k) {
      allowed.push_back(value_of(k));
      allowed.push_back(value_of(k) * value_of(k));
    }
    if (!only(allowed)) return kOtherForm;
    Vector3 n[3], start = {number(initial_[0]), number(initial_[1]), number(initial_[2])};
    Scalar w[3];
    for (std::size_t r = 0; r < 3; ++r) {
      const Scalar square = coefficient(r, value_of(0) * value_of(0));
      for (const std::size_t k : {1, 2})
        if (!agree(square, coefficient(r, value_of(k) * value_of(k)), square, samples_)) return kOtherForm;
      if (loops::is_zero(square)) return kOtherForm;
      roots_.require(square * square, false);
      n[r] = Vector3{coefficient(r, value_of(0)), coefficient(r, value_of(1)), coefficient(r, value_of(2))} /
             square;
      w[r] = coefficient(r, kConstant) / square;
    }
    const Vector3 a = n[1] - n[0], b = n[2] - n[0], m = cross(a, b);
    const Scalar size = dot(m, m), half = 0.5 * dot(n[0], m), radius = 0.25 * dot(n[0], n[0]) - w[0];
    const Scalar squares[] = {dot(a, a), dot(b, b)};
    if (!(at_start(size) > Roots::kDeadPosition * at_start(squares[0] * squares[1]))) return kDead;
    roots_.require(size, false);
    roots_.require(radius, false);
    const Scalar w_a = w[0] - w[1], w_b = w[0] - w[2];
    const Vector3 x = sum({w_a * cross(b, m), w_b * cross(m, a)}) / size;
    const Scalar rest = sum({dot(x, x), dot(n[0], x), w[0]});
    const Scalar centre = -half / size, discriminant = difference({half * half, size * rest});
    const double nearest = at_start(dot(start - x, m) / size);
    const auto s = roots_.slide(centre, discriminant, size, nearest, size * radius);
    if (!s) return kDead;
    const Vector3 found = x + *s * m;
    return Solution{{known(found.x), known(found.y), known(found.z)}, roots_.conditions()};
  }

  Result two_angles() {
    std::vector<Monomial> allowed = {kConstant, cos_of(0), sin_of(0), cos_of(1), sin_of(1)};
    if (only(allowed)) return two_circles();
    for (const Monomial& a : {cos_of(0), sin_of(0)})
      for (const Monomial& b : {cos_of(1), sin_of(1)}) allowed.push_back(a * b);
    if (!only(allowed)) return kOtherForm;
    if (is_zero(matrix(1))) return nested(0, 1);
    if (is_zero(matrix(0))) return swapped(nested(1, 0));
    return kOtherForm;
  }

  /// k + A e_a + B e_b = 0. With A = 1 after division: |k + B e_b| = 1.
  Result two_circles() {
    const Matrix2 A = matrix(0);
    if (!is_regular(A)) return kUndetermined;
    const Matrix2 inverse_A = inverse(A), B = inverse_A * matrix(1);
    if (!is_similarity(B)) return kOtherForm;
    const Vector2 k = inverse_A * column(kConstant), n = {dot(B.first, k), dot(B.second, k)};
    const Scalar gamma = 0.5 * difference({number(1), dot(k, k), dot(B.first, B.first)});
    const auto e_b = roots_.direction(n, gamma, initial_[1]);
    if (!e_b) return kDead;
    return solution(known(-(k + B * *e_b)), known(*e_b));
  }

  /// k + A e_a + Σ C e_a e_b = 0, where A e_a + Σ C e_a e_b = R(a) (u + R(b) w). With A = 1 after division it
  /// is m(e_b) e_a, a product of complex numbers with m = 1 + W e_b, so that |m| = |k|.
  Result nested(std::size_t a, std::size_t b) {
    const Matrix2 A = matrix(a);
    if (!is_regular(A)) return kUndetermined;
    const Matrix2 inverse_A = inverse(A), by_cos = inverse_A * matrix(a, cos_of(b)),
                  by_sin = inverse_A * matrix(a, sin_of(b)), W = {by_cos.first, by_sin.first};
    if (!is_complex(by_cos) || !is_complex(by_sin) || !is_similarity(W)) return kOtherForm;
    const Vector2 k = inverse_A * column(kConstant);
    const Scalar distance = dot(k, k);
    const Scalar gamma = 0.5 * difference({distance - 1.0, dot(W.first, W.first)});
    const auto e_b = roots_.direction({W.first.x, W.second.x}, gamma, initial_[b]);
    if (!e_b) return kDead;
    roots_.require(distance, false);
    const Vector2 m = sum({Vector2{number(1), number(0)}, W * *e_b});
    return solution(known(-times_conjugate(k, m) / distance), known(*e_b));
  }

  Result angle_and_slide(std::size_t a, std::size_t s) {
    const Monomial slide = value_of(s);
    if (only({kConstant, cos_of(a), sin_of(a), slide})) return circle_and_line(a, s);
    if (only({kConstant, cos_of(a), sin_of(a), cos_of(a) * slide, sin_of(a) * slide}))
      return turning_line(a, s);
    return kOtherForm;
  }

  /// k + A e_a + v s = 0. With A = 1 after division: |k + v s| = 1, whose discriminant is |v|² − (k × v)².
  Result circle_and_line(std::size_t a, std::size_t s) {
    const Matrix2 A = matrix(a);
    if (!is_regular(A)) return kUndetermined;
    const Matrix2 inverse_A = inverse(A);
    const Vector2 k = inverse_A * column(kConstant), v = inverse_A * column(value_of(s));
    const Scalar size = dot(v, v), offset = cross(k, v), along = dot(k, v);
    const Scalar centre = -along / size, discriminant = size - offset * offset;
    const auto value = roots_.slide(centre, discriminant, size, initial_[s], size);
    if (!value) return kDead;
    return solution(known(-(k + *value * v)), known(*value));
  }

  /// k + R(a) (u + v s) = 0. With v = 1 after division: |u + s| = |k|, whose discriminant is |k|² − u_y².
  Result turning_line(std::size_t a, std::size_t s) {
    const Matrix2 C = matrix(a, value_of(s));
    if (!is_regular(C)) return kUndetermined;
    const Matrix2 inverse_C = inverse(C), U = inverse_C * matrix(a);
    if (!is_zero(U) && !is_complex(U)) return kOtherForm;
    const Vector2 k = inverse_C * column(kConstant), u = U.first;
    const Scalar distance = dot(k, k);
    const Scalar discriminant = distance - u.y * u.y;
    const auto value = roots_.slide(-u.x, discriminant, number(1), initial_[s], distance);
    if (!value) return kDead;
    roots_.require(distance, false);
    const Vector2 m = {u.x + *value, u.y};
    return solution(known(-times_conjugate(k, m) / distance), known(*value));
  }

  Roots roots_;
  std::vector<Polynomial> rows_;
  const std::vector<double>& initial_;
  const Samples& samples_;
  bool is_angle_[kScalars] = {false, false, false};
};

}  // namespace

void drop_nothing(std::vector<Polynomial>& rows, const Samples& samples, double nothing) {
  for (Polynomial& row : rows) {
    std::vector<Scalar> coefficients;
    for (const auto& [powers, coefficient] : row) coefficients.push_back(coefficient);
    std::vector<double> largest(coefficients.size(), 0);
    for (const std::vector<support::ScaledReal>& values : exactly_evaluated(coefficients, samples))
      for (std::size_t i = 0; i < values.size(); ++i)
        if (values[i].is_number())
          largest[i] = std::max(largest[i], std::fabs(static_cast<double>(values[i])));
    const double scale = largest.empty() ? 0 : *std::max_element(largest.begin(), largest.end());
    std::size_t i = 0;
    for (auto it = row.begin(); it != row.end(); ++i)
      it = largest[i] <= nothing * scale ? row.erase(it) : std::next(it);
  }
}

std::variant<Solution, std::string> solve(ir::Builder& builder, std::vector<Polynomial> rows,
                                          const std::vector<double>& initial, const Samples& samples) {
  return Solver(builder, std::move(rows), initial, samples).run();
}

}  // namespace jourdain::loops
