// Whether a value computed another way keeps its digits, at sampled arguments.
#pragma once

#include <vector>

#include "passes/association.hpp"
#include "passes/definition.hpp"

namespace jourdain::passes {

/// Of each value of a program, and at each of some samples, how far the rounding of one single operation on the way to
/// it may move it at most (to first order, in units of rounding). Leaves that the caller gives are exact; literals that
/// are no floats and constants of the model are rounded. Samples are of all sizes: states at rest at the origin, near
/// it and at random, parameters that are 0 and that differ by twelve powers of ten from each other.
class SampledRounding {
 public:
  explicit SampledRounding(const ir::Program& program);

  /// Is `id`, computed by `definition`, the same at every sample, moved at most twice as far as in the program, and a
  /// number where it is one there? The values that it reads are as they were last followed.
  bool admits(ir::ValueId id, const Definition& definition) const;

  /// The same of a sum or product that is associated otherwise.
  bool admits(ir::ValueId id, ir::Op op, const Association& association) const;

  /// From now on `id` is computed by `definition`.
  void follow(ir::ValueId id, const Definition& definition);
  void follow(ir::ValueId id, ir::Op op, const Association& association);

 private:
  struct Estimate {
    double value = 0, moved = 0;
  };

  static constexpr std::size_t kSamples = 24;

  static double sampled(const ir::Node& leaf, std::size_t sample);
  static Estimate number(double value, bool is_rounded);
  static Estimate result(double value, Estimate a, double by_a, Estimate b, double by_b);
  static Estimate sum(Estimate a, Estimate b);
  static Estimate product(Estimate a, Estimate b);
  static Estimate evaluated(const ir::Node& node, Estimate a, Estimate b, std::size_t sample);
  static Estimate of_function(support::Function function, Estimate a, Estimate b);
  Estimate own(const ir::Node& node, std::size_t sample) const;
  Estimate defined(const ir::Node& node, const Definition& definition, std::size_t sample) const;
  Estimate defined(ir::Op op, const Association& association, std::size_t sample) const;
  template <class Defined>
  bool admits_values(ir::ValueId id, const Defined& defined) const;
  const Estimate& at(ir::ValueId id, std::size_t sample) const {
    return estimates_[id.value * kSamples + sample];
  }
  Estimate at(ir::Signed value, std::size_t sample) const {
    const Estimate& estimate = at(value.value, sample);
    return {value.negative ? -estimate.value : estimate.value, estimate.moved};
  }

  const ir::Program& program_;
  std::vector<Estimate> estimates_;  ///< all samples of a value, then those of the next
  std::vector<double> limits_;       ///< of `moved`; not finite where nothing is compared
};

}  // namespace jourdain::passes
