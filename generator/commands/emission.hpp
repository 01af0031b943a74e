// What the files of a model hold: the arguments of the commands that make them, beside those that say how the model is
// read.
#pragma once

#include <string>
#include <vector>

#include "commands/load.hpp"

namespace jourdain::commands {

/// Of ensembles.
inline constexpr const char* kTurnedSinesHelp =
    "the stages of a step turn the sines of its first by what angles have changed: less time, other last "
    "digits";

inline constexpr const char* kLibmHelp =
    "sines, cosines and arctangents of the C library, instead of sums and products of one cost up to "
    "2^30 rad (float: any)";

inline constexpr const char* kNoLanesHelp =
    "limbs that are alike one after the other, not at once as lanes of vectors";

struct EmissionArguments {
  std::vector<std::string> functions, frames;
  bool clock = false;
  std::string language = "c++", real = "both";
  bool interface = false, packs = false, libm = false, no_lanes = false;

  /// Adds --functions, --frame, --language, --real, --interface, --packs, --libm, --no-lanes and --clock.
  void add_to(CLI::App& command);

  /// Sets the options of `loaded` and adds the functions that are asked for to its mechanism. Returns what is wrong
  /// with the arguments, or nothing.
  std::string apply(LoadedMechanism& loaded) const;

  /// Tells, once applied, which of --functions the scene has not. Returns what is wrong where it has none of them and
  /// nothing else is asked for, or nothing.
  std::string tell_absent_functions(const LoadedMechanism& loaded) const;
};

/// Every function of the default lists, and those of the kinematics that the description asks for.
std::vector<std::string> usual_functions(const model::Mechanism& mechanism);

/// The options of a parsed command that decide what the files hold, in the order of the help, each as one word that may
/// be given again: "--root=free", "--functions=initial_state,rk4_step", "--no-damping". Empty where none was given.
std::vector<std::string> emission_words(const CLI::App& command);

}  // namespace jourdain::commands
