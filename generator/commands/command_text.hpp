// Commands and options as the parser of the command line knows them, for manual pages and shell completions.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace jourdain::commands {

struct OptionText {
  std::vector<std::string> names;  ///< "-o", "--output"; of a positional argument its one name, "MODEL"
  std::string value;               ///< what follows: "TEXT", "FLOAT"; empty: nothing does
  std::vector<std::string> words;  ///< all that it may be; empty: anything
  std::string standard;            ///< where it is left out; may be empty
  std::string meaning;
  bool is_positional = false;
};

struct CommandText {
  std::string name;     ///< "compile"
  std::string meaning;  ///< "emit C++ for a model"
  std::string example;  ///< "jourdain compile arm.toml -o src/arm"
  std::vector<OptionText> options;
};

/// The subcommands of the parser, in order, with their options.
std::vector<CommandText> command_texts(const CLI::App& app);

}  // namespace jourdain::commands
