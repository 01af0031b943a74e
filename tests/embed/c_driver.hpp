// A program that calls a model in C++ and in C and compares what they leave in memory, byte by byte.
#pragma once

#include <string>

namespace jourdain::tests {

/// Text of it, for double and float; the declarations of the headers of C for them say what there is to call. It takes
/// both languages through all functions at several states, with held and sampled inputs, prints how many results it
/// compared, and what differs; its status is 0 where nothing does.
std::string c_driver(const std::string& model, const std::string& header, const std::string& float_header);

}  // namespace jourdain::tests
