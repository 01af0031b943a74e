// In which language a file describes a mechanism.
#pragma once

#include <string>

namespace jourdain::model {

enum class Format { kToml, kUrdf, kSdf, kMjcf };

/// By the end of its name, and of XML by its first element.
Format format_of(const std::string& path, const std::string& text);

}  // namespace jourdain::model
