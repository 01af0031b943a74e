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
  bool friction = false;                        ///< URDF: import <dynamics friction>, smoothed
  bool mimic = true;                            ///< URDF: joints follow others, as <mimic> says
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

}  // namespace jourdain::model
