#include <fmt/format.h>

#include <CLI/App.hpp>

#include <memory>
#include <string>

#include "commands/command_text.hpp"
#include "commands/commands.hpp"
#include "commands/completion.hpp"
#include "commands/load.hpp"
#include "commands/manual.hpp"
#include "commands/model_schema.hpp"
#include "emit/templates.hpp"
#include "support/files.hpp"

namespace jourdain::commands {

namespace {

/// Folders as below /usr/share.
int run(const CLI::App& app, const std::string& folder) {
  const std::vector<CommandText> commands = command_texts(app);
  support::write_files(folder + "/man/man1", manual_pages(commands));
  support::write_files(folder + "/bash-completion/completions", {{"jourdain", bash_completion(commands)}});
  support::write_files(folder + "/zsh/vendor-completions", {{"_jourdain", zsh_completion(commands)}});
  support::write_files(folder + "/jourdain",
                       {{"model.schema.json", model_schema()},
                        {"manifest.schema.json", std::string(emit::template_text("manifest.schema.json"))}});
  return kSuccess;
}

}  // namespace

void add_pages(CLI::App& app, int& status) {
  auto folder = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(
      "pages", "write manual pages, shell completions and schemas of JSON: jourdain pages share");
  command->add_option("FOLDER", *folder, "folder to write into")->required();
  command->callback([&app, folder, &status] { status = run(app, *folder); });
}

}  // namespace jourdain::commands
