#include "ir/elimination_search.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "ir/scramble.hpp"

namespace jourdain::ir {

namespace {

bool is_unit(Residue value) { return value == Residue(1) || value == -Residue(1); }

/// No edges lead to vertices from which no row is reached.
void drop_dead_ends(std::vector<std::vector<EliminationTrials::Edge>>& operands, std::size_t inner) {
  std::vector<bool> is_alive(operands.size(), false);
  for (std::size_t v = operands.size(); v-- > 0;) {
    if (v < inner && !is_alive[v]) operands[v].clear();
    for (const EliminationTrials::Edge& edge : operands[v]) is_alive[edge.operand] = true;
  }
}

}  // namespace

/// The same in every run.
class EliminationTrials::Draws {
 public:
  std::size_t below(std::size_t bound) { return scrambled(kSeed, ++drawn_) % bound; }

  void shuffle(std::vector<std::size_t>& list) {
    for (std::size_t k = list.size(); k > 1; --k) std::swap(list[k - 1], list[below(k)]);
  }

 private:
  static constexpr std::uint64_t kSeed = 0x656c696d696e6176u;
  std::uint64_t drawn_ = 0;
};

EliminationTrials::EliminationTrials(std::vector<std::vector<Edge>> operands, std::size_t inner,
                                     const std::vector<Residue>& known)
    : inner_(inner),
      operands_trial_(operands.size()),
      users_trial_(operands.size()),
      slots_(1024),
      places_(operands.size()) {
  drop_dead_ends(operands, inner);
  given_.users.resize(operands.size());
  for (std::uint32_t v = 0; v < operands.size(); ++v)
    for (const Edge& edge : operands[v]) given_.users[edge.operand].push_back(v);
  given_.operands = std::move(operands);
  for (const Residue value : known) compute(value);
}

/// A sweep over an order: all that is known of values is forgotten but what is given.
void EliminationTrials::start(const Order& order) {
  kept_ = now_ = given_;
  changed_operands_.clear();
  changed_users_.clear();
  for (Slot& slot : slots_) slot.last = kNoPosition;
  ending_.assign(order.size(), 0);
  sweep_ = trial_ + 1;
  trial_ = sweep_ + 1;
  window_end_ = kNoPosition;
  begin_trial(Purpose::kRecord);
  for (position_ = 0; position_ < order.size(); ++position_) remove(order[position_]);
}

/// Puts back what the last trial changed.
void EliminationTrials::begin_trial(Purpose purpose) {
  for (const std::uint32_t v : changed_operands_) now_.operands[v] = kept_.operands[v];
  for (const std::uint32_t v : changed_users_) now_.users[v] = kept_.users[v];
  changed_operands_.clear();
  changed_users_.clear();
  ++trial_;
  operations_ = 0;
  purpose_ = purpose;
}

/// Trials begin with what this one has done.
void EliminationTrials::keep_changes() {
  for (const std::uint32_t v : changed_operands_) kept_.operands[v] = now_.operands[v];
  for (const std::uint32_t v : changed_users_) kept_.users[v] = now_.users[v];
  changed_operands_.clear();
  changed_users_.clear();
}

std::vector<EliminationTrials::Edge>& EliminationTrials::operands_to_change(std::uint32_t vertex) {
  if (operands_trial_[vertex] != trial_) changed_operands_.push_back(vertex);
  operands_trial_[vertex] = trial_;
  return now_.operands[vertex];
}

std::vector<std::uint32_t>& EliminationTrials::users_to_change(std::uint32_t vertex) {
  if (users_trial_[vertex] != trial_) changed_users_.push_back(vertex);
  users_trial_[vertex] = trial_;
  return now_.users[vertex];
}

/// Slots for four times as many values as matter, without what earlier trials left.
void EliminationTrials::make_room() {
  std::vector<Slot> live;
  std::copy_if(slots_.begin(), slots_.end(), std::back_inserter(live), [this](const Slot& slot) {
    return slot.stamp == kKnown || slot.stamp == sweep_ || slot.stamp == trial_ || slot.last != kNoPosition;
  });
  std::size_t size = 1024;
  while (size < 4 * live.size()) size *= 2;
  slots_.assign(size, {});
  used_ = 0;
  for (const Slot& slot : live) slot_of(slot.value) = slot;
}

EliminationTrials::Slot& EliminationTrials::slot_of(std::uint64_t value) {
  std::size_t k = value & (slots_.size() - 1);
  while (slots_[k].stamp != 0 && slots_[k].value != value) k = (k + 1) & (slots_.size() - 1);
  if (slots_[k].stamp == 0) {
    ++used_;
    slots_[k] = {value, kUnknown, kNoPosition};
  }
  return slots_[k];
}

void EliminationTrials::forget_last(Slot& slot) {
  if (slot.last == kNoPosition) return;
  --ending_[slot.last];
  slot.last = kNoPosition;
}

void EliminationTrials::compute(Residue value) {
  if (value.is_zero() || is_unit(value)) return;
  if (2 * used_ > slots_.size()) make_room();
  Slot& slot = slot_of(value.is_negative() ? (-value).value() : value.value());
  if (slot.stamp == kKnown || slot.stamp == sweep_) return;
  const bool is_later = slot.last != kNoPosition && slot.last > window_end_;
  switch (purpose_) {
    case Purpose::kTry:
      if (slot.stamp != trial_ && !is_later) ++operations_;
      slot.stamp = trial_;
      break;
    case Purpose::kRecord:
      if (is_later) break;
      forget_last(slot);
      slot.last = position_;
      ++ending_[position_];
      break;
    case Purpose::kForget:
      if (!is_later) forget_last(slot);
      break;
    case Purpose::kKeep:
      forget_last(slot);
      slot.stamp = sweep_;
      break;
  }
}

/// Adds an edge to those that lead to `user`, whose places are known.
void EliminationTrials::connect(const Edge& edge, std::uint32_t user, std::vector<Edge>& edges) {
  Place& place = places_[edge.operand];
  if (place.stamp != places_stamp_) {
    place = {places_stamp_, static_cast<std::uint32_t>(edges.size())};
    edges.push_back(edge);
    users_to_change(edge.operand).push_back(user);
    return;
  }
  Edge& known = edges[place.at];
  known.partial = known.partial + edge.partial;
  known.fixed = known.fixed && edge.fixed;
  if (!known.fixed) compute(known.partial);
  if (!known.partial.is_zero()) return;
  places_[edges.back().operand].at = place.at;
  place.stamp = 0;
  known = edges.back();
  edges.pop_back();
}

void EliminationTrials::remove(std::uint32_t vertex) {
  removed_users_.clear();
  removed_users_.swap(users_to_change(vertex));
  removed_operands_.clear();
  removed_operands_.swap(operands_to_change(vertex));
  work_ += kRemoval;
  for (const std::uint32_t user : removed_users_) {
    const std::vector<Edge>& present = now_.operands[user];
    const auto found =
        std::find_if(present.begin(), present.end(), [&](const Edge& e) { return e.operand == vertex; });
    if (found == present.end()) continue;
    const auto at = static_cast<std::size_t>(found - present.begin());
    std::vector<Edge>& edges = operands_to_change(user);
    const Edge outer = edges[at];
    edges[at] = edges.back();
    edges.pop_back();
    work_ += removed_operands_.size();
    ++places_stamp_;
    for (std::uint32_t k = 0; k < edges.size(); ++k) places_[edges[k].operand] = {places_stamp_, k};
    for (const Edge& inner : removed_operands_) {
      const Edge product{outer.partial * inner.partial, inner.operand, outer.fixed && inner.fixed};
      if (!product.fixed && !is_unit(outer.partial) && !is_unit(inner.partial)) compute(product.partial);
      connect(product, user, edges);
    }
  }
}

EliminationTrials::Order EliminationTrials::order(std::size_t forward, std::size_t late) {
  if (!links_) links_ = links();
  Order order = *links_;
  std::vector<bool> is_taken(inner_, false);
  for (const std::uint32_t v : order) is_taken[v] = true;
  const auto take = [&](std::size_t v) {
    if (is_taken[v] || given_.operands[v].empty() || given_.users[v].empty()) return;
    order.push_back(static_cast<std::uint32_t>(v));
    is_taken[v] = true;
  };
  for (std::size_t v = 0; v < forward; ++v) take(v);
  for (std::size_t v = late; v-- > forward;) take(v);
  for (std::size_t v = late; v < inner_; ++v) take(v);
  return order;
}

/// Vertices with one operand or one user, in the order in which they become that.
EliminationTrials::Order EliminationTrials::links() {
  Order order;
  std::vector<bool> is_taken(inner_, false);
  start({});
  begin_trial(Purpose::kTry);
  for (std::size_t before = 1; before != order.size();) {  // at first anything but none
    before = order.size();
    for (std::uint32_t v = 0; v < inner_; ++v)
      if (!is_taken[v] && is_link(v)) {
        order.push_back(v);
        is_taken[v] = true;
        remove(v);
      }
  }
  return order;
}

/// Whether a vertex has one operand or one user that is an inner vertex.
bool EliminationTrials::is_link(std::uint32_t vertex) const {
  const std::vector<Edge>& operands = now_.operands[vertex];
  if (operands.empty() || now_.users[vertex].empty()) return false;
  if (operands.size() == 1 && operands[0].operand < inner_) return true;
  const std::vector<std::uint32_t> users = users_of(vertex);
  return users.size() == 1 && users[0] < inner_;
}

std::vector<std::uint32_t> EliminationTrials::users_of(std::uint32_t vertex) const {
  std::vector<std::uint32_t> list = now_.users[vertex];
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  std::erase_if(list, [&](std::uint32_t user) {
    const std::vector<Edge>& edges = now_.operands[user];
    return std::none_of(edges.begin(), edges.end(), [&](const Edge& edge) { return edge.operand == vertex; });
  });
  return list;
}

std::size_t EliminationTrials::operations(const Order& order) {
  start({});
  begin_trial(Purpose::kTry);
  for (const std::uint32_t v : order) remove(v);
  return operations_;
}

/// Orders of the same vertices lead to the same graph. So what follows a part that was reordered computes what it did,
/// and what the part computes counts only where nothing after it computes the same.
bool EliminationTrials::takes_at_most(std::size_t most, const Order& part, std::size_t last) {
  window_end_ = static_cast<std::uint32_t>(last);
  begin_trial(Purpose::kTry);
  for (std::size_t k = 0; k < part.size() && operations_ <= most; ++k) remove(part[k]);
  return operations_ <= most;
}

void EliminationTrials::replace(Order& order, const Order& by, std::size_t first) {
  const std::size_t end = first + by.size();
  window_end_ = static_cast<std::uint32_t>(end - 1);
  begin_trial(Purpose::kForget);
  for (std::size_t k = first; k < end; ++k) remove(order[k]);
  std::copy(by.begin(), by.end(), order.begin() + static_cast<std::ptrdiff_t>(first));
  begin_trial(Purpose::kRecord);
  for (std::size_t k = first; k < end; ++k) {
    position_ = static_cast<std::uint32_t>(k);
    remove(order[k]);
  }
}

EliminationTrials::Order EliminationTrials::improved(Order order, const Effort& effort) {
  constexpr double kSaving = 0.003;  // of the operations
  if (order.size() < 2) return order;
  Order best = order;
  Draws draws;
  work_ = 0;
  for (std::vector<std::size_t> fewest{operations(order)}; work_ < effort.work;) {
    sweep(order = regrouped(order, draws), draws, effort.work);
    const std::size_t count = operations(order);
    if (count < fewest.back()) best = order;
    fewest.push_back(std::min(count, fewest.back()));
    if (fewest.size() <= effort.patience) continue;
    const auto before = static_cast<double>(fewest[fewest.size() - 1 - effort.patience]);
    if (static_cast<double>(fewest.back()) >= (1 - kSaving) * before) break;
  }
  return best;
}

/// What a step changes is read by those of its vertex' neighbours alone, and to what other steps compute it matters
/// only which term a sum takes first. So each step may wait until just before the first of those: then few others are
/// in between, where moves are tried.
EliminationTrials::Order EliminationTrials::regrouped(const Order& order, Draws& draws) {
  const std::size_t n = order.size();
  const std::vector<std::size_t> position = positions(order);
  std::vector<std::vector<std::size_t>> earlier(n);  // neighbours that leave before
  std::vector<std::size_t> later(n, 0);              // how many leave after it
  start({});
  begin_trial(Purpose::kTry);
  for (std::size_t k = 0; k < n; ++k) {
    for (const std::uint32_t v : neighbours(order[k])) {
      earlier[position[v]].push_back(k);
      ++later[k];
    }
    remove(order[k]);
  }
  std::vector<std::size_t> ready;  // all that leave after them are placed
  for (std::size_t k = 0; k < n; ++k)
    if (later[k] == 0) ready.push_back(k);
  Order result;
  while (!ready.empty()) {
    const std::size_t k = ready.back();
    ready.pop_back();
    result.push_back(order[k]);
    draws.shuffle(earlier[k]);
    for (const std::size_t e : earlier[k])
      if (--later[e] == 0) ready.push_back(e);
  }
  std::reverse(result.begin(), result.end());
  return result;
}

void EliminationTrials::sweep(Order& order, Draws& draws, std::size_t work) {
  // Most moves of links change nothing: where there are many vertices, one of so many links is moved.
  constexpr std::size_t kTrials = 2, kMany = 500, kLinks = 8;
  const bool is_large = order.size() > kMany;
  std::vector<std::size_t> position = positions(order);
  start(order);
  for (std::size_t first = 0; first + 1 < order.size() && work_ < work; ++first) {
    for (std::size_t trial = 0; trial < kTrials; ++trial) {
      begin_trial(Purpose::kTry);
      const std::vector<std::uint32_t> near = neighbours(order[first]);
      if (near.empty() || (is_large && is_link(order[first]) && draws.below(kLinks) > 0)) break;
      std::size_t last = position[near[draws.below(near.size())]];
      if (draws.below(3) == 0)
        for (const std::uint32_t v : near) last = std::min(last, position[v]);
      const auto at = [](auto& list, std::size_t k) { return list.begin() + static_cast<std::ptrdiff_t>(k); };
      Order part(at(order, first), at(order, last + 1));
      std::rotate(part.begin(), draws.below(2) == 0 ? part.begin() + 1 : part.end() - 1, part.end());
      const auto most = std::accumulate(at(ending_, first), at(ending_, last + 1), std::size_t{0});
      if (!takes_at_most(most, part, last)) continue;
      replace(order, part, first);
      for (std::size_t k = first; k <= last; ++k) position[order[k]] = k;
    }
    begin_trial(Purpose::kKeep);
    remove(order[first]);
    keep_changes();
  }
}

/// By vertex, where it leaves; what edges join is in the order.
std::vector<std::size_t> EliminationTrials::positions(const Order& order) const {
  std::vector<std::size_t> result(inner_);
  for (std::size_t k = 0; k < order.size(); ++k) result[order[k]] = k;
  return result;
}

/// Inner vertices that an edge joins with one.
std::vector<std::uint32_t> EliminationTrials::neighbours(std::uint32_t vertex) const {
  std::vector<std::uint32_t> list = users_of(vertex);
  for (const Edge& edge : now_.operands[vertex]) list.push_back(edge.operand);
  std::erase_if(list, [this](std::uint32_t v) { return v >= inner_; });
  return list;
}

}  // namespace jourdain::ir
