// Functions of the kinematics that the command line asks for.
#pragma once

#include <string>
#include <vector>

#include "model/mechanism.hpp"

namespace jourdain::commands {

/// "tool=hand", "tool=hand:pose,pose+jacobian" or "tool=hand:jacobian:frame": how names begin, a body or frame, what to
/// compute, and in which axes.
inline constexpr const char* kFrameHelp =
    "functions of a frame's motion: NAME=FRAME[:QUANTITIES[:AXES]], as in tool=hand or "
    "tool=hand:pose,pose+jacobian:frame; "
    "without QUANTITIES pose, velocity, acceleration, jacobian and jacobian_bias";

/// Adds functions to the mechanism: those of `frames`, and of the whole mechanism those that `functions` names, which
/// are taken out of it. Where `functions` names any, those of the description that it does not name go. Returns what is
/// wrong, or nothing.
std::string choose_kinematics(const std::vector<std::string>& frames, std::vector<std::string>& functions,
                              model::Mechanism& mechanism);

}  // namespace jourdain::commands
