// The command line: parses arguments, runs a command, and maps what went wrong to an exit status.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include "commands/commands.hpp"
#include "commands/load.hpp"

int main(int argc, char** argv) {
  using namespace jourdain;
  CLI::App app("Jourdain compiles the description of a multibody mechanism to C++ that computes its motion.", "jourdain");
  app.set_version_flag("--version", fmt::format("jourdain {}", emit::kVersion));
  app.require_subcommand(1);
  int status = commands::kSuccess;
  commands::add_all(app, status);
  try {
    app.parse(argc, argv);
    return status;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? commands::kSuccess : commands::kUsage;
  } catch (const support::EnvironmentError& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return commands::kEnvironment;
  } catch (const std::exception& error) {
    fmt::print(stderr, "internal error: {}\nPlease report this with the model that shows it.\n", error.what());
    return commands::kInternal;
  }
}
