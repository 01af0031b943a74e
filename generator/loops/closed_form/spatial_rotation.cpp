#include "loops/closed_form/spatial_rotation.hpp"

#include <algorithm>
#include <cmath>

#include "loops/closed_form/rotation_rows.hpp"
#include "passes/rewrite.hpp"

namespace jourdain::loops {

namespace {

constexpr const char* kOtherForm =
    "its constraints are none of those that determine a rotation in closed form";
constexpr const char* kDead = "the initial state is a dead position";

using Result = std::variant<Solution, std::string>;

/// R c = d.
struct Image {
  Vector3 c, d;
};

class RotationSolver : RotationRows {
 public:
  RotationSolver(ir::Builder& builder, const std::vector<RotationRow>& rows,
                 const std::optional<double>& initial_scalar, const std::array<double, 4>& quaternion,
                 const Samples& samples)
      : RotationRows(builder, samples),
        roots_(builder, samples),
        rows_(rows),
        initial_scalar_(initial_scalar),
        quaternion_(quaternion) {}

  Result run() {
    if (rows_.size() != 3 + (initial_scalar_ ? 1u : 0u)) return kOtherForm;
    for (std::size_t last = 0; last < rows_.size(); ++last) {
      if (!is_held_in_turning(rows_[last].value)) continue;
      std::vector<Polynomial> others;
      for (std::size_t k = 0; k < rows_.size(); ++k)
        if (k != last) others.push_back(rows_[k].value);
      auto image = initial_scalar_ ? image_of_ball(others) : image_of_line(others);
      if (!image && initial_scalar_ && failure_.empty()) image = image_of_carried_ball(others);
      if (image) return turned(*image, rows_[last]);
      if (!failure_.empty()) return failure_;
    }
    return kOtherForm;
  }

 private:
  /// No scalar unknown, once that is found.
  bool is_held_in_turning(const Polynomial& row) const {
    return only(row, {kConstant, cos_of(0), sin_of(0), value_of(0)},
                {kConstant, cos_of(0), sin_of(0), value_of(0), value_of(0) * value_of(0)});
  }

  /// B R (c + s c′) + w = 0 with w by the scalar unknown, which it solves for.
  std::optional<Image> image_of_ball(const std::vector<Polynomial>& rows) {
    for (const Polynomial& row : rows)
      if (!only(row, {kConstant, value_of(0)}, {kConstant, cos_of(0), sin_of(0), value_of(0)}))
        return std::nullopt;
    auto factors = factored(coefficients(rows, kConstant));
    if (!factors) return std::nullopt;
    factors = scaled(*factors, length_of(factors->left[0]));
    const auto& B = factors->left;
    if (!(std::fabs(at_start(dot(B[0], cross(B[1], B[2])))) > kRegular)) return std::nullopt;
    const auto sliding = sliding_in_body(rows, B);
    if (!sliding) return std::nullopt;
    const bool is_turned = is_orthonormal(B);  // then lengths are those of w
    const Matrix3 inverse = is_turned ? Matrix3{{B[0], B[1], B[2]}} : inverse_of_rows(B[0], B[1], B[2]);
    const auto part = [&](const Monomial& m) {
      const Vector3 w = -column(rows, m);
      return is_turned ? w : inverse * w;
    };
    const Vector3 d = part(kConstant), by_cos = part(cos_of(0)), by_sin = part(sin_of(0)),
                  along = part(value_of(0));
    const bool turns = !is_zero(by_cos) || !is_zero(by_sin);
    std::optional<Image> image;
    if (turns && is_zero(along) && is_zero(*sliding)) image = on_circle(factors->right, d, by_cos, by_sin);
    if (!turns) image = on_lines(factors->right, *sliding, d, along);
    if (image && is_turned) image->d = inverse * image->d;
    return image;
  }

