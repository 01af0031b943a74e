// Reading a mechanism from TOML, URDF or SDF. Every problem becomes a diagnostic; none throws.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/mechanism.hpp"
#include "model/snap.hpp"

namespace jourdain::model {

enum class RootJoint { kFixed, kFree };

struct ReadOptions {
  std::optional<RootJoint> root = {};           ///< URDF and SDF only; none: fixed, of SDF free
  std::vector<std::string> locked_joints = {};  ///< become fixed joints at coordinate zero
  bool damping = true;                          ///< URDF, SDF: import <dynamics damping>
  bool friction = false;                        ///< URDF, SDF: import <dynamics friction>, smoothed
  bool mimic = true;                            ///< URDF, SDF: joints follow others, as <mimic> says
  double snap = kDefaultSnap;                   ///< rad, see model/snap.hpp; 0: directions as they are read
};

/// Longest text that is read, in bytes, and the most bodies and joints.
inline constexpr std::size_t kMaximumFileSize = 4'000'000;
inline constexpr std::size_t kMaximumBodies = 1000;

/// Reads and checks the text of `diagnostics`: SDF where the path ends in .sdf or .world, URDF (or SDF, as the root
/// element says) where it ends in .urdf or .xml, otherwise TOML. Nothing is returned when an error was found.
std::optional<Mechanism> read_mechanism(support::Diagnostics& diagnostics, const ReadOptions& options = {});

/// The formats; they do what `read_mechanism` does for a text that is valid UTF-8, without control characters and
/// not too long.
std::optional<Mechanism> read_toml(support::Diagnostics& diagnostics, const ReadOptions& options);
std::optional<Mechanism> read_urdf(support::Diagnostics& diagnostics, const ReadOptions& options);
std::optional<Mechanism> read_sdf(support::Diagnostics& diagnostics, const ReadOptions& options);

}  // namespace jourdain::model
