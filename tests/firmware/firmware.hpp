// One program that follows a model's motion, run on the host and, as firmware, in simulators of the targets.
#pragma once

#include <string>
#include <vector>

#include "commands/target.hpp"

namespace jourdain::tests {

/// Fails, and does not pass over it, where a tool of the target is missing.
void require_tools(const commands::Target& target);

/// What sines, cosines and arctangents are.
enum class Sines {
  kLibrary,   ///< the C library's
  kKernel,    ///< programs/kernel.c: the same bits everywhere
  kWobbling,  ///< programs/wobble.c: the C library's, a unit in the last place beside; on the host alone
};

/// A model of models/ in a number type.
struct Motion {
  std::string model;
  std::string real;  ///< "double", "float"
  std::string step;  ///< s, as a literal
};

/// All numbers of one kind at one time, as "motion.cpp" writes them.
struct Line {
  std::string what;
  std::vector<std::string> bits;
  std::vector<double> values;
};

/// As the host computes it, with all warnings as errors. Throws EnvironmentError where that fails.
std::vector<Line> host_motion(const Motion& motion, Sines sines);

/// The same of a target.
std::vector<Line> target_motion(const commands::Target& target, const Motion& motion, Sines sines);

/// Symbols of the linked firmware of `target_motion`, as nm lists them.
std::string firmware_symbols(const commands::Target& target, const Motion& motion, Sines sines);

/// A C program of programs/ as firmware: what it writes.
std::string run_program(const commands::Target& target, const std::string& name);

/// A folder that all firmware of this process is built in.
const std::string& firmware_folder();

}  // namespace jourdain::tests
