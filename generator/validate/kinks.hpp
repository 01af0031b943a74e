// On which sides of their kinks the functions of a model were compared.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ir/module.hpp"

namespace jourdain::validate {

using support::ScaledReal;

/// Where abs, min, max or `if` go over from one side to the other, floor from one whole number to the next, or a table
/// from one interval to the next.
struct Kinks {
  std::size_t count = 0;
  std::size_t on_both_sides = 0;  ///< of them, at the states compared
  double nearest = 0;             ///< the least distance of all, over its scale, see ScaledReal
  std::size_t left_out = 0;  ///< states so near to a kink that rounding may choose the side: not compared
  std::size_t stuck = 0;     ///< kinks of functions that all states are within rounding of, but not all on
  std::size_t on = 0;        ///< states on a kink, where derivatives are those of one side: not compared
};

/// "3 kinks, 2 of them compared on both sides, …"
std::string in_words(const Kinks& kinks);

/// Why a model is refused whose states are all near to some kink.
inline constexpr const char* kAllNearKinks =
    "nothing was compared: every state that was drawn is within rounding of a kink of abs, min, max, floor "
    "or if";

/// Why one is refused with derivatives that no state was left for.
inline constexpr const char* kAllOnKinks =
    "no derivatives were compared: every state that was drawn lies on a kink of abs, min, max, floor or if, "
    "or is within rounding of one";

class KinkSurvey {
 public:
  explicit KinkSurvey(const ir::Module& module);

  struct Look {
    std::vector<ScaledReal> distances;  ///< of every kink, positive on one side
    bool is_near = false;               ///< to one, not on it: rounding may choose the side
    bool is_new = false;                ///< some kink was not seen from this side
    bool is_on = false;                 ///< some kink: derivatives are those of one side
  };
  /// At a state; leaves without constants.
  Look look(ir::LeafValues<ScaledReal> leaves) const;
  /// A kink that all of these states are near to, or on, is no reason to leave one out: nothing would be compared.
  void disregard_stuck(const std::vector<Look>& looks);
  /// The state is compared, or left out because it is near.
  void take(const Look& look);

  bool has_kinks() const { return !seen_.empty(); }
  bool is_complete() const;
  Kinks kinks() const;

 private:
  struct Seen {
    std::vector<double> distances;  ///< at the states compared
    bool below = false, above = false, is_stuck = false, is_close = false;
  };

  std::vector<ir::Program> programs_;  ///< of each function with kinks their distances
  ir::Program constants_;
  std::vector<Seen> seen_;
  std::size_t left_out_ = 0, on_ = 0;
  bool has_derivatives_ = false;
  double nearest_;
};

}  // namespace jourdain::validate
