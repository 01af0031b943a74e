// Linearly implicit methods by their definition: a Rosenbrock method with α, Γ and b, applied to the system of index 1
//   x' = rate(x, z),  z' = a,  0 = r(x, z, a, t)
// in displacements x from the start, velocities z and accelerations a, by dense elimination:
//   K^x_i = h rate(X_i, Z_i) + h (J Σ γ_ij K^x_j + Σ γ_ij K^z_j)
//   K^z_i = h A_i + h Σ γ_ij K^a_j
//   0     = r(X_i, Z_i, A_i, t_i) + r_y Σ γ_ij K^x_j + r_z Σ γ_ij K^z_j + M Σ γ_ij K^a_j + h (Σ_j γ_ij) r_t
// with sums over j ≤ i; of positions c that are carried along, c' = g(x, z, c, t), with derivatives of g left out as in
// W-methods: K^c_i = h g(X_i, Z_i, C_i, t_i), and r_c Σ γ_ij K^c_j beside r_y Σ γ_ij K^x_j. J is ∂rate/∂x at the start,
// which only rotations have. A rotation's displacement is twice its Gibbs vector.
#include "readback/step_data.hpp"

namespace jourdain::readback {

namespace {

/// q ⊗ (1, θ/2), then unit length.
void turn(const Motion& start, const ExpectedTangent& at, const ExactVector& x, Motion& moved) {
  const Exact half = exact(0.5);
  const Exact* q = &start.y[at.position];
  const Exact g[3] = {half * x[at.velocity], half * x[at.velocity + 1], half * x[at.velocity + 2]};
  moved.y[at.position] = q[0] - (q[1] * g[0] + q[2] * g[1] + q[3] * g[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    moved.y[at.position + 1 + i] = q[1 + i] + q[0] * g[i] + (q[1 + j] * g[k] - q[1 + k] * g[j]);
  }
}

class RosenbrockStep {
 public:
  RosenbrockStep(const Expected& expected, const RosenbrockTable& table, OpaqueSystem& system, StepData& data)
      : expected_(expected),
        table_(table),
        system_(system),
        data_(data),
        start_(data.motion),
        n_(expected.velocities.size()),
        carried_(expected.carried.size()),
        stages_(table.m.size()) {}

  void take() {
    coefficients();
    if (data_.count == 0)
      data_.accelerations = system_.forward_dynamics(start_, input_at(system_, data_, start_));
    data_.count = 1;
    linearise();
    const DenseSolver solver(matrix());
    Motion stage = start_;
    for (std::size_t i = 0; i < stages_; ++i) K_.push_back(solver.solve(right_hand_side(i, stage)));
    finish(stage);
  }

 private:
  /// α = A Γ and b = Γᵀ m from the table, Γ = γ (1 − S)⁻¹.
  void coefficients() {
    ExactMatrix A = zero_matrix(stages_, stages_), inverse = identity(stages_);
    for (std::size_t i = 0; i < stages_; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        A[i][j] = exact(table_.A[i][j]);
        inverse[i][j] = -exact(table_.S[i][j]);
      }
    const DenseSolver solver(inverse);
    Gamma_ = zero_matrix(stages_, stages_);
    for (std::size_t j = 0; j < stages_; ++j) {
      ExactVector unit(stages_, exact(0.0));
      unit[j] = exact(table_.gamma);
      const ExactVector column = solver.solve(unit);
      for (std::size_t i = 0; i < stages_; ++i) Gamma_[i][j] = column[i];
    }
    alpha_ = A * Gamma_;
    for (std::size_t j = 0; j < stages_; ++j) {
      Exact sum = exact(0.0);
      for (std::size_t i = 0; i < stages_; ++i) sum = sum + exact(table_.m[i]) * Gamma_[i][j];
      b_.push_back(sum);
    }
  }

  /// Derivatives at the start, and of the residual by time with what the inputs change.
  void linearise() {
    const ExactVector input = input_at(system_, data_, start_);
    derivatives_ = system_.residual_derivatives(start_, input, data_.accelerations);
    change_ = ExactVector(n_, exact(0.0));
    for (std::size_t i = 0; i < n_; ++i) change_[i] = data_.h * derivatives_.r_t[i];
    if (data_.is_sampled) add_input_change();
    J_ = zero_matrix(n_, n_);
    for (const ExpectedTangent& at : expected_.quaternions)
      for (std::size_t i = 0; i < 3; ++i) {  // ½ θ × ω
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3, o = at.velocity;
        J_[o + i][o + j] = exact(0.5) * start_.z[o + k];
        J_[o + i][o + k] = -exact(0.5) * start_.z[o + j];
      }
  }

  /// h du/dt at the start: of the cubic through samples at 0, h/3, 2h/3 and h.
  void add_input_change() {
    const Fraction weights[] = {{-11, 2}, {9, 1}, {-9, 2}, {1, 1}};
    for (long k = 0; k < 4; ++k) {
      Motion at = start_;
      at.t = start_.t + exact(Fraction{k, 3}) * data_.h;
      const ExactVector sample = system_.sample(at);
      for (std::size_t i = 0; i < n_; ++i)
        for (std::size_t j = 0; j < sample.size(); ++j)
          change_[i] = change_[i] + exact(weights[k]) * derivatives_.r_u[i][j] * sample[j];
    }
  }

  /// Of K = (K^x, K^z, K^a, K^c) in the equations of one stage.
  ExactMatrix matrix() const {
    ExactMatrix W = identity(3 * n_ + carried_);
    const Exact gamma = exact(table_.gamma), s = data_.h * gamma;
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = 0; j < n_; ++j) {
        W[i][j] = W[i][j] - s * J_[i][j];
        W[2 * n_ + i][j] = gamma * derivatives_.r_y[i][j];
        W[2 * n_ + i][n_ + j] = gamma * derivatives_.r_z[i][j];
        W[2 * n_ + i][2 * n_ + j] = gamma * derivatives_.M[i][j];
      }
      for (std::size_t c = 0; c < carried_; ++c)
        W[2 * n_ + i][3 * n_ + c] = gamma * derivatives_.r_y[i][n_ + c];
      W[i][n_ + i] = -s;
      W[n_ + i][2 * n_ + i] = -s;
    }
    return W;
  }

