// The commands of the command line. A new one is one line in the list of commands.cpp.
#pragma once

namespace CLI {
class App;
}

namespace jourdain::commands {

/// Each adds its subcommand to `app`; when the user chose it, running the parsed `app` sets `status` to the
/// exit status.
void add_all(CLI::App& app, int& status);

void add_compile(CLI::App& app, int& status);
void add_check(CLI::App& app, int& status);
void add_info(CLI::App& app, int& status);
void add_equations(CLI::App& app, int& status);
void add_simulate(CLI::App& app, int& status);
void add_ensemble(CLI::App& app, int& status);
void add_merge(CLI::App& app, int& status);
void add_fmu(CLI::App& app, int& status);
void add_python(CLI::App& app, int& status);
void add_wrap(CLI::App& app, int& status);
void add_report(CLI::App& app, int& status);
void add_cost(CLI::App& app, int& status);
void add_bench(CLI::App& app, int& status);
void add_keys(CLI::App& app, int& status);
void add_pages(CLI::App& app, int& status);

}  // namespace jourdain::commands
