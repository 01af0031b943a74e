#include "commands/ensemble_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "commands/build_model.hpp"
#include "commands/content_hash.hpp"
#include "commands/tool.hpp"
#include "emit/templates.hpp"
#include "reference/minimal.hpp"
#include "support/check.hpp"
#include "support/files.hpp"

namespace jourdain::commands {

bool starts_follow(const RunModel& model, const std::vector<Spread>& spreads) {
  const auto start_at = [&model](const std::vector<double>& parameters) {
    return reference::Reference<double>(model.loaded.mechanism, parameters).initial_state();
  };
  const auto usual = start_at(model.parameters);
  return std::any_of(spreads.begin(), spreads.end(), [&](const Spread& spread) {
    if (spread.of != Spread::Of::kParameter) return false;
    std::vector<double> drawn = model.parameters;
    drawn[spread.entry] += spread.width;
    const auto start = start_at(drawn);
    return start.y != usual.y || start.z != usual.z;
  });
}

namespace {

std::string real_of(double value) { return fmt::format("Real({})", fmt::format("{:#}", value)); }

/// "start.drawn[0] = jourdain::normal_about(1, 0.05, seed, k, 0);", and what takes it.
std::string drawing(const Spread& spread, std::size_t number, const std::string& base,
                    const std::string& target) {
  return fmt::format(
      "  start.drawn[{0}] = jourdain::{1}_about({2}, {3:#}, seed, k, {0});\n  {4} = "
      "Real(start.drawn[{0}]);\n",
      number, spread.is_normal ? "normal" : "uniform", base, spread.width, target);
}

/// Where states start at the settings; empty where `initial_state` knows it.
std::string start_text(const RunModel& model, const programs::SceneFacts& facts,
                       const std::vector<Spread>& spreads) {
  const std::vector<double>& start = model.start.x;
  if (start.empty() || starts_follow(model, spreads)) return "";
  std::string text;
  const std::size_t positions = facts.positions.size();
  for (std::size_t i = 0; i < start.size(); ++i)
    text += i < positions ? fmt::format("  start.state.y[{}] = {};\n", i, real_of(start[i]))
                          : fmt::format("  start.state.z[{}] = {};\n", i - positions, real_of(start[i]));
  return text;
}

struct Drawing {
  std::string parameters, state;  ///< before and after there is a start
};

Drawing drawing_of(const RunModel& model, const CompiledModel& compiled, const std::vector<Spread>& spreads,
                   const std::vector<double>& inputs) {
  const programs::SceneFacts& facts = compiled.facts;
  Drawing text{"", start_text(model, facts, spreads)};
  for (std::size_t i = 0; i < facts.parameters.size(); ++i)
    text.parameters +=
        fmt::format("  start.parameters.{} = {};\n", facts.parameters[i].name, real_of(model.parameters[i]));
  for (std::size_t i = 0; i < inputs.size(); ++i)
    text.state += fmt::format("  start.input.u[{}] = {};\n", i, real_of(inputs[i]));
  for (std::size_t i = 0; i < spreads.size(); ++i) {
    const Spread& spread = spreads[i];
    const std::string base = fmt::format("{:#}", spread.base);
    const auto about_start = [&](const char* array) {
      const std::string entry = fmt::format("start.state.{}[{}]", array, spread.entry);
      text.state += drawing(spread, i, fmt::format("static_cast<double>({})", entry), entry);
    };
    switch (spread.of) {
      case Spread::Of::kParameter:
        text.parameters +=
            drawing(spread, i, base, fmt::format("start.parameters.{}", facts.parameters[spread.entry].name));
        break;
      case Spread::Of::kInput:
        text.state += drawing(spread, i, base, fmt::format("start.input.u[{}]", spread.entry));
        break;
      case Spread::Of::kPosition:
        about_start("y");
        break;
      case Spread::Of::kVelocity:
        about_start("z");
        break;
    }
  }
  if (const char* correction = programs::correction(facts); *correction)
    text.state += fmt::format(
        "  for (int i = 0; i < 20 && (i < {} || !model.loops_closed(start.state)); ++i)\n"
        "    ::{}::{}(model, start.state);  // from as far as no step leads\n",
        facts.closings, model.loaded.options.name, correction);
  return text;
}

/// What writes the end of a state, and how many numbers that are.
std::string writing(const std::string& name, const programs::SceneFacts& facts, std::size_t& numbers) {
  std::string text;
  const auto array = [&](const char* member, std::size_t count) {
    numbers += count;
    if (count > 0) text += fmt::format("    if (!write(state.{}, {}, file)) return false;\n", member, count);
  };
  array("y", facts.positions.size());
  array("z", facts.velocities.size());
  if (const std::size_t count = facts.output_numbers(); count > 0) {
    numbers += count;
    text += fmt::format(
        "    Many::Model::Outputs outputs;  // numbers only, one after the other\n"
        "    ::{}::outputs(Many::Model(start.parameters), state, start.input, outputs);\n"
        "    if (!write(reinterpret_cast<const Real*>(&outputs), output_count, file)) return false;\n",
        name);
  }
  return text;
}

}  // namespace

EnsembleProgram::EnsembleProgram(const RunModel& model, const CompiledModel& compiled,
                                 const std::vector<Spread>& spreads, const EnsembleChoices& choices)
    : choices_(choices), numbers_(spreads.size() + 1) {
  const std::string& name = model.loaded.options.name;
  const Drawing drawing = drawing_of(model, compiled, spreads, choices.inputs);
  const std::string write = writing(name, compiled.facts, numbers_);
  const bool own = !model.parameters.empty();
  std::vector<support::FileText> sources;
  for (const emit::File& file : compiled.files) sources.push_back({file.name, file.text});
  for (const char* header : {"ensemble.hpp", "stepping.hpp", "pack.hpp", "turned_sines.hpp", "draws.hpp"})
    sources.push_back({header, std::string(emit::template_text(header))});
  sources.push_back(
      {"main.cpp", emit::fill(emit::template_text("ensemble.cpp.in"),
                              {{"NAME", name},
                               {"REAL", choices.real},
                               {"METHOD", choices.method},
                               {"SINES", choices.turns_sines ? "TurnedSines" : "ComputedSines"},
                               {"DRAWN_COUNT", fmt::format("{}", spreads.size())},
                               {"OUTPUT_COUNT", fmt::format("{}", compiled.facts.output_numbers())},
                               {"PARAMETERS", drawing.parameters},
                               {"STATE", drawing.state},
                               {"OWN_PARAMETERS",
                                own ? "    ensemble.set_parameters(k - begin, start.parameters);\n" : ""},
                               {"WRITE", write}})});
  std::string all;
  for (const support::FileText& source : sources) {
    support::write_file(folder_.path() + "/" + source.name, source.text);
    all += source.text;
  }
  sha256_ = sha256_of(all);
  std::vector<std::string> command = machine_compiler();
  for (const char* word :
       {"-std=c++17", "-O2", "-march=native", "-ffp-contract=off", "-fno-math-errno", "-pthread", "-w", "-o"})
    command.emplace_back(word);
  command.push_back(folder_.path() + "/ensemble");
  command.push_back(folder_.path() + "/main.cpp");
  run_tool(command);
}

EnsembleRows EnsembleProgram::run(std::uint64_t begin, std::uint64_t end, std::uint64_t steps,
                                  double h) const {
  const std::string file = folder_.path() + "/rows";
  run_tool({folder_.path() + "/ensemble", file, fmt::format("{}", choices_.seed), fmt::format("{}", begin),
            fmt::format("{}", end), fmt::format("{}", steps), fmt::format("{}", h),
            fmt::format("{}", choices_.threads)});
  std::ifstream in(file, std::ios::binary);
  EnsembleRows rows{std::vector<std::vector<double>>(numbers_ - 1), {}};
  for (std::vector<double>& column : rows.columns) column.reserve(end - begin);
  std::vector<double> row(numbers_);
  for (std::uint64_t k = begin; k < end; ++k) {
    in.read(reinterpret_cast<char*>(row.data()), static_cast<std::streamsize>(row.size() * sizeof(double)));
    JD_CHECK(in.good(), "state {} of {} to {} is missing", k, begin, end);
    const bool is_finite = std::all_of(row.begin(), row.end(), [](double x) { return std::isfinite(x); });
    for (std::size_t i = 0; i + 1 < row.size(); ++i)
      rows.columns[i].push_back(std::isnan(row[i]) ? std::numeric_limits<double>::quiet_NaN() : row[i]);
    rows.trusted.push_back(is_finite && row.back() == 1 ? 1 : 0);
  }
  return rows;
}

}  // namespace jourdain::commands
