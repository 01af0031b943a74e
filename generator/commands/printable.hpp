// Arguments in messages, names in tables.
#pragma once

#include <string>
#include <string_view>

namespace jourdain::commands {

/// For a terminal: arguments and paths, which messages name, may hold anything. Control characters, those that change
/// the direction of text and what is no UTF-8 become '?'; line ends stay.
std::string printable(std::string_view text);

/// A field of CSV, in quotes where it has to be; names from a URDF may hold commas and quotes.
std::string csv_field(std::string_view text);

}  // namespace jourdain::commands
