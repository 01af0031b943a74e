#include "commands/completion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace jourdain::commands {

namespace {

/// In single quotes for zsh, where brackets and colons end what an option means.
std::string zsh_text(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') safe += '\\';
    safe += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return safe;
}

std::string zsh_option(const OptionText& option, const std::string& name) {
  const std::string means = zsh_text(option.meaning);
  if (option.value.empty()) return fmt::format("'{}[{}]'", name, means);
  const std::string values =
      option.words.empty() ? "_files" : fmt::format("({})", fmt::join(option.words, " "));
  return fmt::format("'*{}[{}]:{}:{}'", name, means, option.value, values);
}

}  // namespace

std::string bash_completion(const std::vector<CommandText>& commands) {
  std::string names, options, words;
  for (const CommandText& command : commands) {
    names += (names.empty() ? "" : " ") + command.name;
    std::string list;
    for (const OptionText& option : command.options) {
      if (option.is_positional) {
        if (!option.words.empty()) list += fmt::format(" {}", fmt::join(option.words, " "));
        continue;
      }
      for (const std::string& name : option.names) {
        list += " " + name;
        if (!option.words.empty())
          words += fmt::format("    \"{} {}\") words=\"{}\" ;;\n", command.name, name,
                               fmt::join(option.words, " "));
      }
    }
    options += fmt::format("    {}) options=\"{}\" ;;\n", command.name, list.substr(list.empty() ? 0 : 1));
  }
  return fmt::format(
      "# bash completion of jourdain\n"
      "_jourdain() {{\n"
      "  local current=${{COMP_WORDS[COMP_CWORD]}} options=\"\" words=\"\"\n"
      "  case ${{COMP_WORDS[1]}} in\n{}  esac\n"
      "  case \"${{COMP_WORDS[1]}} ${{COMP_WORDS[COMP_CWORD - 1]}}\" in\n{}  esac\n"
      "  [ \"$COMP_CWORD\" -eq 1 ] && words=\"{} --help --version\"\n"
      "  [ -z \"$words\" ] && words=$options\n"
      "  COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
      "}}\n"
      "complete -o bashdefault -o default -F _jourdain jourdain\n",
      options, words, names);
}

std::string zsh_completion(const std::vector<CommandText>& commands) {
  std::string names, cases;
  for (const CommandText& command : commands) {
    names += fmt::format("    '{}:{}'\n", command.name, zsh_text(command.meaning));
    std::string options, positional = "_files";
    for (const OptionText& option : command.options) {
      if (option.is_positional && !option.words.empty())
        positional = fmt::format("({})", fmt::join(option.words, " "));
      if (!option.is_positional)
        for (const std::string& name : option.names) options += " \\\n      " + zsh_option(option, name);
    }
    cases +=
        fmt::format("    {}) _arguments{} \\\n      '*:argument:{}' ;;\n", command.name, options, positional);
  }
  return fmt::format(
      "#compdef jourdain\n"
      "_jourdain() {{\n"
      "  local -a commands=(\n{}  )\n"
      "  if (( CURRENT == 2 )); then\n    _describe command commands\n    return\n  fi\n"
      "  shift words\n  (( CURRENT-- ))\n"
      "  case $words[1] in\n{}  esac\n"
      "}}\n"
      "_jourdain \"$@\"\n",
      names, cases);
}

}  // namespace jourdain::commands
