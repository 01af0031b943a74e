#include "loops/closing_check.hpp"

#include <algorithm>
#include <cmath>

#include "loops/sharing_rows.hpp"
#include "reference/minimal.hpp"

namespace jourdain::loops {

using ir::LeafKind;

namespace {

constexpr long double kOff = 1e-3L;  ///< rad, m

Eigen::Index at(std::size_t i) { return static_cast<Eigen::Index>(i); }

/// What the closing should make of a state.
struct Closed {
  Vector y, z;
  long double regularity = 1, opening = 0;
  long double condition = 1;  ///< of what was solved
};

long double condition_of(const Matrix& A) {
  const Vector sigma = Eigen::JacobiSVD<Matrix>(A).singularValues();
  return sigma.size() == 0 ? 1 : sigma[0] / sigma[sigma.size() - 1];
}

class Expectation {
 public:
  Expectation(const model::Mechanism& mechanism, const NumericClosure& closure, const LoopPlan& plan,
              const Ray& ray)
      : closure_(closure), plan_(plan), reference_(mechanism), start_(ray.configuration) {
    const std::size_t n = closure.velocity_count();
    std::vector<bool> moves(n, !plan.is_reduced());
    for (const Block& block : plan.blocks)
      for (const std::size_t k : block.dependents) moves[k] = true;
    Vector off = Vector::Zero(at(n));
    z_ = Vector::Zero(at(n));
    for (std::size_t k = 0; k < n; ++k) {
      if (moves[k]) off[at(k)] = kOff * std::cos(static_cast<long double>(3 * k + 1));
      if (!plan.is_reduced()) z_[at(k)] = ray.z[k] + off[at(k)];
    }
    moves_ = moves;
    start_ = rounded(closure.displaced(start_, off));
  }

  const Configuration& start() const { return start_; }
  const Vector& velocities() const { return z_; }

  Closed closed() const {
    if (plan_.treatment == model::LoopTreatment::kMultipliers) return projected();
    return plan_.closed_form ? solved() : iterated();
  }

 private:
  /// To double, so that program and expectation see the same state.
  static Configuration rounded(Configuration c) {
    for (long double& entry : c.y) entry = static_cast<double>(entry);
    return c;
  }

  Matrix rows_of(const Matrix& G, const std::vector<std::size_t>& rows) const {
    Matrix part(at(rows.size()), G.cols());
    for (std::size_t k = 0; k < rows.size(); ++k) part.row(at(k)) = G.row(at(rows[k]));
    return part;
  }

  Vector rows_of(const Vector& g, const std::vector<std::size_t>& rows) const {
    Vector part(at(rows.size()));
    for (std::size_t k = 0; k < rows.size(); ++k) part[at(k)] = g[at(rows[k])];
    return part;
  }

  /// Quaternions turn by quat ⊗ (1, d/2), brought to unit length.
  Configuration displaced(const Configuration& from, Vector d) const {
    for (const model::Tangent::Scalar& s : closure_.tangent().quaternions) {
      const long double size = d.segment<3>(at(s.velocity)).norm();
      if (size > 0) d.segment<3>(at(s.velocity)) *= 2 * std::atan(size / 2) / size;
    }
    return closure_.displaced(from, d);
  }

  Matrix mass_matrix() const {
    const reference::State<long double> state{start_.t, start_.y, Vector::Zero(z_.size())};
    return reference_.evaluate(state, Vector::Zero(at(reference_.input_count()))).M;
  }

