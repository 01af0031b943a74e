// A study as text, CSV, JSON and plots.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "studies/study.hpp"
#include "support/files.hpp"

namespace jourdain::studies {

/// What a report says beside its numbers.
struct ReportHead {
  std::string name;                     ///< of the model
  std::string description;              ///< of the model
  std::string path, sha256;             ///< of the description
  std::string real;                     ///< number type under study: "double" or "float"
  std::string compiler;                 ///< and options that decide speed
  std::string generator;                ///< and version
  std::string scenario;                 ///< what drives the model, in words; empty without inputs
  std::vector<std::string> loops = {};  ///< how loops are closed, in sentences; empty without loops
  std::string closing = {};             ///< what brings a step's end back to the loops, "2 Newton iterations"
};

/// For a terminal, lines of 110 characters at most.
std::string report_text(const ReportHead& head, const jourdain_model_table& table, const Study& study);

/// work_precision.csv, error_sources.csv, stability.csv, extremes.csv, first_kind.csv, loops.csv,
/// alternatives.csv: as far as the study has them.
std::vector<support::FileText> report_csv(const ReportHead& head, const jourdain_model_table& table,
                                          const Study& study);
/// The names of all of them.
std::vector<std::string> report_csv_names();

std::string report_json(const ReportHead& head, const jourdain_model_table& table, const Study& study);

/// A sentence on the recommendation, or on why there is none; empty where nothing was asked.
std::string advice_text(const jourdain_model_table& table, const Study& study);

/// Does the reference end before the time asked for?
bool is_judged_shorter(const Study& study);

/// Sentences on what the numbers mean: reference, divergence, linear regime.
std::vector<std::string> remarks(const jourdain_model_table& table, const Study& study);

/// Table of the largest stable steps with remarks, for a terminal; empty where stability was not studied.
std::string stability_text(const jourdain_model_table& table, const Study& study);
std::vector<std::string> stability_remarks(const jourdain_model_table& table, const Study& study);

/// Fastest mode, stiffness and each method's limit over time. An empty field: no limit; 0: no step is stable.
std::string stability_csv(const jourdain_model_table& table, const Stability& stability);

/// Worst errors of each sweep and where it breaks, for a terminal; empty where nothing was swept.
std::string extremes_text(const std::vector<ExtremeSweep>& sweeps);
/// A sweep in words: range, worst errors and their places, where accelerations stop being finite.
std::vector<std::vector<std::string>> extremes_rows(const std::vector<ExtremeSweep>& sweeps);
std::string extremes_csv(const std::vector<ExtremeSweep>& sweeps);

/// How loops are closed and how far they open, for a terminal; empty without loops.
std::string loops_text(const ReportHead& head, const jourdain_model_table& table, const Study& study);
/// Run by run: method, step, number of steps, largest |g| and |dg/dt|.
std::vector<std::vector<std::string>> loop_rows(const jourdain_model_table& table, const Study& study);
std::string loops_csv(const ReportHead& head, const jourdain_model_table& table, const Study& study);

/// How deep contacts, tyres and stops are pressed, for a terminal; empty without them.
std::string touches_text(const jourdain_model_table& table, const Study& study);
std::vector<std::string> touches_head(const Study& study);
std::vector<std::vector<std::string>> touches_rows(const Study& study);
/// Sentences on what the columns mean; there must be such elements.
std::vector<std::string> touches_remarks(const jourdain_model_table& table, const Study& study);

/// Other integrators beside the recommended step, for a terminal; empty where nothing was recommended.
std::string alternatives_text(const jourdain_model_table& table, const Study& study);
std::vector<std::string> alternatives_head();
std::vector<std::vector<std::string>> alternatives_rows(const Study& study);
/// Sentences on what the columns mean.
std::vector<std::string> alternatives_remarks(const jourdain_model_table& table, const Study& study);
std::string alternatives_csv(const Study& study);

/// That explicit methods are held to short steps by a damped mode and not by accuracy; empty where they are not.
std::string stiff_text(const jourdain_model_table& table, const Study& study);

/// Cells of a table of limits: predicted, observed, the mode that decides (1/s), what kind of mode that is.
std::string limit_text(const MethodLimit& limit);
std::string observed_text(const MethodLimit& limit);
std::string mode_text(std::complex<double> mu);
std::string judged_text(const MethodLimit& limit);

/// A sentence in lines for a terminal, indented.
std::string wrapped(const std::string& sentence);

/// A time with a fitting unit: "250 us", "1 ms".
std::string time_text(double seconds);

}  // namespace jourdain::studies
