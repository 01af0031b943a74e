// Emitted models compiled by a system compiler while a test runs, and called.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "agreement/judge.hpp"
#include "emit/file_text.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {

/// Emitted sources of one model; `name` is their namespace.
struct EmittedModel {
  std::string name;
  std::vector<emit::File> files;
  std::vector<std::string> parameters;  ///< names in order
  std::size_t positions = 0, velocities = 0;
  bool has_rate = false;    ///< dy/dt is not z
  std::size_t outputs = 0;  ///< numbers in Outputs
};

EmittedModel emit_model(const Derived& derived, const std::string& name);

/// What all functions of a model return at one sample. M: upper triangle by rows.
struct Evaluation {
  std::vector<double> M, k, q, zdot, tau, ydot, outputs, y_next, z_next;
  double kinetic = 0, potential = 0;
};

/// The style guide's flags for emitted code.
std::vector<std::string> strict_flags();

bool have_compiler(const std::string& compiler);

/// Options under which compiled code has the interpreter's bits: its sines are the C library's.
inline const std::vector<std::string> kAsInterpreted = {"-O1", "-ffp-contract=off",
                                                        "-DJOURDAIN_LIBRARY_SINES"};

/// Several models in one translation unit, behind one generic driver that is a template over Model.
class CompiledBatch {
 public:
  /// `real`: double or float. Fails with std::runtime_error and the compiler's words on any warning.
  CompiledBatch(const std::vector<EmittedModel>& models, const std::string& compiler, const std::string& real,
                const std::vector<std::string>& optimisation);
  ~CompiledBatch();

  /// All functions of model `index`; one rk4_step of length h.
  Evaluation evaluate(std::size_t index, const Sample& sample, double h = 1e-3) const;

 private:
  std::vector<EmittedModel> models_;
  support::TemporaryFolder folder_;
  void* handle_ = nullptr;
};

}  // namespace jourdain::tests
