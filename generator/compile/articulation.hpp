// Choice of the algorithm that solves M ż = k̄ − q̄, by counted operations and sampled errors.
#pragma once

#include <cstddef>
#include <vector>

#include "compile/forward_error.hpp"
#include "dynamics/equations.hpp"

namespace jourdain {

struct Articulation {
  std::vector<bool> links;  ///< DerivationOptions::articulated
  bool planar = false;      ///< DerivationOptions::planar, with no articulated links
  dynamics::PlanarForm form = dynamics::PlanarForm::kWorkingFrames;
  /// Of the accelerations, as chosen: before any pass, but behind all of them where a scene has equations of links,
  /// as passes alone see what the sum of two angles costs.
  std::size_t operations = 0;
  std::size_t factorised =
      0;  ///< without articulated bodies but a free root's; 0 for large scenes, where it is not
          ///< counted because it grows with the cube of a branch's length
  std::size_t articulated = 0;  ///< with all links articulated (the articulated-body algorithm)
  SampledError error;           ///< of what was chosen
  SampledError fewest_error;    ///< of what takes the fewest operations
  std::size_t spent = 0;        ///< operations more than the fewest, for the error

  void set(dynamics::DerivationOptions& options) const {
    options.articulated = links;
    options.planar = planar;
    options.planar_form = form;
  }
};

/// Which links are articulated bodies (the others' joints are eliminated from M): first the best depth from the roots,
/// then branch by branch one link more or less as long as that saves operations. Large scenes start from all
/// links. Scenes that move in planes may go by accelerations of links, small ones by angles between links
/// (program_cost.hpp). What takes the fewest operations is kept unless it loses digits that another way keeps.
Articulation choose_articulation(const model::Mechanism& mechanism,
                                 const dynamics::DerivationOptions& options);

/// dz/dt of a tree, before any pass.
ir::Program lower_accelerations(const model::Mechanism& mechanism,
                                const dynamics::DerivationOptions& options);

/// What was spent or given up, as a sentence; empty where nothing was.
std::string accuracy_sentence(const Articulation& articulation);

}  // namespace jourdain
