// The parts of a report's page that are about stability and extremes.
#pragma once

#include <string>
#include <vector>

#include "report/plot.hpp"
#include "studies/study.hpp"

namespace jourdain::report {

/// Eigenvalues times h on the methods' regions, and the limits along time; empty where stability was not studied.
std::vector<Plot> stability_plots(const jourdain_model_table& table, const studies::Study& study);

/// The largest stable steps as an HTML table.
std::string stability_table(const jourdain_model_table& table, const studies::Study& study);

/// Accelerations far from the usual, as an HTML table.
std::string extremes_table(const studies::Study& study);

}  // namespace jourdain::report
