// The kinds of outputs: one row for each, with what generic code asks.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/mechanism.hpp"

namespace jourdain::model {

/// What an output is about, which is what a file names beside its kind.
enum class OutputSubject { kNone, kFrame, kJoint, kCoordinate, kValue };

/// On what of a mechanism it depends whether an output depends on time.
enum class OutputClock {
  kFrame,      ///< on the joints that carry the frame
  kPositions,  ///< on all joints
  kDynamics,   ///< on all joints and forces
  kValue       ///< on the variables of the expression
};

enum class MemberShape {
  kScalar,
  kVector,      ///< 3
  kRotation,    ///< 3 × 3
  kPerVelocity  ///< 3 × nz; none where nz is 0
};

struct OutputMemberKind {
  std::string_view name;  ///< none: the output is this number
  MemberShape shape = MemberShape::kScalar;
  std::string_view unit = {};
};

/// Stands for the unit of a force on the coordinate: N or N m.
inline constexpr std::string_view kForceOnCoordinate = "force";

struct OutputKindRow {
  OutputKind kind = OutputKind::kExpression;
  std::string_view name;  ///< as a model file has it
  OutputSubject subject = OutputSubject::kNone;
  OutputClock clock = OutputClock::kDynamics;
  std::span<const OutputMemberKind> members;
  std::string_view text;  ///< what it is, a sentence; {} is the name of its subject

  /// Whether a joint must be there for it.
  bool is_of_joint() const {
    return subject == OutputSubject::kJoint || subject == OutputSubject::kCoordinate;
  }
};

const OutputKindRow& output_kind(OutputKind kind);

/// In the order of OutputKind.
const std::vector<std::string>& output_kind_names();

/// Of the frame, joint or coordinate that an output is about; empty where it is about none.
std::string subject_name(const Mechanism& mechanism, const Output& output);

}  // namespace jourdain::model
