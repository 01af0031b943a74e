// Declarations and definitions of functions, and of the structs that they share, in C++.
#pragma once

#include <string>

#include "emit/cpp/printer.hpp"
#include "emit/model_code.hpp"

namespace jourdain::emit::cpp {

/// "void f(const Model<Real>& model, …) noexcept", on one line, for number type `real` and held inputs. Parameters
/// that the body does not mention are named only where `all_named`.
std::string signature(const Function& function, const std::string& real, bool all_named);

/// The definition; of a step that may sample its inputs also the one that takes them as a function of the state.
std::string definition(const Function& function);

/// In namespace detail: parts of a long body.
std::string part_definition(const Function& part);

/// In namespace detail: structs, tables and functions; `samples_inputs`: some take the inputs as a function of the
/// state.
std::string support_text(const Support& support, bool samples_inputs);

/// A struct that users have: documented, with initial values.
std::string public_struct(const Struct& of);

}  // namespace jourdain::emit::cpp
