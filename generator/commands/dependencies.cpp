#include "commands/dependencies.hpp"

#include <filesystem>

namespace jourdain::commands {

namespace {

std::string escaped(const std::string& path) {
  std::string text;
  for (const char c : std::filesystem::absolute(path).lexically_normal().string()) {
    if (c == ' ' || c == '\t' || c == '#') text += '\\';
    if (c == '$') text += '$';
    text += c;
  }
  return text;
}

std::string list(const std::vector<std::string>& paths) {
  std::string text;
  for (const std::string& path : paths) text += (text.empty() ? "" : " \\\n  ") + escaped(path);
  return text;
}

}  // namespace

std::string dependency_rule(const std::vector<std::string>& targets,
                            const std::vector<std::string>& sources) {
  return list(targets) + ": \\\n  " + list(sources) + "\n";
}

}  // namespace jourdain::commands
