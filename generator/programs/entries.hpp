// What y, z, u and the outputs consist of, entry by entry, with units: for people, tables and plots.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "loops/record/loop_plan.hpp"
#include "model/mechanism.hpp"
#include "programs/scene_facts.hpp"

namespace jourdain::programs {

/// An entry of y, z or u.
struct Entry {
  std::string name;
  std::string unit;         ///< "1" of quaternions; empty: the description does not say
  std::string description;  ///< what it is, in which axes
  std::optional<model::JointIndex> joint = {};
  std::optional<std::size_t> coordinate =
      {};              ///< of the joint; none for entries of quaternions and free joints
  double initial = 0;  ///< of y and z, at the parameters' default values
};

/// Entries of y, z and u in order, as in the emitted State and Input. Initial values of closed loops are those
/// after assembling.
struct Entries {
  std::vector<Entry> positions, velocities, inputs;
};
Entries entries_of(const model::Mechanism& mechanism, const loops::LoopPlan* plan);

/// Units of a coordinate, and of the force on it.
const char* position_unit(const model::Coordinate& coordinate);
const char* velocity_unit(const model::Coordinate& coordinate);
const char* force_unit(const model::Coordinate& coordinate);

/// One of the numbers that the emitted `outputs` writes, in its order.
struct OutputNumber {
  std::string name;    ///< "tracer.position[0]"
  std::string output;  ///< "tracer"
  std::string unit;    ///< "1" of rotation matrices; empty: the description does not say
};
std::vector<OutputNumber> output_numbers(const model::Mechanism& mechanism,
                                         const std::vector<OutputFacts>& declared);

}  // namespace jourdain::programs
