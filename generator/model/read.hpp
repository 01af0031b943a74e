// Reading a mechanism from TOML or URDF. Every problem becomes a diagnostic; none throws.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/mechanism.hpp"
#include "model/snap.hpp"

namespace jourdain::model {

enum class RootJoint { kFixed, kFree };

struct ReadOptions {
  RootJoint root = RootJoint::kFixed;           ///< URDF only
  std::vector<std::string> locked_joints = {};  ///< become fixed joints at coordinate zero
  bool damping = true;                          ///< URDF: import <dynamics damping>
  double snap = kDefaultSnap;                   ///< rad, see model/snap.hpp; 0: directions as they are read
};

/// Longest text that is read, in bytes, and the most bodies and joints.
inline constexpr std::size_t kMaximumFileSize = 4'000'000;
inline constexpr std::size_t kMaximumBodies = 1000;

/// Reads and checks the text of `diagnostics` (TOML, or URDF when the path ends in .urdf or .xml). Nothing is returned
/// when an error was found.
std::optional<Mechanism> read_mechanism(support::Diagnostics& diagnostics, const ReadOptions& options = {});

/// The two formats; they do what `read_mechanism` does for a text that is valid UTF-8, without control characters and
/// not too long.
std::optional<Mechanism> read_toml(support::Diagnostics& diagnostics, const ReadOptions& options);
std::optional<Mechanism> read_urdf(support::Diagnostics& diagnostics, const ReadOptions& options);

/// What a reader cannot see line by line: two parents, cycles, bodies without a joint, negative mass, inertia that is
/// indefinite or violates the triangle inequality (after merging bodies joined by fixed joints), zero axes, more
/// than one root. `triangle` is the severity of a triangle violation (URDF: warning).
void check_mechanism(const Mechanism& mechanism, support::Diagnostics& diagnostics,
                     support::Severity triangle);

}  // namespace jourdain::model
