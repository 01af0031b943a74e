// The record of what was compared with what, and how well: the one place where a model is refused.
#pragma once

#include <string>
#include <vector>

#include "ir/program.hpp"
#include "support/scaled_real.hpp"

namespace jourdain::validate {

using support::ScaledReal;

/// Two ways to compute one number in 77 digits may differ by this share of its scale, see ScaledReal: rounding
/// stays below it by twenty orders, wrong algebra above.
inline constexpr long double kAlgebra = 1e-40L;

/// How much more than its depth times the unit roundoff times its scale a value may be off in double.
inline constexpr double kRoundingSlack = 64;

/// The oracle of the symbolic equations.
inline constexpr const char* kReference = "the numeric reference";

/// A function, or a part of the equations, and what it was compared with.
struct Compared {
  std::string function, oracle;
  std::size_t states = 0, numbers = 0;
  double algebra = 0;  ///< worst difference in 77 digits over its scale
  double rounding =
      0;  ///< worst error of the program in double over its scale; 0 where no program takes part
  long double scale = 0;  ///< the largest of all numbers at all states so far
};

class Agreement {
 public:
  /// To rounding of the algebra?
  static bool agree(const std::vector<ScaledReal>& values, const std::vector<ScaledReal>& expected);
  /// All numbers of `function` at one state, in 77 digits. Where one of both is zero throughout, as in a
  /// mechanism that starts in equilibrium, what is left of zero has no scale but that of the states before:
  /// such a state comes last. `allowed`: the share of their scale that they may differ by.
  void same(const std::string& function, const std::string& oracle, const std::vector<ScaledReal>& values,
            const std::vector<ScaledReal>& expected, long double allowed = kAlgebra);
  /// Errors of `values`, computed in double by a program of this depth, against the exact ones. Scales are
  /// those of `expected`: of another way to compute the same, `oracle`; the program's own, `exact`, count up
  /// to 1e4 times the largest of those.
  void rounded(const std::string& function, const std::string& oracle, const std::vector<ScaledReal>& values,
               const std::vector<ScaledReal>& exact, const std::vector<ScaledReal>& expected,
               std::size_t depth);
  void fail(const std::string& sentence);
  /// A failure of the number type: in more digits the program is right.
  void overflow(const std::string& sentence);

  const std::vector<Compared>& compared() const { return compared_; }
  const std::vector<std::string>& failures() const { return failures_; }
  /// How many of them are overflows.
  std::size_t overflows() const { return overflows_; }

 private:
  Compared& record(const std::string& function, const std::string& oracle);

  std::vector<Compared> compared_;
  std::vector<std::string> failures_;
  std::size_t overflows_ = 0;
};

/// Operations on the longest path from a leaf to an output.
std::size_t depth(const ir::Program& program);

}  // namespace jourdain::validate
