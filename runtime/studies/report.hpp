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
  std::string name;          ///< of the model
  std::string description;   ///< of the model
  std::string path, sha256;  ///< of the description
  std::string real;          ///< number type under study: "double" or "float"
  std::string compiler;      ///< and options that decide speed
  std::string generator;     ///< and version
  std::string scenario;      ///< what drives the model, in words; empty without inputs
};

/// For a terminal, lines of 110 characters at most.
std::string report_text(const ReportHead& head, const jourdain_model_table& table, const Study& study);

/// work_precision.csv, error_sources.csv, first_kind.csv: as far as the study has them.
std::vector<support::FileText> report_csv(const jourdain_model_table& table, const Study& study);

std::string report_json(const ReportHead& head, const jourdain_model_table& table, const Study& study);

/// A sentence on the recommendation, or on why there is none; empty where nothing was asked.
std::string advice_text(const jourdain_model_table& table, const Study& study);

/// Sentences on what the numbers mean: reference, divergence, linear regime.
std::vector<std::string> remarks(const jourdain_model_table& table, const Study& study);

/// A time with a fitting unit: "250 us", "1 ms".
std::string time_text(double seconds);

}  // namespace jourdain::studies