  /// Σ_j factors[j] K_j over the stages so far.
  ExactVector combination(const ExactVector& factors) const {
    ExactVector sum(3 * n_ + carried_, exact(0.0));
    for (std::size_t j = 0; j < K_.size(); ++j)
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = sum[i] + factors[j] * K_[j][i];
    return sum;
  }

  ExactVector part(const ExactVector& all, std::size_t index) const {
    const auto begin = all.begin() + static_cast<long>(index * n_);
    return ExactVector(begin, begin + static_cast<long>(n_));
  }

  ExactVector right_hand_side(std::size_t i, Motion& stage) {
    const ExactVector moved = combination(alpha_[i]), damped = combination(Gamma_[i]);
    const ExactVector x = part(moved, 0);
    ExactVector a = data_.accelerations;
    stage.t = start_.t + exact(table_.nodes[i]) * data_.h;
    for (std::size_t k = 0; k < n_; ++k) {
      stage.z[k] = start_.z[k] + moved[n_ + k];
      a[k] = a[k] + moved[2 * n_ + k];
    }
    if (i > 0) displace(x, stage);
    if (i > 0) carry(moved, stage);
    if (i > 0 && !expected_.dependents.empty())
      for (int k = 0; k < expected_.closings; ++k) system_.correct(stage);
    const ExactVector r = system_.residual(stage, input_at(system_, data_, stage), a),
                      rate = rate_of(x, stage.z);
    ExactVector displaced = part(damped, 0);
    displaced.insert(displaced.end(), damped.end() - static_cast<long>(carried_), damped.end());
    const ExactVector Jx = J_ * part(damped, 0), ry = derivatives_.r_y * displaced,
                      rz = derivatives_.r_z * part(damped, 1), Ma = derivatives_.M * part(damped, 2);
    ExactVector b(3 * n_ + carried_, exact(0.0));
    if (carried_ > 0) {
      const ExactVector rates = system_.position_rate(stage);
      for (std::size_t c = 0; c < carried_; ++c) b[3 * n_ + c] = data_.h * rates[expected_.carried[c]];
    }
    for (std::size_t k = 0; k < n_; ++k) {
      b[k] = data_.h * (rate[k] + Jx[k] + damped[n_ + k]);
      b[n_ + k] = data_.h * (a[k] + damped[2 * n_ + k]);
      b[2 * n_ + k] = -(r[k] + ry[k] + rz[k] + Ma[k] + exact(table_.shares[i]) * change_[k]);
    }
    return b;
  }

