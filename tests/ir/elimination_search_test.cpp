// Orders of elimination on small graphs, of which all orders can be tried.
#include "ir/elimination_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "ir/scramble.hpp"

namespace jourdain::ir {
namespace {

using Edges = std::vector<std::vector<EliminationTrials::Edge>>;
using Order = EliminationTrials::Order;

constexpr std::size_t kInner = 7, kColumns = 3, kRows = 3, kGraphs = 40;
constexpr EliminationTrials::Effort kEffort = {20000, 24};

/// Inner vertices, columns, rows. Every third partial is 1 or −1, and each fourth one of two numbers.
Edges random_graph(unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](std::size_t n) { return static_cast<std::uint32_t>(random() % n); };
  Edges graph(kInner + kColumns + kRows);
  const auto partial = [&] {
    if (below(3) == 0) return below(2) == 0 ? Residue(1) : -Residue(1);
    return Residue(scrambled(seed, below(4) == 0 ? below(2) : random()));
  };
  const auto join = [&](std::uint32_t operand, std::size_t user) {
    const bool is_joined = std::any_of(graph[user].begin(), graph[user].end(),
                                       [&](const auto& edge) { return edge.operand == operand; });
    if (!is_joined) graph[user].push_back({partial(), operand});
  };
  for (std::size_t v = 0; v < kInner; ++v)
    for (int k = 0; k < 3; ++k)
      join(v > 0 && below(3) != 0 ? below(v) : static_cast<std::uint32_t>(kInner + below(kColumns)), v);
  for (std::size_t r = 0; r < kRows; ++r)
    for (int k = 0; k < 2; ++k)
      join(static_cast<std::uint32_t>(kInner - 1 - below(4)), kInner + kColumns + r);
  return graph;
}

TEST(EliminationSearch, FindsOrdersThatTakeAboutAsFewOperationsAsAnyOther) {
  std::size_t least = 0, found = 0, at_first = 0;
  for (unsigned seed = 0; seed < kGraphs; ++seed) {
    EliminationTrials trials(random_graph(seed), kInner, {});
    const Order start = trials.order(0, kInner);
    const Order better = trials.improved(start, kEffort);
    Order all = start;
    std::sort(all.begin(), all.end());
    std::size_t fewest = trials.operations(all);
    do fewest = std::min(fewest, trials.operations(all));
    while (std::next_permutation(all.begin(), all.end()));
    EXPECT_GE(trials.operations(better), fewest) << seed;
    EXPECT_TRUE(std::is_permutation(better.begin(), better.end(), start.begin(), start.end())) << seed;
    least += fewest;
    found += trials.operations(better);
    at_first += trials.operations(start);
  }
  EXPECT_LE(found - least, kGraphs / 4);
  EXPECT_GE(at_first - least, kGraphs / 2) << "there is nothing to find";
}

/// Many vertices, of which most links stay where they are: no order is known to be best, but the one that is found
/// takes a tenth less than that from which it begins.
TEST(EliminationSearch, FindsOrdersOfManyVertices) {
  constexpr std::size_t kMany = 600, kFew = 20;
  std::mt19937 random(3);
  const auto below = [&](std::size_t n) { return static_cast<std::uint32_t>(random() % n); };
  Edges graph(kMany + kFew + kFew);
  for (std::size_t v = 0; v < graph.size(); ++v) {
    if (v >= kMany && v < kMany + kFew) continue;
    const std::size_t most = std::min(v, kMany);
    for (int k = 0; k < 2; ++k) {
      const auto operand =
          static_cast<std::uint32_t>(most < 5 ? kMany + below(kFew) : most - 1 - below(std::min(most, kFew)));
      const auto is_it = [&](const EliminationTrials::Edge& edge) { return edge.operand == operand; };
      if (std::none_of(graph[v].begin(), graph[v].end(), is_it))
        graph[v].push_back({Residue(scrambled(v, static_cast<std::uint64_t>(k))), operand});
    }
  }
  EliminationTrials trials(graph, kMany, {});
  const Order start = trials.order(kMany, kMany), better = trials.improved(start, {2'000'000, 4});
  EXPECT_TRUE(std::is_permutation(better.begin(), better.end(), start.begin(), start.end()));
  EXPECT_LT(static_cast<double>(trials.operations(better)),
            0.9 * static_cast<double>(trials.operations(start)));
}

TEST(EliminationSearch, IsTheSameInEveryRun) {
  for (unsigned seed = 0; seed < kGraphs; ++seed) {
    EliminationTrials a(random_graph(seed), kInner, {}), b(random_graph(seed), kInner, {});
    b.operations(b.improved(b.order(3, kInner), kEffort));  // what was tried before does not matter
    EXPECT_EQ(a.improved(a.order(0, kInner), kEffort), b.improved(b.order(0, kInner), kEffort)) << seed;
  }
}

/// x → a → y, and a → b → c, which nothing takes.
TEST(EliminationSearch, LeavesOutWhatLeadsNowhere) {
  const Residue p(7);
  const Edges graph = {{{p, 3}}, {{p, 0}}, {{p, 1}}, {}, {{p, 0}}};
  EliminationTrials trials(graph, 3, {});
  EXPECT_EQ(trials.order(0, 3), Order{0});
  EXPECT_EQ(trials.improved({0}, kEffort), Order{0});
  EXPECT_EQ(trials.operations({0}), 1u);
}

/// x → a → b → y and x → a → c → y: ∂y = (b' + c') a' takes less than b' a' + c' a'.
TEST(EliminationSearch, CountsEachValueOnce) {
  const auto p = [](std::uint64_t i) { return Residue(scrambled(7, i)); };
  const Edges graph = {{{p(0), 3}}, {{p(1), 0}}, {{p(2), 0}}, {}, {{Residue(1), 1}, {Residue(1), 2}}};
  EliminationTrials trials(graph, 3, {});
  EXPECT_EQ(trials.operations({2, 1, 0}), 2u);  // a sum and a product
  EXPECT_EQ(trials.operations({0, 1, 2}), 3u);
  EliminationTrials with_one_known(graph, 3, {-(p(0) * p(2))});
  EXPECT_EQ(with_one_known.operations({0, 1, 2}), 2u);
}

}  // namespace
}  // namespace jourdain::ir
