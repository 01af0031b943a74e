#include "commands/spreads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "jourdain/draws.hpp"

namespace jourdain::commands {

namespace {

constexpr const char* kForm =
    "NAME=normal(DEVIATION) or NAME=uniform(HALF) is expected, as in mass=normal(5%)";

/// What a name may mean.
struct Meaning {
  std::string name;
  Spread::Of of;
  std::size_t entry;
  double base;
};

std::vector<Meaning> meanings_of(const RunModel& model, const Signals& signals,
                                 const std::vector<double>& inputs) {
  std::vector<Meaning> meanings;
  const std::vector<model::Parameter>& parameters = model.loaded.mechanism.parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    meanings.push_back({parameters[i].name, Spread::Of::kParameter, i, model.parameters[i]});
  std::size_t positions = 0, velocities = 0, input = 0;
  for (const Signal& signal : signals.list()) {
    if (signal.kind == "position") meanings.push_back({signal.name, Spread::Of::kPosition, positions++, 0});
    if (signal.kind == "velocity" || signal.kind == "state")
      meanings.push_back({signal.name, Spread::Of::kVelocity, velocities++, 0});
    if (signal.kind == "input") {
      meanings.push_back({signal.name, Spread::Of::kInput, input, inputs[input]});
      ++input;
    }
  }
  return meanings;
}

/// Why the entry of y cannot be drawn by itself; empty: it can.
std::string bound_position(const programs::SceneFacts& facts, std::size_t entry) {
  for (const model::Tangent::Scalar& quaternion : facts.tangent.quaternions)
    if (entry >= quaternion.position && entry < quaternion.position + 4)
      return "it is an entry of a quaternion, of length one; spread its angular velocities, or parameters of "
             "the start";
  if (std::find(facts.dependents.begin(), facts.dependents.end(), entry) != facts.dependents.end())
    return "it follows from others, which close the loops";
  return "";
}

struct Width {
  double value = 0;
  bool is_share = false;
};

/// Of "0.1)" or "5%)".
std::optional<Width> read_width(const std::string& text) {
  Width width;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), width.value);
  if (error != std::errc() || !std::isfinite(width.value) || !(width.value > 0)) return {};
  const std::string after(rest, text.data() + text.size());
  width.is_share = after == "%)";
  if (width.is_share) width.value /= 100;
  return width.is_share || after == ")" ? std::optional<Width>(width) : std::nullopt;
}

std::string meaning_problem(const std::vector<Meaning>& all, const std::string& name) {
  const auto count = std::count_if(all.begin(), all.end(), [&](const Meaning& t) { return t.name == name; });
  if (count == 1) return "";
  if (count > 1) return fmt::format("a parameter and a column of the state are called '{}'", name);
  std::vector<std::string> names;
  for (const Meaning& meaning : all) names.push_back(meaning.name);
  const std::string near = support::nearest(name, names);
  return fmt::format("no parameter, position, velocity or input '{}'; {}", name,
                     near.empty() ? fmt::format("there are {}", fmt::join(names, ", "))
                                  : fmt::format("did you mean '{}'?", near));
}

/// Reads one; what is wrong goes to `problem`.
std::optional<Spread> read_spread(const std::string& word, const std::vector<Meaning>& meanings,
                                  const programs::SceneFacts& facts, std::string& problem) {
  const std::size_t equals = word.find('='), open = word.find('(', equals == std::string::npos ? 0 : equals);
  problem = kForm;
  if (equals == std::string::npos || open == std::string::npos) return {};
  const std::string kind = word.substr(equals + 1, open - equals - 1);
  const std::optional<Width> width = read_width(word.substr(open + 1));
  if ((kind != "normal" && kind != "uniform") || !width) return {};
  const std::string name = word.substr(0, equals);
  problem = meaning_problem(meanings, name);
  if (!problem.empty()) return {};
  const Meaning& meaning =
      *std::find_if(meanings.begin(), meanings.end(), [&](const Meaning& t) { return t.name == name; });
  if (meaning.of == Spread::Of::kPosition) problem = bound_position(facts, meaning.entry);
  if (width->is_share && meaning.base == 0)
    problem = meaning.of == Spread::Of::kParameter || meaning.of == Spread::Of::kInput
                  ? "its value is zero, and so is a share of it"
                  : "a share is of a parameter or an input; give the width in SI units";
  if (!problem.empty()) return {};
  return Spread{name,
                meaning.of,
                meaning.entry,
                kind == "normal",
                width->is_share ? width->value * std::fabs(meaning.base) : width->value,
                meaning.base};
}

}  // namespace

double Spread::value(std::uint64_t seed, std::uint64_t k, std::size_t number) const {
  return is_normal ? normal_about(base, width, seed, k, number) : uniform_about(base, width, seed, k, number);
}

std::optional<std::vector<Spread>> read_spreads(const std::vector<std::string>& words, const RunModel& model,
                                                const CompiledModel& compiled, const Signals& signals,
                                                const std::vector<double>& inputs) {
  const std::vector<Meaning> meanings = meanings_of(model, signals, inputs);
  std::vector<Spread> spreads;
  for (const std::string& word : words) {
    std::string problem;
    const std::optional<Spread> spread = read_spread(word, meanings, compiled.facts, problem);
    if (spread &&
        std::any_of(spreads.begin(), spreads.end(), [&](const Spread& s) { return s.name == spread->name; }))
      problem = "it is spread twice";
    if (!problem.empty()) {
      fmt::print(stderr, "error: --spread {}: {}\n", word, problem);
      return {};
    }
    spreads.push_back(*spread);
  }
  return spreads;
}

}  // namespace jourdain::commands
