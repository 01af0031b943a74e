#include <fmt/format.h>

#include <memory>

#include "commands/commands.hpp"
#include "commands/load.hpp"

namespace jourdain::commands {

namespace {

int run(const ModelArguments& arguments) {
  const std::optional<LoadedMechanism> loaded = load(arguments);
  if (!loaded) return kModelWrong;
  const CompiledModel compiled = compile(loaded->mechanism, loaded->options);
  if (!compiled.verdict.accepted()) {
    print_refusal(compiled.verdict);
    return kInternal;
  }
  fmt::print(
      "ok: {}: {} bodies, {} degrees of freedom, {} inputs; backward error {:.1e}, cond(M) up to {:.1e}\n",
      loaded->options.name, loaded->mechanism.bodies.size(), compiled.shape.velocities, compiled.shape.inputs,
      compiled.verdict.backward_error, compiled.verdict.condition);
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