  Closed projected() const {
    Closed result;
    const std::vector<std::size_t> rows = plan_.solved_rows();
    const Matrix G = rows_of(closure_.jacobian(start_), rows);
    const Matrix back = mass_matrix().ldlt().solve(G.transpose());
    const SchurSolution schur(plan_, G * back, plan_.closing_regularisation);
    const Vector lambda = schur.solved(rows_of(closure_.value(start_), rows));
    const Configuration moved = displaced(start_, -back * lambda);
    const Vector rate = rows_of(Vector(closure_.jacobian(moved) * z_ + closure_.time_rate(moved)), rows);
    result.y = moved.y;
    result.z = z_ - back * schur.solved(rate);
    result.regularity = schur.determinant() / plan_.determinant;
    result.opening = (back * lambda).squaredNorm();
    result.condition = schur.condition();
    return result;
  }

  Closed iterated() const {
    Closed result;
    Configuration c = start_;
    for (const Block& block : plan_.blocks)
      for (int i = 0; i < plan_.iterations; ++i) {
        const Matrix D = rows_of(closure_.jacobian(c), block.rows)(Eigen::all, block.dependents);
        const Vector change = D.fullPivLu().solve(-rows_of(closure_.value(c), block.rows));
        Vector d = Vector::Zero(at(closure_.velocity_count()));
        for (std::size_t k = 0; k < block.dependents.size(); ++k) d[at(block.dependents[k])] = change[at(k)];
        c = displaced(c, d);
        if (i == 0) result.opening += change.squaredNorm();
        result.condition = std::max(result.condition, condition_of(D));
        if (i + 1 < plan_.iterations) continue;
        const long double det = D.determinant();
        result.regularity *= at(block.dependents.size()) <= 3 ? det : det * det;
      }
    result.regularity /= plan_.determinant;
    result.y = c.y;
    return result;
  }

  Closed solved() const {
    Closed result;
    const Configuration c = closure_.assembled(start_, moves_);
    result.y = c.y;
    result.opening = (c.y - start_.y).squaredNorm();
    result.regularity = NAN;  // the discriminants are the closed form's own
    for (const Block& block : plan_.blocks)
      result.condition =
          std::max(result.condition,
                   condition_of(rows_of(closure_.jacobian(c), block.rows)(Eigen::all, block.dependents)));
    return result;
  }

  const NumericClosure& closure_;
  const LoopPlan& plan_;
  reference::Reference<long double> reference_;
  Configuration start_;
  Vector z_;
  std::vector<bool> moves_;
};

long double beyond(const LoopPlan& plan, const Vector& y, int range) {
  const ProvenRange& r = plan.proven()->positions[static_cast<std::size_t>(range)];
  return (y[at(r.index)] - r.low) * (y[at(r.index)] - r.high);
}

}  // namespace

double closing_error(const model::Mechanism& mechanism, const NumericClosure& closure, const LoopPlan& plan,
                     const ir::Module& module, const std::vector<double>& parameters, const Ray& ray,
                     const ir::Program& program) {
  const Expectation expectation(mechanism, closure, plan, ray);
  ir::LeafValues<double> leaves;
  leaves[LeafKind::kParameter] = parameters;
  leaves[LeafKind::kConstant] = ir::interpret(module.constants, leaves);
  leaves[LeafKind::kPosition].assign(expectation.start().y.begin(), expectation.start().y.end());
  leaves[LeafKind::kVelocity].assign(expectation.velocities().begin(), expectation.velocities().end());
  leaves[LeafKind::kTime] = {static_cast<double>(expectation.start().t)};
  const std::vector<double> values = ir::interpret(program, leaves);
  const Closed expected = expectation.closed();
  long double worst = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const ir::Output& output = program.outputs[k];
    const long double right = output.name == "y"         ? expected.y[output.row]
                              : output.name == "z"       ? expected.z[output.row]
                              : output.name == "opening" ? expected.opening
                              : output.name == "beyond"  ? beyond(plan, expected.y, output.row)
                                                         : expected.regularity;
    if (std::isnan(right)) continue;
    const long double error = std::abs(values[k] - right) / ((1 + std::abs(right)) * expected.condition);
    worst = error <= worst ? worst : error;
  }
  return static_cast<double>(worst);
}

}  // namespace jourdain::loops