  /// Of a rotation ω + g × ω + g (g · ω), g = θ/2.
  ExactVector rate_of(const ExactVector& x, const ExactVector& z) const {
    ExactVector rate = z;
    for (const ExpectedTangent& at : expected_.quaternions) {
      const std::size_t o = at.velocity;
      Exact along = exact(0.0);
      for (std::size_t i = 0; i < 3; ++i) along = along + exact(0.5) * x[o + i] * z[o + i];
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        rate[o + i] = z[o + i] + exact(0.5) * (x[o + j] * z[o + k] - x[o + k] * z[o + j] + along * x[o + i]);
      }
    }
    return rate;
  }

  void displace(const ExactVector& x, Motion& moved) const {
    for (const ExpectedTangent& at : expected_.scalars)
      moved.y[at.position] = start_.y[at.position] + x[at.velocity];
    for (const ExpectedTangent& at : expected_.quaternions) turn(start_, at, x, moved);
    normalise_quaternions(expected_, moved);
  }

  void carry(const ExactVector& moved, Motion& motion) const {
    for (std::size_t c = 0; c < carried_; ++c)
      motion.y[expected_.carried[c]] = start_.y[expected_.carried[c]] + moved[3 * n_ + c];
  }

  /// The end of the step; dependent positions are looked for near those of the last stage.
  void finish(const Motion& last_stage) {
    const ExactVector moved = combination(b_);
    Motion& motion = data_.motion;
    for (const std::size_t entry : expected_.dependents) motion.y[entry] = last_stage.y[entry];
    displace(part(moved, 0), motion);
    carry(moved, motion);
    for (std::size_t k = 0; k < n_; ++k) {
      motion.z[k] = start_.z[k] + moved[n_ + k];
      data_.accelerations[k] = data_.accelerations[k] + moved[2 * n_ + k];
    }
    motion.t = start_.t + data_.h;
    const int closings = expected_.dependents.empty() ? 1 : expected_.closings;
    for (int k = 0; k < closings; ++k) system_.correct(motion);
  }

  const Expected& expected_;
  const RosenbrockTable table_;
  OpaqueSystem& system_;
  StepData& data_;
  const Motion start_;
  std::size_t n_, carried_, stages_;
  ExactMatrix alpha_, Gamma_, J_;
  ExactVector b_, change_;
  Derivatives derivatives_;
  std::vector<ExactVector> K_;
};

/// With every coefficient rounded, as files for float have them.
RosenbrockTable in_float(RosenbrockTable table) {
  const auto round = [](std::vector<double>& list) {
    for (double& value : list) value = static_cast<double>(static_cast<float>(value));
  };
  std::vector<double> gamma = {table.gamma};
  for (std::vector<double>* list : {&gamma, &table.m, &table.nodes, &table.shares}) round(*list);
  for (std::vector<double>& row : table.A) round(row);
  for (std::vector<double>& row : table.S) round(row);
  table.gamma = gamma[0];
  return table;
}

}  // namespace

void rosenbrock_step(const Expected& expected, const RosenbrockTable& table, OpaqueSystem& system,
                     StepData& data) {
  RosenbrockStep(expected, expected.is_float ? in_float(table) : table, system, data).take();
}

}  // namespace jourdain::readback
