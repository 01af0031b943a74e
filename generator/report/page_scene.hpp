// The motion of a figure as the data that the page's script draws.
#pragma once

#include <string>

#include "report/figure.hpp"
#include "studies/flow.hpp"
#include "studies/study.hpp"

namespace jourdain::report {

/// A script's object: the figure, its poses along the reference of `study`, and the view of it. Where all
/// bodies move in one plane that is from the front.
std::string scene_json(const studies::Flow<double>& flow, const studies::Study& study, const Figure& figure);

}  // namespace jourdain::report
