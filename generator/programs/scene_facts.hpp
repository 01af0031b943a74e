// The facts of a scene: made once from the mechanism and the plan of its loops, and only read from then on.
#pragma once

#include <string>
#include <vector>

#include "loops/record/loop_plan.hpp"
#include "model/coordinates.hpp"
#include "model/mechanism.hpp"
#include "model/time_dependence.hpp"

namespace jourdain::programs {

/// Members of an output; a scalar has one without a name.
struct OutputMember {
  std::string name;
  int rows = 1, columns = 1;
  bool is_matrix = false;

  std::size_t numbers() const { return static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns); }
};

struct OutputFacts {
  std::string name;
  std::string comment;  ///< what it is, a sentence
  std::vector<OutputMember> members;
};

/// A function of the kinematics, see model::KinematicFunction.
struct KinematicFacts {
  std::string name;
  std::string comment;  ///< sentences, lines separated by '\n'
  std::vector<model::KinematicQuantity> quantities;
};

struct SceneFacts {
  std::vector<std::string> positions, inputs;  ///< names by entry
  std::vector<std::string> velocities;         ///< of the independent coordinates, then the states
  std::vector<model::StateVariable> states;    ///< which are the last entries of z
  std::vector<model::Parameter> parameters;
  std::vector<OutputFacts> outputs;
  std::vector<KinematicFacts> kinematics;
  model::Tangent tangent;  ///< of the independent coordinates
  model::TimeDependence time;
  bool motions_follow_states = false;  ///< prescribed positions depend on states
  bool motions_take_inputs = false;    ///< prescribed accelerations depend on inputs
  bool clock = false;  ///< states hold the time: something depends on it, inputs may, or it was asked for

  bool all_derivatives = true;  ///< those of the residual hold all terms

  std::vector<std::string> constraints;  ///< names of the rows of all loops
  bool is_reduced = false;               ///< some coordinates follow from others
  std::vector<std::size_t> dependents;   ///< entries of y that close_loops sets
  /// Entries of y and z that start as the description says, where loops might move them.
  std::vector<std::size_t> kept_positions, kept_velocities;
  std::vector<std::size_t> carried;  ///< entries of y whose velocities follow, but not they themselves
  int closings =
      1;  ///< calls of close_loops where dependent positions were not integrated along: more for Newton's method

  /// Entries of z that displace something.
  std::size_t moving() const { return velocities.size() - states.size(); }
  /// Displacements of positions that are not closed: of the independent coordinates, then of those carried along.
  std::size_t displacements() const { return moving() + carried.size(); }
  /// Of the residual and of all rates, for linearly implicit steps, which leave out those of what is carried along.
  bool has_whole_derivatives() const { return all_derivatives && carried.empty(); }
  /// "floor_x, floor_y"
  std::string carried_names() const;
  /// dy/dt is not z.
  bool has_rate() const { return !tangent.quaternions.empty() || is_reduced || !states.empty(); }
  /// Numbers of all outputs.
  std::size_t output_numbers() const;
};

/// What is asked for beyond what the scene needs.
struct SceneWishes {
  bool clock = false;  ///< see SceneFacts
  bool all_derivatives = true;
};

/// Of a tree, or with loops as `plan` closes them.
SceneFacts scene_facts(const model::Mechanism& mechanism, const loops::LoopPlan* plan = nullptr,
                       const SceneWishes& wishes = {});

}  // namespace jourdain::programs
