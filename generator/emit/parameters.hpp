// Parameters of the emitted functions; their order is the binding API.
#pragma once

#include <vector>

#include "emit/tree.hpp"
#include "programs/functions.hpp"

namespace jourdain::emit {

inline const Type kRealType{Type::Kind::kReal}, kIntegerType{Type::Kind::kInteger};

Type struct_type(const std::string& name);

std::vector<std::size_t> extents_of(const programs::ArrayResult& array, const programs::SceneFacts& scene);

/// Where an entry of y, z, ż, u or t is where those parameters are.
Expression place_of(ir::LeafKind kind, std::size_t index);

std::vector<Parameter> parameters_of(const programs::FunctionInfo& function,
                                     const programs::SceneFacts& scene);

}  // namespace jourdain::emit
