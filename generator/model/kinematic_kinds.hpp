// The quantities that functions of the kinematics compute: one row for each, with what generic code asks.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "model/mechanism.hpp"

namespace jourdain::model {

/// How far a subscript of an array runs.
enum class ArrayExtent { kThree, kSix, kVelocities };

struct KinematicArray {
  std::string_view name;
  std::span<const ArrayExtent> extents;
  std::string_view unit;
  bool is_drift = false;  ///< only where positions move at z = 0
};

struct QuantityRow {
  KinematicQuantity quantity = KinematicQuantity::kPose;
  std::string_view name;  ///< as a model file has it
  bool of_frame = true;   ///< otherwise of the whole mechanism
  bool has_axes = false;  ///< whether the axes that are chosen matter
  bool takes_acceleration = false;
  bool holds_accelerations = false;  ///< prescribed accelerations are in it
  std::span<const KinematicArray> arrays;
  std::string_view text;  ///< what it is, a sentence; {} is the frame's name, {1} at which accelerations
};

const QuantityRow& quantity_row(KinematicQuantity quantity);

/// In the order of KinematicQuantity.
const std::vector<std::string>& quantity_names();
std::optional<KinematicQuantity> quantity_named(std::string_view name);

/// "world_aligned", "frame", "world".
const std::vector<std::string>& axes_names();
/// What velocities in these axes are, a sentence that says what other libraries call them.
std::string_view axes_text(Axes axes);

/// Index in Mechanism::kinematics.
std::optional<std::size_t> kinematic_function_named(const Mechanism& mechanism, std::string_view name);

bool takes_acceleration(const KinematicFunction& function);
/// Prescribed accelerations are in its results.
bool holds_accelerations(const KinematicFunction& function);

/// Why a text names no quantities.
struct KinematicError {
  std::string message, hint;
};

/// "pose", or "pose+jacobian" for one function of both: different ones, all of a frame or none.
std::variant<std::vector<KinematicQuantity>, KinematicError> parse_quantities(std::string_view text,
                                                                              bool of_frame);

/// Adds the function of these quantities to the mechanism, named `prefix`_quantity_quantity…, or after the quantities
/// where the prefix is empty. Returns what is wrong: its name is reserved, a macro's or taken, in C by an entry's
/// constant or by what is internal, or there is no mass to have a centre.
std::string add_kinematic_function(Mechanism& mechanism, const std::string& prefix,
                                   std::optional<FrameIndex> frame, Axes axes,
                                   const std::vector<KinematicQuantity>& quantities, SourceRange where = {});

}  // namespace jourdain::model
