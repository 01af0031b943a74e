// Sines, cosines and arctangents that models have of their own, as they are written.
#pragma once

namespace jourdain::readback {

/// A second copy of the text, apart from the templates; what it computes is compared with 113 bits in tests/embed.
const char* own_sines();
const char* own_arctangent();

/// What they stand for.
const char* library_sines();
const char* library_arctangent();

}  // namespace jourdain::readback
