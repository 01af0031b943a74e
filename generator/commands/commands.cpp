#include "commands/commands.hpp"

#include <initializer_list>

namespace jourdain::commands {

void add_all(CLI::App& app, int& status) {
  for (auto add : {add_compile, add_check, add_info, add_equations, add_simulate, add_ensemble, add_merge,
                   add_fmu, add_python, add_wrap, add_report, add_cost, add_bench, add_keys, add_pages})
    add(app, status);
}

}  // namespace jourdain::commands
