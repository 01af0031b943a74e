// A stick figure of a mechanism: points whose places the emitted outputs give, and lines between them.
#pragma once

#include <string>
#include <vector>

#include "model/mechanism.hpp"

namespace jourdain::commands {

enum class LineKind { kBody, kSlide, kSpring };

struct FigureLine {
  LineKind kind = LineKind::kBody;
  std::size_t from = 0, to = 0;  ///< points
};

struct FigureMass {
  std::size_t point = 0;
  double mass = 0;  ///< kg, at the parameters' default values
  std::string body;
};

/// Point i is at entries 12 i, 12 i + 1, 12 i + 2 (m, inertial frame) of the outputs of `mechanism`.
struct Figure {
  model::Mechanism mechanism;  ///< the given one with the points' poses as its only outputs
  std::size_t point_count = 0;
  std::vector<FigureLine> lines;
  std::vector<FigureMass> masses;
};

Figure make_figure(const model::Mechanism& mechanism);

}  // namespace jourdain::commands
