#include "commands/command_line.hpp"

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <sstream>
#include <string_view>

#include "commands/commands.hpp"
#include "commands/load.hpp"
#include "commands/printable.hpp"
#include "support/interruption.hpp"

namespace jourdain::commands {

namespace {

/// Says so when the first argument is no command; CLI11 would only say that one is missing.
bool is_unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return false;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), argv[1]) != names.end()) return false;
  const std::string near = support::nearest(argv[1], names);
  fmt::print(stderr, "error: no command '{}'; {}\n", support::shown(argv[1]),
             near.empty() ? fmt::format("there are {}", fmt::join(names, ", "))
                          : fmt::format("did you mean '{}'?", near));
  return true;
}

/// Of options that name a file or a folder an empty name is refused: without any, files would be left out in silence.
void refuse_empty_names(CLI::App& app) {
  const CLI::Validator not_empty(
      [](std::string& name) { return name.empty() ? std::string("the name is empty") : std::string(); }, "");
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    for (const char* name : {"--output", "--depfile", "--against", "--inputs", "--plot"})
      if (CLI::Option* option = command->get_option_no_throw(name);
          option && option->get_items_expected_max() == 1)  // `simulate --plot` takes names of signals, too
        option->check(not_empty);
}

/// The arguments after the program's name, in reverse as CLI11 takes them. Options that take several values would take
/// the model too: a second value that is a model file is moved to the front.
std::vector<std::string> reversed_arguments(int argc, char** argv) {
  const auto is_model = [](std::string_view text) {
    constexpr std::string_view kEndings[] = {".toml", ".urdf", ".sdf", ".world", ".mjcf", ".xml"};
    return std::any_of(std::begin(kEndings), std::end(kEndings),
                       [text](std::string_view ending) { return text.ends_with(ending); });
  };
  const auto is_option = [](std::string_view text) {
    return text.starts_with("-") && text.find_first_of("0123456789.") != 1;
  };
  std::vector<std::string> arguments(argv + 1, argv + argc);
  for (std::size_t i = 2; i < arguments.size(); ++i)
    if (is_model(arguments[i]) && !is_option(arguments[i - 1])) {
      std::rotate(arguments.begin() + 1, arguments.begin() + static_cast<std::ptrdiff_t>(i),
                  arguments.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      break;
    }
  std::reverse(arguments.begin(), arguments.end());
  return arguments;
}

/// Prints help, or what is wrong with the arguments, which may hold anything.
int explain(const CLI::App& app, const CLI::ParseError& error) {
  std::ostringstream help, wrong;
  const int status = app.exit(error, help, wrong) == 0 ? kSuccess : kUsage;
  fmt::print("{}", help.str());
  fmt::print(stderr, "{}", printable(wrong.str()));
  return status;
}

int run(int argc, char** argv) {
  CLI::App app("Jourdain compiles the description of a multibody mechanism to C++ that computes its motion.",
               "jourdain");
  app.set_version_flag("--version", fmt::format("jourdain {}", emit::kVersion));
  app.require_subcommand(1);
  support::handle_interruptions();
  int status = kSuccess;
  add_all(app, status);
  refuse_empty_names(app);
  if (is_unknown_command(app, argc, argv)) return kUsage;
  try {
    app.parse(reversed_arguments(argc, argv));
    return status;
  } catch (const CLI::ParseError& error) {
    return explain(app, error);
  }
}

/// What was printed so far is out; otherwise false after a message. Asking once at the end is enough: a stream that
/// failed says so.
bool is_output_written() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return true;
  std::fprintf(stderr, "error: standard output cannot be written%s%s\n", errno == 0 ? "" : ": ",
               errno == 0 ? "" : std::strerror(errno));
  std::clearerr(stdout);
  return false;
}

}  // namespace

int run_command_line(int argc, char** argv) noexcept {
  try {
    const int status = run(argc, argv);
    return is_output_written() || status != kSuccess ? status : kEnvironment;
  } catch (const support::EnvironmentError& error) {
    std::fprintf(stderr, "error: %s\n", printable(error.what()).c_str());
    return kEnvironment;
  } catch (const std::exception& error) {
    // Printing throws where a stream fails.
    if (std::ferror(stderr) != 0 || !is_output_written()) return kEnvironment;
    std::fprintf(stderr, "internal error: %s\nPlease report this with the model that shows it.\n",
                 error.what());
    return kInternal;
  }
}

}  // namespace jourdain::commands
