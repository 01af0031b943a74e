// One program that follows a model's motion, run on the host and, as firmware, in simulators of the targets.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "commands/target.hpp"

namespace jourdain::tests {

/// Fails, and does not pass over it, where a tool of the target is missing.
void require_tools(const commands::Target& target);

/// What sines, cosines and arctangents are.
enum class Sines {
  kOwn,       ///< those of the emitted text
  kLibrary,   ///< the C library's, by JOURDAIN_LIBRARY_SINES
  kWobbling,  ///< programs/wobble.c: the C library's, a unit in the last place beside; on the host alone
};

/// A model of models/ in a number type.
struct Motion {
  std::string model;
  std::string real;   ///< "double", "float"
  std::string step;   ///< s, as a literal
  bool is_c = false;  ///< the C text, otherwise the C++
};

inline constexpr const char* kModels[] = {"pendulum", "four_bar", "panda", "squeezer"};

/// With steps that are short beside the model's motion: the squeezer turns at up to 1000 rad/s.
Motion motion_of(const std::string& model, const std::string& real);

/// In the number type that the target usually computes in.
Motion motion_of(const std::string& model, const commands::Target& target);

/// All numbers of one kind at one time, as "motion.cpp" writes them.
struct Line {
  std::string what;
  std::vector<std::string> bits;
  std::vector<double> values;
};

/// As the host computes it, with all warnings as errors; sines that wobble do so in one of many patterns. Throws
/// EnvironmentError where that fails.
std::vector<Line> host_motion(const Motion& motion, Sines sines, unsigned pattern = 0);

/// The same of a target.
std::vector<Line> target_motion(const commands::Target& target, const Motion& motion, Sines sines);

/// The largest difference of each kind, in units in the last place of the largest number of that kind in `a`.
std::map<std::string, double> differences(const std::vector<Line>& a, const std::vector<Line>& b);

/// Symbols of the linked firmware of `target_motion`, as nm lists them.
std::string firmware_symbols(const commands::Target& target, const Motion& motion, Sines sines);

/// A C program of programs/ as firmware: what it writes.
std::string run_program(const commands::Target& target, const std::string& name);

/// The JSON of `jourdain cost models/MODEL.toml --target` with more arguments; run once for the same ones, unless it
/// shall be `fresh`.
nlohmann::json target_cost(const std::string& model, const commands::Target& target,
                           const std::vector<std::string>& more = {"--methods", "rk4"}, bool fresh = false);

/// A folder that all firmware of this process is built in.
const std::string& firmware_folder();

}  // namespace jourdain::tests