  /// B R c + w = 0 where the scalar unknown turns what carries the rotation, so that B goes round with it: |w| = |c|.
  std::optional<Image> image_of_carried_ball(const std::vector<Polynomial>& rows) {
    const Monomial parts[] = {kConstant, cos_of(0), sin_of(0)};
    std::vector<RotationCoefficients> list;
    for (const Monomial& part : parts)
      for (const Polynomial& row : rows) {
        if (!only(row, {parts[0], parts[1], parts[2]}, {parts[0], parts[1], parts[2]})) return std::nullopt;
        list.push_back(coefficients(row, part));
      }
    auto factors = factored(list);
    if (!factors) return std::nullopt;
    factors = scaled(*factors, length_of(factors->left[0] + factors->left[3]));
    const Vector3 by_cos = -column(rows, parts[1]), by_sin = -column(rows, parts[2]);
    if (is_zero(by_cos) && is_zero(by_sin)) return std::nullopt;
    auto image = on_circle(factors->right, -column(rows, parts[0]), by_cos, by_sin);
    if (!image) return std::nullopt;
    const Vector2 e = *scalar_->direction;
    std::vector<Vector3> B;
    for (std::size_t k = 0; k < 3; ++k)
      B.push_back(sum({factors->left[k], e.x * factors->left[3 + k], e.y * factors->left[6 + k]}));
    if (!is_orthonormal(B)) return std::nullopt;
    image->d = Matrix3{{B[0], B[1], B[2]}} * image->d;
    return image;
  }

  static Scalar length_of(const Vector3& v) { return square_root(dot(v, v)); }

  static bool is_zero(const Vector3& v) {
    return loops::is_zero(v.x) && loops::is_zero(v.y) && loops::is_zero(v.z);
  }

  /// c′, with the same B.
  std::optional<Vector3> sliding_in_body(const std::vector<Polynomial>& rows,
                                         const std::vector<Vector3>& B) const {
    const std::vector<RotationCoefficients> list = coefficients(rows, value_of(0));
    Vector3 along = {number(0), number(0), number(0)};
    std::size_t row = 0, axis = 0;
    for (std::size_t k = 0; k < B.size(); ++k)
      for (std::size_t i = 0; i < 3; ++i)
        if (std::fabs(at_start(B[k][i])) > std::fabs(at_start(B[row][axis]))) row = k, axis = i;
    for (std::size_t j = 0; j < 3; ++j) {
      const Scalar entry = ratio(list[row][axis][j], B[row][axis]);
      (j == 0 ? along.x : j == 1 ? along.y : along.z) = entry;
    }
    const Scalar size = square_root(dot(along, along));
    for (std::size_t k = 0; k < B.size(); ++k)
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          if (!agree(list[k][i][j], B[k][i] * along[j], size, roots_.samples())) return std::nullopt;
    return along;
  }

  /// |d₀ + d_c cos + d_s sin| = |c|, a point that turns about a fixed axis.
  std::optional<Image> on_circle(Vector3 c, Vector3 d, Vector3 by_cos, Vector3 by_sin) {
    const Scalar radius = dot(by_cos, by_cos);
    const bool is_circle = agree(radius, dot(by_sin, by_sin), radius, roots_.samples()) &&
                           vanishes(dot(by_cos, by_sin), radius, roots_.samples());
    if (!is_circle) return std::nullopt;
    const Scalar gamma = 0.5 * difference({dot(c, c), dot(d, d), radius});
    const auto e = roots_.direction({dot(d, by_cos), dot(d, by_sin)}, gamma, *initial_scalar_);
    if (!e) return dead();
    scalar_ = {{}, *e};
    return Image{c, sum({d, e->x * by_cos, e->y * by_sin})};
  }

  /// |d + s d′| = |c + s c′| where one of d′ and c′ is 0.
  std::optional<Image> on_lines(Vector3 c, Vector3 c_along, Vector3 d, Vector3 d_along) {
    const bool in_body = is_zero(d_along);
    if (in_body == is_zero(c_along)) return std::nullopt;
    const Vector3 from = in_body ? c : d, along = in_body ? c_along : d_along, other = in_body ? d : c;
    const Scalar size = dot(along, along), half = dot(from, along), distance = dot(other, other);
    const Scalar nearer = dot(from, from) - distance, centre = -half / size;
    const Scalar discriminant = difference({half * half, size * nearer});
    roots_.require(distance, false);
    const auto s = roots_.slide(centre, discriminant, size, *initial_scalar_, size * distance);
    if (!s) return dead();
    scalar_ = {*s, std::nullopt};
    const Vector3 moved = from + *s * along;
    return in_body ? Image{moved, d} : Image{c, moved};
  }

