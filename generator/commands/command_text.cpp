#include "commands/command_text.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>

#include <sstream>

namespace jourdain::commands {

namespace {

/// "TEXT:{fixed,free}": the words between the braces.
std::vector<std::string> words_of(const std::string& type) {
  std::vector<std::string> words;
  const std::size_t open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return words;
  std::istringstream list(type.substr(open + 1, close - open - 1));
  for (std::string word; std::getline(list, word, ',');) words.push_back(word);
  return words;
}

OptionText option_text(const CLI::Option& option) {
  OptionText text;
  for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  text.is_positional = text.names.empty();
  if (text.is_positional) text.names.push_back(option.get_name(true));
  if (option.get_items_expected_max() > 0) {
    const std::string type = option.get_type_name();
    text.value = type.substr(0, type.find(':'));
    text.words = words_of(type);
    text.standard = option.get_default_str();
  }
  text.meaning = option.get_description();
  return text;
}

}  // namespace

std::vector<CommandText> command_texts(const CLI::App& app) {
  std::vector<CommandText> commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    CommandText& text = commands.emplace_back();
    text.name = command->get_name();
    text.meaning = command->get_description();
    if (const std::size_t example = text.meaning.find(": jourdain "); example != std::string::npos) {
      text.example = text.meaning.substr(example + 2);
      text.meaning.erase(example);
    }
    for (const CLI::Option* option : command->get_options()) text.options.push_back(option_text(*option));
  }
  return commands;
}

}  // namespace jourdain::commands
