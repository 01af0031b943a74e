#include "commands/manual.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>

#include "emit/file_text.hpp"
#include "emit/templates.hpp"

namespace jourdain::commands {

namespace {

/// Text that means nothing to troff.
std::string plain(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '\\')
      safe += "\\e";
    else if (c == '-')
      safe += "\\-";
    else
      safe += c;
  }
  return !safe.empty() && (safe[0] == '.' || safe[0] == '\'') ? "\\&" + safe : safe;
}

std::string bold(const std::string& text) { return "\\fB" + plain(text) + "\\fR"; }

std::string option_entry(const OptionText& option) {
  std::string names;
  for (const std::string& name : option.names) names += (names.empty() ? "" : ", ") + bold(name);
  if (!option.value.empty() && !option.is_positional) names += " \\fI" + plain(option.value) + "\\fR";
  std::string text = option.meaning;
  if (!option.words.empty()) text += fmt::format(" ({})", fmt::join(option.words, ", "));
  if (!option.standard.empty()) text += fmt::format(" [{}]", option.standard);
  return fmt::format(".TP\n{}\n{}\n", names, plain(text));
}

support::FileText command_page(const CommandText& command) {
  std::string synopsis = bold("jourdain " + command.name), arguments, options;
  for (const OptionText& option : command.options) {
    (option.is_positional ? arguments : options) += option_entry(option);
    if (option.is_positional) synopsis += " \\fI" + plain(option.names.front()) + "\\fR";
  }
  synopsis += " [\\fIOPTION\\fR...]";
  std::string upper = "jourdain-" + command.name;
  std::transform(upper.begin(), upper.end(), upper.begin(), [](unsigned char c) { return std::toupper(c); });
  return {"jourdain-" + command.name + ".1",
          emit::fill(emit::template_text("manual_command.in"),
                     {{"TITLE", upper},
                      {"VERSION", emit::kVersion},
                      {"NAME", plain("jourdain-" + command.name)},
                      {"MEANING", plain(command.meaning)},
                      {"SYNOPSIS", synopsis},
                      {"OPTIONS", arguments + options},
                      {"EXAMPLE", command.example.empty() ? "" : ".SH EXAMPLE\n" + plain(command.example)}})};
}

}  // namespace

std::vector<support::FileText> manual_pages(const std::vector<CommandText>& commands) {
  std::vector<support::FileText> pages;
  std::string list, see;
  for (const CommandText& command : commands) {
    list += fmt::format(".TP\n{}\n{}\n", bold("jourdain " + command.name), plain(command.meaning));
    see += fmt::format("{}{} (1)", see.empty() ? "" : ",\n.BR ", plain("jourdain-" + command.name));
    pages.push_back(command_page(command));
  }
  pages.push_back(
      {"jourdain.1", emit::fill(emit::template_text("manual.in"),
                                {{"VERSION", emit::kVersion}, {"COMMANDS", list}, {"SEE", ".BR " + see}})});
  return pages;
}

}  // namespace jourdain::commands