  /// a_k · Rᵀ d + w_k = 0: two components of Rᵀ d are known, and its length.
  std::optional<Image> image_of_line(const std::vector<Polynomial>& rows) {
    for (const Polynomial& row : rows)
      if (!only(row, {kConstant}, {kConstant})) return std::nullopt;
    std::vector<RotationCoefficients> list;
    for (const Polynomial& row : rows) list.push_back(transposed(coefficients(row)));
    const auto factors = factored(list);
    if (!factors) return std::nullopt;
    const Vector3 a = factors->left[0], b = factors->left[1], d = factors->right, n = cross(a, b);
    const Scalar size = dot(n, n);
    if (!(at_start(size) > kRegular)) return std::nullopt;
    const Scalar w_a = -coefficient(rows[0], kConstant), w_b = coefficient(rows[1], kConstant);
    const Vector3 across = difference({w_a * cross(b, n), w_b * cross(n, a)}) / size;
    const Scalar distance = dot(d, d);
    roots_.require(distance, false);
    const Scalar square = (distance - dot(across, across)) / size, side = dot(turned_back(d), n);
    const auto s = roots_.signed_root(square, side, distance / size);
    if (!s) return dead();
    return Image{across + *s * n, d};
  }

  std::optional<Image> dead() {
    failure_ = kDead;
    return std::nullopt;
  }

  /// Rᵀ v of the initial R.
  Vector3 turned_back(Vector3 v) const { return rotated(v, -1); }
  Vector3 turned_at_start(Vector3 v) const { return rotated(v, 1); }
  Vector3 rotated(Vector3 v, double sign) const {
    const Quaternion q = {number(quaternion_[0]), number(sign * quaternion_[1]),
                          number(sign * quaternion_[2]), number(sign * quaternion_[3])};
    const Quaternion r = q * Quaternion{number(0), v.x, v.y, v.z} * conjugate(q);
    return {r.x, r.y, r.z};
  }

  /// n · R t = value
  struct Held {
    Vector3 n, t;
    Scalar value;
  };

  std::optional<Held> held_in_turning(const RotationRow& last) {
    const auto rod = last.rod ? held_by_rod(*last.rod) : std::nullopt;
    return rod ? rod : held_by_row(last.value);
  }

  Polynomial with_scalar(const Polynomial& row) const {
    return scalar_ ? substituted(row, 0, *scalar_) : row;
  }

  std::optional<Held> held_by_row(const Polynomial& last) {
    const Polynomial row = with_scalar(last);
    if (!only(row, {kConstant}, {kConstant})) return std::nullopt;
    const auto factors = factored({coefficients(row)});
    if (!factors) return std::nullopt;
    return Held{factors->left[0], factors->right, -coefficient(row, kConstant)};
  }

  /// |p + B R t| = l with an orthogonal B: 2 Bᵀp · R t = l² − |p|² − |t|².
  std::optional<Held> held_by_rod(const RodRow& rod) {
    std::vector<Polynomial> rows;
    for (const Polynomial& entry : rod.difference) rows.push_back(with_scalar(entry));
    for (const Polynomial& row : rows)
      if (!only(row, {kConstant}, {kConstant})) return std::nullopt;
    auto factors = factored(coefficients(rows, kConstant));
    if (!factors) return std::nullopt;
    factors = scaled(*factors, length_of(factors->left[0]));
    if (!is_orthonormal(factors->left)) return std::nullopt;
    const auto& B = factors->left;
    const Vector3 p = column(rows, kConstant), t = factors->right;
    return Held{Matrix3{{B[0], B[1], B[2]}} * p, t,
                0.5 * difference({rod.length * rod.length, dot(p, p), dot(t, t)})};
  }

