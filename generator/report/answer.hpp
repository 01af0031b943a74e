// The first words of a report's page: which step of which method, what error it has and why it is that one.
#pragma once

#include <string>

#include "studies/report.hpp"

namespace jourdain::report {

/// For HTML.
std::string escaped(const std::string& text);

/// Paragraphs for readers who know no numerics.
std::string answer_html(const jourdain_model_table& table, const studies::Study& study);

/// Is it a remark that takes back a part of what the report says?
bool is_warning(const std::string& remark);

/// Each in a box of its own.
std::string warnings_html(const std::vector<std::string>& remarks);

}  // namespace jourdain::report
