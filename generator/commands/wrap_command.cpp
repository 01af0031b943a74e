// Emitted C for a tool with an interface of its own.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include <memory>

#include "commands/commands.hpp"
#include "commands/emission.hpp"
#include "commands/method_names.hpp"
#include "commands/output_guard.hpp"
#include "commands/report_text.hpp"
#include "commands/wrapper.hpp"
#include "support/files.hpp"

namespace jourdain::commands {

namespace {

struct WrapArguments {
  std::string tool;
  ModelArguments model;
  std::string folder;
  std::string method = "rk4";
  bool libm = false;
};

int refuse_arguments(const std::string& why) {
  fmt::print(stderr, "error: {}\n", why);
  return kUsage;
}

int run(const WrapArguments& arguments, bool has_method) {
  const Wrapper& wrapper = *find_wrapper(arguments.tool);
  if (has_method && !wrapper.steps)
    return refuse_arguments(
        fmt::format("--method is of tools that step, and {} is given rates", wrapper.tool));
  std::optional<LoadedMechanism> loaded = load(arguments.model);
  if (!loaded) return kModelWrong;
  const programs::SceneFacts facts = programs::scene_facts(loaded->mechanism, loaded->plan());
  if (const std::string why = wrapper.refusal(facts); !why.empty())
    return refuse_arguments(fmt::format("{} is not given rates {}", wrapper.tool, why));
  if (loaded->options.name == wrapper.header)
    return refuse_arguments(fmt::format("{0}.h is the header of {1}: choose another name with --name",
                                        wrapper.header, wrapper.tool));
  EmissionArguments emission;
  emission.functions = wrapper.functions;
  if (wrapper.steps) emission.functions.push_back(arguments.method + "_step");
  emission.language = "c";
  emission.real = "double";
  emission.interface = true;
  emission.libm = arguments.libm;
  if (const std::string wrong = emission.apply(*loaded); !wrong.empty()) return refuse_arguments(wrong);
  const CompiledModel compiled = compile(loaded->mechanism, loaded->options);
  if (!compiled.verdict.accepted()) return refuse(*loaded, compiled.verdict);
  std::vector<support::FileText> files(compiled.files.begin(), compiled.files.end());
  files.push_back(
      {fmt::format("{}_{}.c", loaded->options.name, wrapper.suffix),
       wrapper.text(loaded->options, compiled, loaded->mechanism.name, arguments.method + "_step")});
  if (!are_outputs_apart(paths_in(arguments.folder, files), loaded->sources)) return kUsage;
  support::write_files(arguments.folder, files);
  fmt::print("{}: {}\n", loaded->options.name, freedom_text(*loaded));
  for (const support::FileText& file : files) fmt::print("  wrote {}/{}\n", arguments.folder, file.name);
  fmt::print("{}{}", verdict_text(compiled.verdict), readback_text(compiled.readback));
  return kSuccess;
}

}  // namespace

void add_wrap(CLI::App& app, int& status) {
  auto arguments = std::make_shared<WrapArguments>();
  CLI::App* command =
      app.add_subcommand("wrap", "emit C for another tool: jourdain wrap arm.toml --for casadi -o arm");
  arguments->model.add_to(*command);
  command->add_option("--for", arguments->tool, "the tool: casadi (and acados), or simulink")
      ->required()
      ->check(CLI::IsMember(wrapped_tools()));
  command->add_option("-o,--output", arguments->folder, "folder to write into")->required();
  const CLI::Option* method = command->add_option("--method", arguments->method, "simulink: stepper")
                                  ->check(check_method)
                                  ->capture_default_str();
  command->add_flag("--libm", arguments->libm, kLibmHelp);
  command->callback([arguments, method, &status] { status = run(*arguments, method->count() > 0); });
}

}  // namespace jourdain::commands
