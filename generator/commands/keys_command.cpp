#include <fmt/format.h>

#include <CLI/App.hpp>
#include <memory>
#include <string>

#include "commands/commands.hpp"
#include "commands/load.hpp"
#include "commands/model_schema.hpp"
#include "model/read/keys.hpp"
#include "report/text_table.hpp"

namespace jourdain::commands {

namespace {

const char* left_out(const model::Key& key) { return *key.standard ? key.standard : "required"; }

/// A page of all sections: models/README.md.
std::string page() {
  std::string text =
      "# The keys of a model\n\n"
      "`jourdain keys` prints this page as tables, `jourdain keys --markdown` as it stands here. Where a "
      "number stands, an expression over\n"
      "parameters may (`\"m/3*l^2\"`, `\"30*deg\"`), or a number with its unit (`\"30 deg\"`, `{ value = "
      "100, unit = \"mm\" }`); bare numbers\n"
      "have the unit of the table. Constants may not use parameters. The examples, in order, are one "
      "model, of this folder.\n\n"
      "The models of this folder say at their heads where their numbers come from.\n";
  for (const model::KeySection& section : model::key_sections()) {
    text += fmt::format("\n## {}\n\n{}\n\n| key | type | unit | where left out | |\n|---|---|---|---|---|\n",
                        section.heading, section.meaning);
    for (const model::Key& key : section.keys)
      text += fmt::format("| `{}` | {} | {} | {} | {} |\n", key.name, key.type, key.unit, left_out(key),
                          key.meaning);
    if (*section.example) text += fmt::format("\n```toml\n{}```\n", section.example);
  }
  return text;
}

std::string tables(const std::string& only) {
  std::string text;
  for (const model::KeySection& section : model::key_sections()) {
    if (!only.empty() && only != section.name) continue;
    report::TextTable table({"key", "type", "unit", "where left out", "meaning"});
    for (const model::Key& key : section.keys)
      table.add({key.name, key.type, key.unit, left_out(key), key.meaning});
    text +=
        fmt::format("{}{}\n{}\n{}", text.empty() ? "" : "\n", section.heading, section.meaning, table.text());
  }
  return text;
}

}  // namespace

void add_keys(CLI::App& app, int& status) {
  struct KeysArguments {
    std::string section;
    bool markdown = false, schema = false;
  };
  auto arguments = std::make_shared<KeysArguments>();
  CLI::App* command =
      app.add_subcommand("keys", "print what a TOML model may hold: jourdain keys, jourdain keys joint");
  std::vector<std::string> names;
  for (const model::KeySection& section : model::key_sections()) names.emplace_back(section.name);
  command->add_option("SECTION", arguments->section, "of the model; all where left out")
      ->check(CLI::IsMember(names));
  CLI::Option* markdown =
      command->add_flag("--markdown", arguments->markdown, "as the page models/README.md");
  command->add_flag("--schema", arguments->schema, "as a JSON schema for editors of TOML")
      ->excludes(markdown);
  command->callback([arguments, &status] {
    fmt::print("{}", arguments->schema     ? model_schema()
                     : arguments->markdown ? page()
                                           : tables(arguments->section));
    status = kSuccess;
  });
}

}  // namespace jourdain::commands
