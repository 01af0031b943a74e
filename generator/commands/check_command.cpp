#include <fmt/format.h>

#include <CLI/App.hpp>

#include <memory>

#include "commands/commands.hpp"
#include "commands/load.hpp"
#include "loops/plan/plan_text.hpp"

namespace jourdain::commands {

namespace {

int run(const ModelArguments& arguments) {
  const std::optional<LoadedMechanism> loaded = load(arguments);
  if (!loaded) return kModelWrong;
  const CompiledModel compiled = compile(loaded->mechanism, loaded->options);
  if (!compiled.verdict.accepted()) return refuse(*loaded, compiled.verdict);
  fmt::print("ok: {}: {} bodies, {}, {} inputs; backward error {:.1e}, cond(M) up to {}\n",
             loaded->options.name, loaded->mechanism.bodies.size(), freedom_text(*loaded),
             compiled.facts.inputs.size(), compiled.verdict.backward_error,
             validate::condition_text(compiled.verdict));
  if (const loops::LoopPlan* plan = loaded->plan())
    for (const std::string& sentence : loops::sentences(loaded->mechanism, *plan))
      fmt::print("  loops: {}\n", sentence);
  return kSuccess;
}

}  // namespace

void add_check(CLI::App& app, int& status) {
  auto arguments = std::make_shared<ModelArguments>();
  CLI::App* command =
      app.add_subcommand("check", "read, derive and validate; write nothing: jourdain check arm.toml");
  arguments->add_to(*command);
  command->callback([arguments, &status] { status = run(*arguments); });
}

}  // namespace jourdain::commands
