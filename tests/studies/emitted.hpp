// Models compiled and loaded in the test's own process.
#pragma once

#include <string>
#include <vector>

#include "model/coordinates.hpp"
#include "model/mechanism.hpp"
#include "studies/loaded_model.hpp"

namespace jourdain::tests {

struct EmittedModel {
  model::Mechanism mechanism;
  model::Tangent tangent;  ///< of the independent coordinates, and of what is carried along
  studies::LoadedModel loaded;

  const jourdain_model_table& table() const { return loaded.table(); }

  /// From now on, also for the initial state.
  void set_parameter(const std::string& name, double value);
};

/// Functions that a model is emitted with: every stepper and the derivatives of forward dynamics, or a few
/// where those are long.
std::vector<std::string> all_loadable_functions();

/// Parameters have their values in the mechanism.
EmittedModel emitted_from(const model::Mechanism& mechanism, const std::vector<std::string>& functions);

/// Of a description in TOML; parameters have their values there.
EmittedModel emitted_from(const std::string& text,
                          const std::vector<std::string>& functions = all_loadable_functions());

/// Of models/NAME.toml.
EmittedModel emitted_model(const std::string& name,
                           const std::vector<std::string>& functions = all_loadable_functions());

/// Index of a method of the table.
std::size_t method_called(const jourdain_model_table& table, const std::string& name);

/// A mass on a rail with a spring (N/m) and a damper (N s/m), 0.1 m from rest; 1 kg.
std::string oscillator_text(double stiffness, double damping);

/// Chain of `count` rods (0.2 m, 0.5 kg) in a vertical plane, each held to the one before by a bushing:
/// parameters k (N/m) and c (N s/m) along and across, bending (N m/rad). Three velocities a rod, two of them stiff.
std::string bushing_chain_text(int count);

}  // namespace jourdain::tests
