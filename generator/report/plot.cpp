#include "report/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "support/check.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::report {

namespace {

/// Readable on white and on black.
constexpr const char* kPalette[] = {"#d9480f", "#2f7ed8", "#2b8a3e", "#a64dc9", "#b8860b", "#0c9aa8",
                                    "#d6336c", "#868e96", "#5c7cfa", "#e8590c", "#12b886", "#9c6644"};
constexpr int kMarks[] = {7, 5, 9, 11, 13, 4, 6, 8, 10, 12, 15, 14};  ///< gnuplot's point types

/// Between single quotes of gnuplot.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

bool drawable(const Plot& plot, double x, double y) {
  return std::isfinite(x) && std::isfinite(y) && (!plot.x_logarithmic || x > 0) &&
         (!plot.y_logarithmic || y > 0);
}

std::string data_block(const Plot& plot, const Series& series, std::size_t index) {
  std::string text = fmt::format("$data{} << EOD\n", index);
  for (std::size_t i = 0; i < series.x.size(); ++i)
    text += drawable(plot, series.x[i], series.y[i])
                ? fmt::format("{:.9g} {:.9g}\n", series.x[i], series.y[i])
                : std::string("\n");
  return text + "EOD\n";
}

bool has_data(const Plot& plot, const Series& series) {
  for (std::size_t i = 0; i < series.x.size(); ++i)
    if (drawable(plot, series.x[i], series.y[i])) return true;
  return false;
}

std::string script(const Plot& plot, const std::string& output) {
  std::string text = "set encoding utf8\n";
  text += fmt::format("set terminal svg size {},{} dynamic font 'sans-serif,13' name {} enhanced\n",
                      kPlotWidth, plot.height, quoted(plot.name));
  text += "set output " + quoted(output) + "\n";
  text += "set title " + quoted(plot.title) + " noenhanced\nset xlabel " + quoted(plot.x_title) +
          " noenhanced\nset ylabel " + quoted(plot.y_title) + " noenhanced\n";
  text +=
      "set key bmargin center horizontal noenhanced samplen 2 width -2 height 1\nset grid lc rgb '#808080' "
      "lw "
      "0.4\nset border lw 0.8\n";
  if (plot.x_logarithmic) text += "set logscale x 10\nset format x '10^{%L}'\n";
  if (plot.y_logarithmic) text += "set logscale y 10\nset format y '10^{%L}'\n";
  std::string list;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& series = plot.series[i];
    if (!has_data(plot, series)) continue;
    text += data_block(plot, series, i);
    const auto colour = static_cast<std::size_t>(series.colour) % std::size(kPalette);
    const char* style = series.lines && series.marks ? "linespoints" : series.lines ? "lines" : "points";
    list +=
        fmt::format("{}$data{} using 1:2 with {} lc rgb '{}' lw 1.6{}{} {}", list.empty() ? "" : ", ", i,
                    style, kPalette[colour], series.dashed ? " dt 2" : "",
                    series.marks ? fmt::format(" pt {} ps {}", kMarks[colour], series.lines ? 0.6 : 1.1) : "",
                    series.title.empty() ? "notitle" : "title " + quoted(series.title));
  }
  JD_CHECK(!list.empty(), "plot '{}' shows nothing", plot.name);
  return text + "plot " + list + "\nset output\nreset session\n";
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

/// Black becomes the text colour of the page or, in a file of its own, of the reader's theme; ids become the
/// plot's own.
std::string themed(std::string svg, const std::string& name) {
  const std::size_t begin = svg.find("<svg");
  if (begin != std::string::npos) svg.erase(0, begin);
  for (const char* quote : {"\"", "'"}) {
    replace_all(svg, fmt::format("stroke={0}black{0}", quote),
                fmt::format("stroke={0}currentColor{0}", quote));
    replace_all(svg, fmt::format("fill={0}black{0}", quote), fmt::format("fill={0}currentColor{0}", quote));
  }
  replace_all(svg, " color=\"black\"", "");
  replace_all(svg, "textbox", name + "Textbox");
  replace_all(svg, "greybox", name + "Greybox");
  replace_all(svg, "gpDot", name + "Dot");
  replace_all(svg, "gpPt", name + "Pt");
  replace_all(svg, "gnuplot_plot_", name + "_plot_");
  const std::size_t end = svg.find('>', svg.find("<svg"));
  svg.insert(
      end + 1,
      fmt::format("\n<style>svg#{0}{{color:#222}}@media(prefers-color-scheme:dark){{svg#{0}{{color:#ddd}}}}"
                  "</style>",
                  name));
  svg.insert(svg.find("<svg") + 4, fmt::format(" id=\"{}\"", name));
  return svg;
}

}  // namespace

bool shows_anything(const Plot& plot) {
  return std::any_of(plot.series.begin(), plot.series.end(),
                     [&plot](const Series& series) { return has_data(plot, series); });
}

void check_plotter() {
  try {
    if (support::run_process({"gnuplot", "--version"}).status == 0) return;
  } catch (const support::EnvironmentError&) {
  }
  throw support::EnvironmentError("plots need gnuplot (Debian: gnuplot-nox), which cannot be run here");
}

std::vector<std::string> draw(const std::vector<Plot>& plots) {
  if (plots.empty()) return {};
  const support::TemporaryFolder folder;
  std::string text;
  const auto path_of = [&folder](const Plot& plot) { return folder.path() + "/" + plot.name + ".svg"; };
  for (const Plot& plot : plots) text += script(plot, path_of(plot));
  const std::string path = folder.path() + "/plots.gp";
  support::write_file(path, text);
  const support::ProcessResult result = support::run_process({"gnuplot", path});
  if (result.status != 0)
    throw support::EnvironmentError("gnuplot cannot draw the plots:\n" + result.output.substr(0, 2000));
  std::vector<std::string> drawn;
  for (const Plot& plot : plots) drawn.push_back(themed(support::read_file(path_of(plot)), plot.name));
  return drawn;
}

std::string stacked(const std::vector<std::string>& drawn, int height) {
  const int count = static_cast<int>(drawn.size());
  std::string text = fmt::format("<svg viewBox=\"0 0 {} {}\" xmlns=\"http://www.w3.org/2000/svg\">\n",
                                 kPlotWidth, count * height);
  for (int i = 0; i < count; ++i) {
    std::string panel = drawn[static_cast<std::size_t>(i)];
    panel.insert(panel.find("<svg") + 4,
                 fmt::format(" y=\"{}\" width=\"{}\" height=\"{}\"", i * height, kPlotWidth, height));
    text += panel;
  }
  return text + "</svg>\n";
}

}  // namespace jourdain::report
