// Plots of a study and the page that holds them.
#pragma once

#include <string>
#include <vector>

#include "report/figure.hpp"
#include "studies/report.hpp"
#include "support/files.hpp"

namespace jourdain::report {

/// SVG files, and report.html with all of them in it, a table of the results and a playable stick figure.
std::vector<support::FileText> report_pages(const studies::ReportHead& head,
                                            const studies::Flow<double>& flow, const studies::Study& study,
                                            const Figure& figure);

/// The names of all files that pages of studies of some of these methods can have.
std::vector<std::string> page_names(const std::vector<std::string>& methods);

}  // namespace jourdain::report
