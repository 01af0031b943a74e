// Plots by gnuplot, as SVG that follows the reader's light or dark theme.
#pragma once

#include <string>
#include <vector>

namespace jourdain::report {

inline constexpr int kPlotWidth = 860;

/// One line or set of marks.
struct Series {
  std::string title;
  std::vector<double> x, y;
  int colour = 0;     ///< index into the palette
  bool lines = true;  ///< join the points
  bool marks = true;  ///< mark the points
  bool dashed = false;
  bool filled = false;  ///< the polygon of the points
};

struct Plot {
  std::string name;  ///< of the file, without ending; an identifier
  std::string title, x_title, y_title;
  bool x_logarithmic = true, y_logarithmic = true;
  std::vector<Series> series;
  int height = 520, width = kPlotWidth;
  double x_step = 0;  ///< between marks of the axis; 0: gnuplot's choice
};

/// Has it a point that its axes can show?
bool shows_anything(const Plot& plot);

/// Throws EnvironmentError with a remedy where gnuplot cannot be run.
void check_plotter();

/// The plots, which must show something, as SVG texts, in order. Throws EnvironmentError with gnuplot's words
/// when it fails.
std::vector<std::string> draw(const std::vector<Plot>& plots);

/// SVG texts of plots of that height as one, from top to bottom.
std::string stacked(const std::vector<std::string>& drawn, int height);

/// SVG texts of plots of that size as one, row by row of so many, below a heading.
std::string tiled(const std::vector<std::string>& drawn, const std::string& heading, int per_row, int width,
                  int height);

}  // namespace jourdain::report
