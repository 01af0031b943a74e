// [[memory]]
#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "model/expression_functions.hpp"
#include "model/expression_sums.hpp"
#include "model/read/keys.hpp"
#include "model/read/toml_frame.hpp"
#include "model/read/toml_sections.hpp"
#include "model/read/toml_state.hpp"

namespace jourdain::model {

namespace {

using support::shown;

constexpr std::int64_t kMostSamples = 64;  ///< that a memory may lag

Expression state(std::size_t index) { return Expression::variable({Variable::Kind::kState, index}); }

Expression step_length() { return Expression::variable({Variable::Kind::kStepLength}); }

/// The step begins nearer to the time of a sample than any other: less than half of it is left.
Expression where_due(std::size_t timer, const Expression& due, const Expression& otherwise) {
  return where_less(state(timer), times(0.5, step_length()), false, due, otherwise);
}

/// A step later; a period more at a sample. Where steps are longer than periods each is a sample, and none is owed.
Expression counted_down(std::size_t timer, const Expression& period) {
  const Expression next = minus(plus(state(timer), period), step_length());
  return where_due(timer, Expression::function(support::Function::kMax, next, times(-0.5, step_length())),
                   minus(state(timer), step_length()));
}

/// Operation by operation.
bool are_same(const Expression& a, const Expression& b) {
  const auto key = [](const Expression::Node& n) {
    return std::tuple(n.op, n.value, n.parameter.value, n.exponent, n.function, n.left, n.right);
  };
  return std::ranges::equal(a.nodes(), b.nodes(), {}, key, key);
}

std::size_t read_delay(const TomlTable& table) {
  const toml::node* node = table.find("delay");
  if (!node) return 0;
  const auto* number = node->as_integer();
  if (number && number->get() >= 0 && number->get() <= kMostSamples)
    return static_cast<std::size_t>(number->get());
  table.error("delay", fmt::format("{} must be a number of samples, an integer from 0 to {}",
                                   table.quoted("delay"), kMostSamples));
  return 0;
}

}  // namespace

Memories::Memories(TomlFile& file, const TomlTables& section, Mechanism& mechanism)
    : file_(file), section_(section), mechanism_(mechanism) {
  for (const toml::node& node : section) {
    const TomlTable table(file, *node.as_table(),
                          fmt::format("memory '{}'", shown(file.text_or(*node.as_table(), "name"))),
                          file.range(node.source()), keys_of("memory"));
    memories_.push_back(declared(table).value_or(Memory{table}));
  }
}

std::optional<Memories::Memory> Memories::declared(const TomlTable& table) {
  std::optional<StateVariable> memory = read_state_variable(file_, table, "memory", mechanism_);
  if (!table.has("update"))
    table.missing("update", "an expression of t, coordinates, inputs, frames, states and memories");
  if (!table.has("period")) table.missing("period", "s; 0: a sample at every step");
  const Expression period = table.not_negative("period", needed::kTime);
  Memory read{table, {}, read_delay(table)};
  if (!memory) return {};
  const std::string name = memory->name;
  const std::size_t first = mechanism_.states.size();
  for (std::size_t k = 1; k <= read.lag; ++k) {
    StateVariable earlier = *memory;
    earlier.name = fmt::format("{}_{}", name, k);
    earlier.description = fmt::format("{} of {} samples later", name, read.lag + 1 - k);
    if (!add(table, "memory", earlier)) return {};
  }
  if (!add(table, "memory", *memory)) return {};
  read.first = first;
  if (period.is_zero()) return read;
  read.timer = timer_of(table, name, period);
  return read.timer ? std::optional(read) : std::nullopt;
}

bool Memories::add(const TomlTable& table, const char* what, StateVariable state) {
  if (!check_signal_name(file_, table, what, state.name, mechanism_)) return false;
  mechanism_.states.push_back(std::move(state));
  return true;
}

std::optional<std::size_t> Memories::timer_of(const TomlTable& table, const std::string& name,
                                              const Expression& period) {
  for (const Timer& timer : timers_)
    if (are_same(timer.period, period)) return timer.state;
  const std::size_t index = mechanism_.states.size();
  StateVariable timer;
  timer.name = name + "_timer";
  timer.where = table.where("name");
  timer.unit = "s";
  timer.nominal = period;
  timer.period = period;
  timer.description = "time to the next sample";
  timer.sampled = counted_down(index, period);
  if (!add(table, "timer", timer)) return {};
  timers_.push_back({index, period});
  return index;
}

void Memories::read_updates(const Scope& scope) {
  auto item = memories_.begin();
  for ([[maybe_unused]] const toml::node& node : section_) {  // with the index of its repetition
    const auto& [table, first, lag, timer] = *item++;
    if (!first) continue;
    const Expression update =
        settled(table.function("update", {{mechanism_.states[*first].unit}}, scope), mechanism_);
    for (std::size_t k = 0; k <= lag; ++k) {
      const std::size_t index = *first + k;
      const Expression next = k == 0 ? update : state(index - 1);
      mechanism_.states[index].sampled = timer ? where_due(*timer, next, state(index)) : next;
    }
  }
}

}  // namespace jourdain::model
