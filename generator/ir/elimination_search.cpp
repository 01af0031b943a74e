#include "ir/elimination_search.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "ir/scramble.hpp"

namespace jourdain::ir {

namespace {

bool is_unit(Residue value) { return value == Residue(1) || value == -Residue(1); }

/// Draws that are the same in every run.
class Draws {
 public:
  std::size_t below(std::size_t bound) { return scrambled(kSeed, ++drawn_) % bound; }

 private:
  static constexpr std::uint64_t kSeed = 0x656c696d696e6174u;
  std::uint64_t drawn_ = 0;
};

/// No edges lead to vertices from which no row is reached.
void drop_dead_ends(std::vector<std::vector<EliminationTrials::Edge>>& operands, std::size_t inner) {
  std::vector<bool> is_alive(operands.size(), false);
  for (std::size_t v = operands.size(); v-- > 0;) {
    if (v < inner && !is_alive[v]) operands[v].clear();
    for (const EliminationTrials::Edge& edge : operands[v]) is_alive[edge.operand] = true;
  }
}

}  // namespace

EliminationTrials::EliminationTrials(std::vector<std::vector<Edge>> operands, std::size_t inner,
                                     const std::vector<Residue>& known)
    : inner_(inner), operands_trial_(operands.size()), users_trial_(operands.size()), slots_(1024) {
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
  for (Slot& slot : slots_) slot.last = kNowhere;
  ending_.assign(order.size(), 0);
  sweep_ = trial_ + 1;
  trial_ = sweep_ + 1;
  window_end_ = kNowhere;
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
    return slot.stamp == kKnown || slot.stamp == sweep_ || slot.stamp == trial_ || slot.last != kNowhere;
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
    slots_[k] = {value, kUnknown, kNowhere};
  }
  return slots_[k];
}

void EliminationTrials::forget_last(Slot& slot) {
  if (slot.last == kNowhere) return;
  --ending_[slot.last];
  slot.last = kNowhere;
}

void EliminationTrials::compute(Residue value) {
  if (value.is_zero() || is_unit(value)) return;
  if (2 * used_ > slots_.size()) make_room();
  Slot& slot = slot_of(value.is_negative() ? (-value).value() : value.value());
  if (slot.stamp == kKnown || slot.stamp == sweep_) return;
  const bool is_later = slot.last != kNowhere && slot.last > window_end_;
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

void EliminationTrials::connect(const Edge& edge, std::uint32_t user) {
  std::vector<Edge>& edges = operands_to_change(user);
  for (Edge& known : edges)
    if (known.operand == edge.operand) {
      known.partial = known.partial + edge.partial;
      known.fixed = known.fixed && edge.fixed;
      if (!known.fixed) compute(known.partial);
      if (known.partial.is_zero()) {
        known = edges.back();
        edges.pop_back();
      }
      return;
    }
  edges.push_back(edge);
  users_to_change(edge.operand).push_back(user);
}

void EliminationTrials::remove(std::uint32_t vertex) {
  std::vector<std::uint32_t> users;
  users.swap(users_to_change(vertex));
  work_ += kRemoval;
  std::vector<Edge> operands;
  operands.swap(operands_to_change(vertex));
  for (const std::uint32_t user : users) {
    std::vector<Edge>& edges = operands_to_change(user);
    const auto edge =
        std::find_if(edges.begin(), edges.end(), [&](const Edge& e) { return e.operand == vertex; });
    if (edge == edges.end()) continue;
    const Edge outer = *edge;
    *edge = edges.back();
    edges.pop_back();
    work_ += operands.size();
    for (const Edge& inner : operands) {
      const Edge product{inner.operand, outer.partial * inner.partial, outer.fixed && inner.fixed};
      if (!product.fixed && !is_unit(outer.partial) && !is_unit(inner.partial)) compute(product.partial);
      connect(product, user);
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
  for (std::size_t before = kNowhere; before != order.size();) {
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
bool EliminationTrials::takes_at_most(std::size_t most, const Order& order, std::size_t first,
                                      std::size_t last) {
  window_end_ = last;
  begin_trial(Purpose::kTry);
  for (std::size_t k = first; k <= last && operations_ <= most; ++k) remove(order[k]);
  return operations_ <= most;
}

void EliminationTrials::replace(Order& order, const Order& by, std::size_t first, std::size_t last) {
  window_end_ = last;
  begin_trial(Purpose::kForget);
  for (std::size_t k = first; k <= last; ++k) remove(order[k]);
  order = by;
  begin_trial(Purpose::kRecord);
  for (position_ = first; position_ <= last; ++position_) remove(order[position_]);
}

EliminationTrials::Order EliminationTrials::improved(Order order, std::size_t work) {
  constexpr std::size_t kSweeps = 24, kTrials = 2;
  const std::size_t n = order.size();
  std::vector<std::size_t> position(inner_, kNowhere);
  Draws draws;
  work_ = 0;
  for (std::size_t sweep = 0; sweep < kSweeps && work_ < work && n > 1; ++sweep) {
    start(order);
    for (std::size_t k = 0; k < n; ++k) position[order[k]] = k;
    for (std::size_t first = 0; first + 1 < n && work_ < work; ++first) {
      for (std::size_t trial = 0; trial < kTrials; ++trial) {
        begin_trial(Purpose::kTry);
        const std::vector<std::uint32_t> near = neighbours(order[first]);
        if (near.empty()) break;
        const std::size_t last = position[near[draws.below(near.size())]];
        Order other = order;
        const auto at = [&](std::size_t k) { return other.begin() + static_cast<std::ptrdiff_t>(k); };
        std::rotate(at(first), draws.below(2) == 0 ? at(first + 1) : at(last), at(last + 1));
        const auto most =
            std::accumulate(ending_.begin() + static_cast<std::ptrdiff_t>(first),
                            ending_.begin() + static_cast<std::ptrdiff_t>(last + 1), std::size_t{0});
        if (!takes_at_most(most, other, first, last)) continue;
        replace(order, other, first, last);
        for (std::size_t k = first; k <= last; ++k) position[order[k]] = k;
      }
      begin_trial(Purpose::kKeep);
      remove(order[first]);
      keep_changes();
    }
  }
  return order;
}

/// Inner vertices that an edge joins with one.
std::vector<std::uint32_t> EliminationTrials::neighbours(std::uint32_t vertex) const {
  std::vector<std::uint32_t> list = users_of(vertex);
  for (const Edge& edge : now_.operands[vertex]) list.push_back(edge.operand);
  std::erase_if(list, [this](std::uint32_t v) { return v >= inner_; });
  return list;
}

}  // namespace jourdain::ir
