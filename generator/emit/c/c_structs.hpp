// Structs, counts and names of the emitted header in C.
#pragma once

#include <string>
#include <vector>

#include "emit/c/spelling.hpp"
#include "emit/file_text.hpp"
#include "emit/model_code.hpp"

namespace jourdain::emit::c {

/// Counts of y, z, u, …, and what stands where in them.
std::string c_counts(const CNames& names, const ModelText& model);

/// Names in order, closed by a null pointer: declarations, or definitions with them.
std::string c_name_arrays(const CNames& names, const programs::SceneFacts& scene, bool defined);

/// Parameters, Time, State, Input, Outputs, Linearization, Model, memories of steps: those that the scene has.
std::string c_structs(const CNames& names, const ModelText& model, const ModelCode& code,
                      const std::vector<programs::FunctionInfo>& functions,
                      const std::vector<support::CalledFunction>& called);

/// A struct that steps alone use.
std::string c_internal_struct(const CNames& names, const Struct& of);

/// Limits of State's members that tell how its loops were closed: declarations, or definitions.
std::string c_limits(const CNames& names, const ModelText& model, bool defined);

}  // namespace jourdain::emit::c
