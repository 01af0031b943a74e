#include "commands/ensemble_setup.hpp"

#include <fmt/format.h>

#include <set>

#include "commands/build_model.hpp"
#include "commands/tool.hpp"
#include "emit/file_text.hpp"

namespace jourdain::commands {

namespace {

/// Columns without two of one name.
class ColumnList {
 public:
  void add(const std::string& name, const std::string& unit, bool is_drawn) {
    const std::string longer = name + (is_drawn ? "_drawn" : "_at_end");
    std::string free = name;
    for (int i = 1; !taken_.insert(free).second; ++i)
      free = i == 1 ? longer : fmt::format("{}_{}", longer, i);
    columns_.push_back({free, unit, is_drawn});
  }
  const std::vector<EnsembleColumn>& columns() const { return columns_; }

 private:
  std::set<std::string> taken_ = {"state", "trusted"};
  std::vector<EnsembleColumn> columns_;
};

/// The first line of what the compiler says of its version.
std::string compiler_version() {
  std::vector<std::string> command = machine_compiler();
  command.emplace_back("--version");
  const std::string text = run_tool(command);
  return support::shown(text.substr(0, text.find('\n')));
}

}  // namespace

std::vector<EnsembleColumn> columns_of(const RunModel& model, const Signals& signals,
                                       const std::vector<Spread>& spreads) {
  ColumnList list;
  for (const Spread& spread : spreads) {
    if (spread.of == Spread::Of::kParameter) {
      list.add(spread.name, model.loaded.mechanism.parameters[spread.entry].unit, true);
      continue;
    }
    for (const Signal& signal : signals.list())
      if (signal.name == spread.name)
        list.add(spread.of == Spread::Of::kInput ? spread.name : spread.name + "_at_start", signal.unit,
                 true);
  }
  for (const Signal& signal : signals.list())
    if (signal.kind != "energy" && signal.kind != "input") list.add(signal.name, signal.unit, false);
  return list.columns();
}

EnsembleFacts facts_of(const RunModel& model, const CompiledModel& compiled, const EnsembleChoices& choices,
                       const std::vector<std::string>& words) {
  const CompileOptions& options = model.loaded.options;
  EnsembleFacts facts;
  facts.generator = fmt::format("Jourdain {}", emit::kVersion);
  facts.compiler = compiler_version();
  facts.model = options.name;
  facts.source = support::shown(options.path);
  facts.source_sha256 = options.sha256;
  facts.method = choices.method + (choices.turns_sines ? " with turned sines" : "");
  facts.real = choices.real;
  facts.seed = choices.seed;
  for (std::size_t i = 0; i < model.parameters.size(); ++i)
    facts.parameters.emplace_back(model.loaded.mechanism.parameters[i].name, model.parameters[i]);
  for (std::size_t i = 0; i < choices.inputs.size(); ++i)
    facts.inputs.emplace_back(compiled.facts.inputs[i], choices.inputs[i]);
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    facts.spreads.emplace_back(word.substr(0, equals), word.substr(equals + 1));
  }
  return facts;
}

}  // namespace jourdain::commands
