// How files are written, beside what they compute: what writes them and what reads them back are told alike.
#pragma once

namespace jourdain::ir {

enum class Language {
  kCpp,  ///< C++: templates over the number type
  kC     ///< C99: files for each number type
};

struct TextChoices {
  Language language = Language::kCpp;
  /// Number types of what is compiled: C++'s instantiations, C's files. At least one.
  bool has_double = true, has_float = true;
  bool packs = false;     ///< C++: numbers and angles by customization points, as packs of lanes want them
  bool own_sines = true;  ///< sine and cosine by sums and products instead of the C library
  bool lanes = true;      ///< limbs that are alike are computed in one order, in C++ at once
  bool has_interface = false;  ///< C: instances and the table of variables too
};

}  // namespace jourdain::ir