  /// With R c = d and n · R t = γ: R t = (c·t/|c|²) d + x, where x is orthogonal to d, of known length and of
  /// known component along n.
  Result turned(const Image& image, const RotationRow& last) {
    const auto held = held_in_turning(last);
    if (!held) return kOtherForm;
    const auto& [c, d] = image;
    const auto& [n, t, target] = *held;
    const Scalar square = dot(c, c), per_square = number(1) / square, share = dot(c, t) * per_square;
    const Scalar slope = dot(n, d);
    const Vector3 t_across = t - share * c, n_across = n - slope * per_square * d;
    const Scalar radius = dot(t_across, t_across), size = dot(n_across, n_across);
    if (!(at_start(radius) > kRegular * at_start(dot(t, t)))) return kDead;
    if (!(at_start(size) > kRegular * at_start(dot(n, n)))) return kDead;
    roots_.require(size, false);
    const Scalar per_size = number(1) / size, gamma = target - share * slope, along = gamma * per_size;
    const Vector3 sideways = cross(d, n_across);
    const Scalar off_square = (radius - along * gamma) * per_size * per_square,
                 side = dot(turned_at_start(t), sideways);
    const auto off = roots_.signed_root(off_square, side, radius * per_size * per_square);
    if (!off) return kDead;
    const Scalar per_length = reciprocal_root(square), per_width = reciprocal_root(radius);
    const Vector3 e1 = per_length * d, e2 = sum({along * per_width * n_across, *off * per_width * sideways});
    const Vector3 f1 = per_length * c, f2 = per_width * t_across;
    const Vector3 e3 = cross(e1, e2), f3 = cross(f1, f2);
    const Quaternion of_e = quaternion_of({e1, e2, e3}), of_f = quaternion_of({f1, f2, f3});
    const Quaternion q = of_e * conjugate(of_f);
    const double sign = at_start(q.w) * quaternion_[0] + at_start(q.x) * quaternion_[1] +
                        at_start(q.y) * quaternion_[2] + at_start(q.z) * quaternion_[3];
    Solution solution{{}, roots_.conditions()};
    const auto column = [&](std::size_t j) { return sum({f1[j] * e1, f2[j] * e2, f3[j] * e3}); };
    solution.rotation = Matrix3{{column(0), column(1), column(2)}};
    if (scalar_) solution.unknowns.push_back(*scalar_);
    for (const Scalar entry : {q.w, q.x, q.y, q.z})
      solution.unknowns.push_back({sign > 0 ? entry : -entry, std::nullopt});
    return solution;
  }

  Scalar reciprocal_root(Scalar value) {
    const Scalar root = square_root(value);
    return folded(number(1) / root);
  }

  /// Of the rotation matrix with these columns, from the entry that is largest at the initial state.
  Quaternion quaternion_of(const Matrix3& m) {
    const auto at = [&](std::size_t i, std::size_t j) { return m.columns[j][i]; };
    const Scalar trace = at(0, 0) + at(1, 1) + at(2, 2) + 1.0;
    const Scalar squares[] = {trace, at(0, 0) - at(1, 1) - at(2, 2) + 1.0,
                              at(1, 1) - at(0, 0) - at(2, 2) + 1.0,
                              at(2, 2) - at(0, 0) - at(1, 1) + 1.0};  // of the entries, times 4
    std::size_t largest = 0;
    for (std::size_t k = 1; k < 4; ++k)
      if (at_start(squares[k]) > at_start(squares[largest])) largest = k;
    const Scalar root = folded(square_root(squares[largest])), part = number(0.5) / root;
    Scalar entries[4];
    const auto both = [&](std::size_t i, std::size_t j) { return part * (at(i, j) + at(j, i)); };
    const auto difference = [&](std::size_t i, std::size_t j) { return part * (at(j, i) - at(i, j)); };
    if (largest == 0) {
      entries[1] = difference(1, 2), entries[2] = difference(2, 0), entries[3] = difference(0, 1);
    } else {
      const std::size_t i = largest - 1, j = (i + 1) % 3, k = (i + 2) % 3;
      entries[0] = difference(j, k), entries[1 + j] = both(i, j), entries[1 + k] = both(i, k);
    }
    entries[largest] = 0.5 * root;
    roots_.require(squares[largest], false);
    return {entries[0], entries[1], entries[2], entries[3]};
  }

  static constexpr double kRegular = 1e-8;

  Roots roots_;
  const std::vector<RotationRow>& rows_;
  const std::optional<double>& initial_scalar_;
  const std::array<double, 4>& quaternion_;
  std::optional<Known> scalar_;  ///< once it is found
  std::string failure_;
};

}  // namespace

std::variant<Solution, std::string> solve_rotation(ir::Builder& builder, const std::vector<RotationRow>& rows,
                                                   const std::optional<double>& initial_scalar,
                                                   const std::array<double, 4>& initial_quaternion,
                                                   const Samples& samples) {
  return RotationSolver(builder, rows, initial_scalar, initial_quaternion, samples).run();
}

}  // namespace jourdain::loops
