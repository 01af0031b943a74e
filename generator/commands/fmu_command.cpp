// A model as a functional mock-up unit: one file that simulators load.
#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include <memory>

#include "commands/commands.hpp"
#include "commands/content_hash.hpp"
#include "commands/emission.hpp"
#include "commands/fmu_description.hpp"
#include "commands/fmu_files.hpp"
#include "commands/load.hpp"
#include "commands/method_names.hpp"
#include "commands/number_checks.hpp"
#include "commands/output_guard.hpp"
#include "commands/shared_library.hpp"
#include "support/files.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::commands {

namespace {

using support::FileText;

struct FmuArguments {
  ModelArguments model;
  std::string output;
  int fmi = 2;
  std::string method = "rk4";
  double step = 1e-3;
  std::string compiler, flags = "-O2";
  bool sources_only = false;

  FmiVersion version() const { return fmi == 2 ? FmiVersion::k2 : FmiVersion::k3; }
  std::vector<std::string> compiler_words() const {
    return compiler.empty() ? machine_c_compiler() : words_of(compiler);
  }
};

/// What is wrong with the choice; empty where nothing is.
std::string choose_functions(LoadedMechanism& loaded, const std::string& method) {
  EmissionArguments emission;
  emission.functions = {"position_rate", "forward_dynamics", "outputs",
                        "close_loops",   "project",          method + "_step"};
  const CompileOptions& options = loaded.options;
  if (has_fmu_derivatives(programs::scene_facts(loaded.mechanism, loaded.plan(), options.wishes())))
    emission.functions.emplace_back("linearize");
  emission.language = "c";
  emission.real = "double";
  emission.interface = true;
  return emission.apply(loaded);
}

/// As a GUID is written.
std::string token_of(const std::string& text) {
  const std::string hash = sha256_of(text);
  return fmt::format("{{{}-{}-{}-{}-{}}}", hash.substr(0, 8), hash.substr(8, 4), hash.substr(12, 4),
                     hash.substr(16, 4), hash.substr(20, 12));
}

/// All but the library: description, sources. The token follows from all of it.
std::vector<FileText> text_files(const FmuScene& scene, FmiVersion version,
                                 const std::vector<FileText>& model_files) {
  const auto with_token = [&](const std::string& token) {
    const std::vector<FileText> sources = fmu_sources(scene, version, token, model_files);
    const std::vector<std::string> compiled = compiled_sources(sources);
    std::vector<FileText> files = {
        {"modelDescription.xml", model_description(scene, version, token, compiled)}};
    for (const FileText& source : sources) files.push_back({"sources/" + source.name, source.text});
    if (version == FmiVersion::k3)
      files.push_back({"sources/buildDescription.xml", build_description(scene.name, compiled)});
    return files;
  };
  std::string all;
  for (const FileText& file : with_token("")) all += file.name + "\n" + file.text;
  return with_token(token_of(all));
}

/// The library as binaries/PLATFORM/NAME.so.
FileText library(const FmuScene& scene, const FmuArguments& arguments, const std::vector<FileText>& files) {
  const std::vector<std::string> compiler = arguments.compiler_words();
  const std::string platform = platform_of(compiler, arguments.version());
  const support::TemporaryFolder folder;
  const std::string prefix = "sources/";
  std::vector<FileText> sources;
  for (const FileText& file : files)
    if (file.name.starts_with(prefix)) sources.push_back({file.name.substr(prefix.size()), file.text});
  support::write_files(folder.path(), sources);
  std::vector<std::string> flags = words_of(arguments.flags);
  flags.emplace_back("-fvisibility=hidden");
  const std::string name = scene.name + ".so";
  build_shared_library(folder.path(), compiled_sources(sources), name, compiler, flags);
  return {fmt::format("binaries/{}/{}", platform, name), support::read_file(folder.path() + "/" + name)};
}

int run(const FmuArguments& arguments) {
  std::optional<LoadedMechanism> loaded = load(arguments.model);
  if (!loaded) return kModelWrong;
  const CompileOptions& options = loaded->options;
  if (has_samples(loaded->mechanism)) {
    fmt::print(stderr, "error: '{}' has memories; units with events, which samples are, are not written\n",
               options.name);
    return kUsage;
  }
  if (options.name == "fmi2" || options.name == "fmi3") {
    fmt::print(stderr, "error: {}.h is the header of the standard: choose another name with --name\n",
               options.name);
    return kUsage;
  }
  if (const std::string wrong = choose_functions(*loaded, arguments.method); !wrong.empty()) {
    fmt::print(stderr, "error: {}\n", wrong);
    return kUsage;
  }
  const std::string output = arguments.output.empty() ? options.name + ".fmu" : arguments.output;
  if (!are_outputs_apart({output}, loaded->sources)) return kUsage;
  const CompiledModel compiled = compile(loaded->mechanism, options);
  if (!compiled.verdict.accepted()) return refuse(*loaded, compiled.verdict);
  const FmuScene scene = fmu_scene(loaded->mechanism, options, compiled, arguments.method, arguments.step);
  std::vector<FileText> files = text_files(scene, arguments.version(), compiled.files);
  if (!arguments.sources_only) files.insert(files.begin() + 1, library(scene, arguments, files));
  support::write_file(output, zip_archive(files));
  fmt::print("{}: {}\n  wrote {}: FMI {}.0, {} continuous states, steps of {} s with {} in co-simulation\n",
             options.name, freedom_text(*loaded), output, arguments.fmi, state_references(scene).size(),
             scene.step, scene.method);
  return kSuccess;
}

}  // namespace

void add_fmu(CLI::App& app, int& status) {
  auto arguments = std::make_shared<FmuArguments>();
  CLI::App* command =
      app.add_subcommand("fmu", "write a unit for simulators (FMI): jourdain fmu arm.toml -o arm.fmu");
  arguments->model.add_to(*command);
  command->add_option("-o,--output", arguments->output, "file (default: NAME.fmu)");
  command->add_option("--fmi", arguments->fmi, "version of the standard: 2.0 or 3.0")
      ->check(CLI::IsMember({2, 3}))
      ->capture_default_str();
  command->add_option("--method", arguments->method, "stepper of co-simulation")
      ->check(check_method)
      ->capture_default_str();
  command->add_option("--step", arguments->step, "its internal step, s")
      ->check(positive_number())
      ->capture_default_str();
  command->add_option("--compiler", arguments->compiler,
                      "compiler of C, with options (default: the environment variable CC, else cc)");
  command->add_option("--flags", arguments->flags, "options of the compiler")->capture_default_str();
  command->add_flag("--sources-only", arguments->sources_only,
                    "no library: for importers that compile the sources, on any platform");
  command->callback([arguments, &status] { status = run(*arguments); });
}

}  // namespace jourdain::commands
