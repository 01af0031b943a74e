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

/// What follows "with".
std::string style_of(const Series& series) {
  const auto index = static_cast<std::size_t>(series.colour) % std::size(kPalette);
  const char* const colour = kPalette[index];
  if (series.filled)
    return fmt::format("filledcurves closed fc rgb '{0}' fs transparent solid 0.35 border lc rgb '{0}'",
                       colour);
  const char* style = series.lines && series.marks ? "linespoints" : series.lines ? "lines" : "points";
  return fmt::format(
      "{} lc rgb '{}' lw 1.6{}{}", style, colour, series.dashed ? " dt 2" : "",
      series.marks ? fmt::format(" pt {} ps {}", kMarks[index], series.lines ? 0.6 : 1.1) : "");
}

std::string script(const Plot& plot, const std::string& output) {
  std::string text = "set encoding utf8\n";
  text += fmt::format("set terminal svg size {},{} dynamic font 'sans-serif,13' name {} enhanced\n",
                      plot.width, plot.height, quoted(plot.name));
  text += "set output " + quoted(output) + "\n";
  text += "set title " + quoted(plot.title) + " noenhanced\nset xlabel " + quoted(plot.x_title) +
          " noenhanced\nset ylabel " + quoted(plot.y_title) + " noenhanced\n";
  text +=
      "set key bmargin center horizontal noenhanced samplen 2 width -2 height 1\nset grid lc rgb '#808080' "
      "lw "
      "0.4\nset border lw 0.8\n";
  const auto any = [&plot](auto&& is) { return std::any_of(plot.series.begin(), plot.series.end(), is); };
  if (!any([](const Series& series) { return !series.title.empty(); })) text += "unset key\n";
  if (any([](const Series& series) { return series.filled; }))
    text += "set autoscale xfix\nset offsets graph 0.03, graph 0.03, graph 0.06, 0\n";
  if (plot.width < kPlotWidth) text += "set lmargin 9\nset rmargin 3\nset tmargin 2.5\nset bmargin 3.5\n";
  if (plot.x_step > 0) text += fmt::format("set xtics {:.9g}\n", plot.x_step);
  if (plot.x_logarithmic) text += "set logscale x 10\nset format x '10^{%L}'\n";
  if (plot.y_logarithmic) text += "set logscale y 10\nset format y '10^{%L}'\n";
  std::string list;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& series = plot.series[i];
    if (!has_data(plot, series)) continue;
    text += data_block(plot, series, i);
    list += fmt::format("{}$data{} using 1:2 with {} {}", list.empty() ? "" : ", ", i, style_of(series),
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
  return tiled(drawn, "", 1, kPlotWidth, height);
}

std::string tiled(const std::vector<std::string>& drawn, const std::string& heading, int per_row, int width,
                  int height) {
  constexpr int kHeading = 34;
  const int count = static_cast<int>(drawn.size()), top = heading.empty() ? 0 : kHeading;
  std::string text =
      fmt::format("<svg viewBox=\"0 0 {} {}\" xmlns=\"http://www.w3.org/2000/svg\">\n",
                  std::min(count, per_row) * width, (count + per_row - 1) / per_row * height + top);
  if (!heading.empty())
    text += fmt::format(
        "<text x=\"12\" y=\"24\" font-family=\"sans-serif\" font-size=\"16\" fill=\"#808080\">"
        "{}</text>\n",
        heading);
  for (int i = 0; i < count; ++i) {
    std::string panel = drawn[static_cast<std::size_t>(i)];
    const std::string column = i % per_row > 0 ? fmt::format(" x=\"{}\"", i % per_row * width) : "";
    panel.insert(panel.find("<svg") + 4, fmt::format("{} y=\"{}\" width=\"{}\" height=\"{}\"", column,
                                                     i / per_row * height + top, width, height));
    text += panel;
  }
  return text + "</svg>\n";
}

}  // namespace jourdain::report
