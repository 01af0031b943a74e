// Declarations of the emitted functions; the argument order is the binding API.
#pragma once

#include <string>
#include <vector>

#include "ir/program.hpp"
#include "programs/functions.hpp"

namespace jourdain::emit {

/// A function parameter: type, name and the bounds of an array reference.
struct Argument {
  std::string type, name, bounds;

  std::string text(bool named) const;
};

/// Bounds of an array of a scene, as "[7][7]".
std::string bounds_of(const programs::ArrayResult& array, const programs::SceneFacts& scene);

/// What an entry of y, z, ż, u or t is called where those arguments are.
std::string argument_entry(ir::LeafKind kind, std::size_t index);

/// For number type `real`.
std::vector<Argument> arguments(const programs::FunctionInfo& function, const std::string& real,
                                const programs::SceneFacts& scene);

/// Without the closing semicolon. Arguments that `body` does not use are left unnamed; without a body all are named.
std::string signature(const programs::FunctionInfo& function, const std::string& real,
                      const programs::SceneFacts& scene, const std::string* body = nullptr);

}  // namespace jourdain::emit
