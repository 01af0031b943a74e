// What all commands share: the arguments that say which model to read and how, and reading it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "compile/compile.hpp"
#include "model/read/read.hpp"
#include "model/read/urdf_limits.hpp"

namespace CLI {
class App;
}

namespace jourdain::commands {

/// Exit statuses (README, style guide).
inline constexpr int kSuccess = 0, kModelWrong = 1, kUsage = 2, kEnvironment = 3, kInternal = 70;

struct ModelArguments {
  std::string path;
  std::string root;  ///< "fixed", "free"; empty: as the format has it
  std::string name;
  std::string derivatives = "all";
  model::ReadOptions read;

  bool strict = false;

  /// Adds MODEL, --root, --lock, --no-damping, --friction, --no-mimic, --snap, --no-snap, --strict, --derivatives
  /// and --name.
  void add_to(CLI::App& command);
};

struct LoadedMechanism {
  model::Mechanism mechanism;
  model::ReadOptions read;                           ///< how it was read
  CompileOptions options;                            ///< name, path, hash and the plan of the loops filled in
  std::map<std::string, model::Limits> limits = {};  ///< URDF: of joints, by name
  std::vector<std::string> sources = {};             ///< paths of the description and of all that it imports

  std::size_t freedom() const;  ///< degrees of freedom
  /// Generalized velocities of the emitted State: the independent ones, with multipliers all.
  std::size_t velocity_count() const { return programs::scene_facts(mechanism, plan()).velocities.size(); }
  const loops::LoopPlan* plan() const { return options.loops ? &*options.loops : nullptr; }
};

/// What functions that are 'external' are: calls of code that is not here, or their expressions, as all commands need
/// that run a model.
enum class External { kCalled, kWrittenOut };

/// Has calls of external functions.
bool calls_user_code(const model::Mechanism& mechanism);

/// "1 degree of freedom".
std::string freedom_text(const LoadedMechanism& loaded);

/// How the loops are closed and what the assembly moved, in sentences; empty where there are no loops.
std::vector<std::string> loop_sentences(const LoadedMechanism& loaded);

/// Reads and checks the model and prints its diagnostics to stderr; nothing when it has errors. Throws EnvironmentError
/// when the file cannot be read.
std::optional<LoadedMechanism> load(const ModelArguments& arguments,
                                    External external = External::kWrittenOut);

/// Prints a note where files for double hold floats too, and a number has no room there.
void tell_float_misfit(const CompiledModel& compiled);

/// Prints why the compiler refused to emit, in three lines. The status to exit with: kModelWrong where double
/// has no room for the mechanism's numbers.
int refuse(const LoadedMechanism& loaded, const validate::Verdict& verdict);

}  // namespace jourdain::commands
