// Orders of elimination that take few operations, looked for by trying.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "ir/prime_field.hpp"

namespace jourdain::ir {

/// A graph of partial derivatives as residues at one random point (ir/fingerprints.hpp): equal ones are taken for one
/// value, so that a trial counts the operations that a builder would write, less those that some pass finds equal. What
/// such a count says decides which order is taken, never what is computed.
class EliminationTrials {
 public:
  struct Edge {
    Residue partial;
    std::uint32_t operand = 0;
    bool fixed =
        false;  ///< a number, or made with the model: what is made from such ones alone costs nothing
  };
  using Order = std::vector<std::uint32_t>;
  /// Spent on an order.
  struct Effort {
    std::size_t work = 0;      ///< products of partial derivatives, about
    std::size_t patience = 0;  ///< ends after so many sweeps that save little
  };

  /// Edges by the vertex that they lead to, from inner vertices before it. Vertices from `inner` on are columns and
  /// rows; what is `known` need not be computed.
  EliminationTrials(std::vector<std::vector<Edge>> operands, std::size_t inner,
                    const std::vector<Residue>& known);

  /// All inner vertices: first those with one user or one operand, again and again, which makes no new edges; then
  /// those below `forward`, operands first; then those below `late`, results first; then the others, operands first.
  Order order(std::size_t forward, std::size_t late);

  std::size_t operations(const Order& order);

  /// Moves vertices before or after neighbours, at random but the same in every run, and keeps what takes no more
  /// operations.
  Order improved(Order order, const Effort& effort);

 private:
  static constexpr std::uint32_t kNoPosition = ~std::uint32_t{0};
  struct Slot {
    std::uint64_t value = 0;
    std::uint32_t stamp = 0;           ///< where it was computed last; 0: the slot is empty
    std::uint32_t last = kNoPosition;  ///< of the positions that compute it, if no earlier one does
  };
  /// Of an edge among those that lead to the vertex at hand.
  struct Place {
    std::uint32_t stamp = 0, at = 0;
  };
  class Draws;
  static constexpr std::size_t kRemoval = 4;  ///< what removing a vertex costs besides, in products
  static constexpr std::uint32_t kUnknown = 1, kKnown = 2;  ///< stamps

  /// What is to be done with values that steps compute.
  enum class Purpose {
    kTry,     ///< count those that no step after the window computes
    kRecord,  ///< note the last positions
    kForget,  ///< the positions of the window
    kKeep     ///< they are there from now on
  };

  void start(const Order& order);
  void begin_trial(Purpose purpose);
  void keep_changes();
  void remove(std::uint32_t vertex);
  void connect(const Edge& edge, std::uint32_t user, std::vector<Edge>& edges);
  std::vector<Edge>& operands_to_change(std::uint32_t vertex);
  std::vector<std::uint32_t>& users_to_change(std::uint32_t vertex);
  void compute(Residue value);
  void forget_last(Slot& slot);
  Slot& slot_of(std::uint64_t value);
  void make_room();
  std::vector<std::uint32_t> users_of(std::uint32_t vertex) const;
  std::vector<std::uint32_t> neighbours(std::uint32_t vertex) const;
  bool is_link(std::uint32_t vertex) const;
  Order links();
  Order regrouped(const Order& order, Draws& draws);
  void sweep(Order& order, Draws& draws, std::size_t work);
  std::vector<std::size_t> positions(const Order& order) const;
  bool takes_at_most(std::size_t most, const Order& part, std::size_t last);
  void replace(Order& order, const Order& by, std::size_t first);

  struct Graph {
    std::vector<std::vector<Edge>> operands;
    std::vector<std::vector<std::uint32_t>> users;  ///< some may be none any more
  };

  std::size_t inner_, work_ = 0;
  std::optional<Order> links_;
  Graph given_;  ///< all of it
  Graph kept_;   ///< where trials begin
  Graph now_;
  std::vector<std::uint32_t> operands_trial_, users_trial_;  ///< that changed them last
  std::vector<std::uint32_t> changed_operands_, changed_users_;

  Purpose purpose_ = Purpose::kKeep;
  std::uint32_t trial_ = kKnown, sweep_ = kKnown;
  std::size_t operations_ = 0;
  std::uint32_t position_ = 0, window_end_ = kNoPosition;
  std::vector<std::size_t> ending_;  ///< by position: how many values are computed there last
  std::vector<Slot> slots_;          ///< of values without their signs; a power of two
  std::size_t used_ = 0;

  std::vector<std::uint32_t> removed_users_;
  std::vector<Edge> removed_operands_;
  std::vector<Place> places_;  ///< by operand
  std::uint32_t places_stamp_ = 0;
};

}  // namespace jourdain::ir
