// Reading a mechanism from TOML, URDF, SDF or MJCF. Every problem becomes a diagnostic; none throws.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/mechanism.hpp"
#include "model/snap.hpp"

namespace jourdain::model {

enum class RootJoint { kFixed, kFree };

/// What all files that one description imports may take together; files that import others twice each would have no
/// bound.
struct ImportBudget {
  int files = 100;
  std::size_t bytes = 16'000'000;
};

/// The files that are being read: one that imports, and those that import it.
struct ImportChain {
  std::string path;  ///< canonical
  const ImportChain* outer = nullptr;
  ImportBudget* budget = nullptr;
};

struct ReadOptions {
  std::optional<RootJoint> root = {};           ///< URDF and SDF only; none: fixed, of SDF free
  std::vector<std::string> locked_joints = {};  ///< become fixed joints at coordinate zero
  bool damping = true;                          ///< URDF, SDF, MJCF: import joint damping
  bool friction = false;                        ///< URDF, SDF, MJCF: import friction of joints, smoothed
  bool mimic = true;                            ///< URDF, SDF: joints follow others, as <mimic> says
  double snap = kDefaultSnap;                   ///< rad, see model/snap.hpp; 0: directions as they are read
  const ImportChain* importing = nullptr;  ///< the files that import this one; none: it is read for itself
  bool external = false;    ///< TOML: functions that are 'external' stay calls, instead of their expressions
  std::string prefix = {};  ///< of the names of such calls: that of the file's import
  std::map<std::string, double> parameters = {};  ///< TOML: other default values than the file's, SI units
};

/// Which parts of a file could be read; checks that need a missing part are left out, so that one mistake in
/// a file does not show up as several.
struct Completeness {
  bool structure = true;  ///< all bodies and joints, with their names and ends
  bool numbers = true;    ///< all masses, inertias and placements
};

/// A file as it was read, not checked as a whole; diagnostics may have errors.
struct Part {
  Mechanism mechanism;
  Completeness complete;
  support::Severity triangle = support::Severity::kError;  ///< see `check_mechanism`
};

/// Longest text that is read, in bytes, and the most bodies and joints.
inline constexpr std::size_t kMaximumFileSize = 4'000'000;
inline constexpr std::size_t kMaximumBodies = 1000;

/// Reads and checks the text of `diagnostics`: SDF where the path ends in .sdf or .world, MJCF where it ends in .mjcf;
/// URDF or one of these, as the first element says, in .urdf and .xml; otherwise TOML. Nothing is returned when an
/// error was found.
std::optional<Mechanism> read_mechanism(support::Diagnostics& diagnostics, const ReadOptions& options = {});

/// Reads the text without what is done to a mechanism as a whole: locking, snapping, checks. Nothing is returned where
/// the text has not the form of its format.
std::optional<Part> read_part(support::Diagnostics& diagnostics, const ReadOptions& options);

/// The formats; they do what `read_part` does for a text that is valid UTF-8, without control characters and
/// not too long.
std::optional<Part> read_toml(support::Diagnostics& diagnostics, const ReadOptions& options);
std::optional<Part> read_urdf(support::Diagnostics& diagnostics, const ReadOptions& options);
std::optional<Part> read_sdf(support::Diagnostics& diagnostics, const ReadOptions& options);
std::optional<Part> read_mjcf(support::Diagnostics& diagnostics, const ReadOptions& options);

}  // namespace jourdain::model
