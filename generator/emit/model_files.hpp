// The emitted files of a model.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "ir/module.hpp"
#include "model/coordinates.hpp"
#include "programs/functions.hpp"
#include "support/files.hpp"

namespace jourdain::emit {

struct ParameterText {
  std::string name;
  double value = 0;
  std::string unit;
  std::string description;
  std::optional<std::array<double, 2>> range = {};
};

/// Members of an output; a scalar has one without a name.
struct OutputMember {
  std::string name;
  int rows = 1, columns = 1;
  bool is_matrix = false;
};

struct OutputDeclaration {
  std::string name;
  std::string comment;
  std::vector<OutputMember> members;
};

/// Values of a position or a parameter for which the closing of loops is proven.
struct ProvenText {
  std::size_t index = 0;
  double low = 0, high = 0;
};

/// What the files say about a model beside its programs.
struct ModelText {
  std::string name;   ///< namespace and file name
  std::string title;  ///< the model's own name
  std::string description;
  std::string numbers_from;                                ///< source of the model's numbers
  std::string path;                                        ///< relative path of the description
  std::string sha256;                                      ///< of the description
  std::vector<std::string> positions, velocities, inputs;  ///< names in order
  model::Tangent tangent;
  model::TimeDependence time;
  bool clock = false;           ///< see SceneShape
  bool all_derivatives = true;  ///< those of the residual hold all terms
  std::vector<OutputDeclaration> outputs;
  std::vector<ParameterText> parameters;
  std::vector<std::string> constraints;  ///< names of the rows of all loops
  std::vector<std::size_t> dependents;   ///< entries of y that follow from the others
  int closings = 1;                      ///< see SceneShape
  std::vector<std::string> loops;        ///< sentences on how loops are closed
  double least_regularity = 0,
         greatest_opening = 0;     ///< limits of State's members of these names; with loops
  bool opening_is_proven = false;  ///< its limit follows from a proof
  std::vector<ProvenText> proven_positions, proven_parameters;
  std::vector<std::string> assumptions;  ///< sentences
  std::vector<std::string> left_out;     ///< sentences
  std::vector<std::string> validation;   ///< sentences
  double backward_error = 0;             ///< of M zdot = k_bar − q_bar, worst over the sampled states
  double condition = 0;                  ///< cond(M), worst over the sampled states
};

using File = support::FileText;

/// NAME.hpp, NAME_kernels.hpp, NAME.cpp and NAME.json, in this order. `functions` are those to emit; each but kStep has a
/// program of the same name in `module`.
std::vector<File> emit_files(const ModelText& model, const std::vector<programs::FunctionInfo>& functions,
                             const ir::Module& module);

inline constexpr const char* kVersion = "0.1.0";

}  // namespace jourdain::emit
