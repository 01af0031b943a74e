#include <fmt/format.h>

#include <CLI/App.hpp>

#include <memory>

#include "commands/commands.hpp"
#include "commands/equation_text.hpp"
#include "commands/load.hpp"

namespace jourdain::commands {

namespace {

struct EquationsArguments {
  ModelArguments model;
  bool latex = false;
};

int run(const EquationsArguments& arguments) {
  const std::optional<LoadedMechanism> loaded = load(arguments.model);
  if (!loaded) return kModelWrong;
  fmt::print("{}", equations_text(loaded->mechanism, arguments.latex));
  return kSuccess;
}

}  // namespace

void add_equations(CLI::App& app, int& status) {
  auto arguments = std::make_shared<EquationsArguments>();
  CLI::App* command = app.add_subcommand(
      "equations", "print M, k_bar and q_bar of M zdot = k_bar - q_bar: jourdain equations arm.toml --latex");
  arguments->model.add_to(*command);
  command->add_flag("--latex", arguments->latex, "LaTeX instead of text");
  command->callback([arguments, &status] { status = run(*arguments); });
}

}  // namespace jourdain::commands
