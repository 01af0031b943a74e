#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "commands/content_hash.hpp"
#include "commands/ensemble_file.hpp"
#include "commands/ensemble_file_layout.hpp"
#include "commands/hdf5_object.hpp"
#include "commands/printable.hpp"
#include "support/check.hpp"

namespace jourdain::commands {

namespace {

/// What is wrong with the bytes of a file; empty: nothing.
std::string broken_seal(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  std::ifstream in(path, std::ios::binary);
  if (error || !std::filesystem::is_regular_file(status) || !in)
    throw support::EnvironmentError(fmt::format("{}: cannot be read{}", path,
                                                error ? ": " + error.message()
                                                : std::filesystem::is_regular_file(status)
                                                    ? ""
                                                    : ": it is no file"));
  std::string head(kHead, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (!head.starts_with(kHeadLine)) return "it is no file that 'jourdain ensemble' wrote";
  if (head == head_of(sha256_of_file(path, kHead))) return "";
  return "it is damaged: not the bytes that were written";
}

/// Reads what a file holds, part by part; what is wrong first is kept.
class Reader {
 public:
  explicit Reader(const std::string& path) : file_(open_hdf5_file(path)) {
    check(bool(file_), "it is no HDF5");
    if (problem_.empty()) read_all();
  }

  const std::string& problem() const { return problem_; }
  EnsembleResult take() { return std::move(result_); }

 private:
  /// False where something is wrong, here or before.
  bool check(bool is_right, const std::string& what) {
    if (!is_right && problem_.empty()) problem_ = what;
    return problem_.empty();
  }

  void read_all() {
    std::string format;
    std::uint64_t version = 0;
    fact("format", format);
    fact("format_version", version);
    if (!check(format == kEnsembleFormat, "it is no ensemble") ||
        !check(version == kEnsembleFormatVersion,
               fmt::format("its format is {}, not {}", version, kEnsembleFormatVersion)))
      return;
    for_each_fact(result_.facts, [&](const char* name, auto& value) { fact(name, value); });
    for_each_list(result_.facts, [&](const char* name, auto& entries) { list(name, entries); });
    if (!problem_.empty()) return;
    check_facts();
    read_shard_of_it();
    if (problem_.empty()) read_rows();
    if (problem_.empty()) read_half_step();
  }

  template <class Value>
  void fact(const char* name, Value& value) {
    check(read_attribute(file_, name, value), fmt::format("it has no '{}'", name));
    check_value(name, value);
  }

  void check_value(const std::string& name, const std::string& value) {
    check(printable(value) == value && value.find('\n') == std::string::npos,
          fmt::format("'{}' cannot be printed", printable(name)));
  }
  void check_value(const std::string& name, double value) {
    check(std::isfinite(value), fmt::format("'{}' is not finite", printable(name)));
  }
  void check_value(const std::string&, std::uint64_t) {}

  template <class Value>
  void list(const char* name, std::vector<std::pair<std::string, Value>>& entries) {
    const Hdf5Object group = open_group(file_, name);
    const auto names = group ? attributes_of(group) : std::nullopt;
    if (!check(names.has_value(), fmt::format("it has no '{}'", name))) return;
    for (const std::string& entry : *names) {
      Value value{};
      check(read_attribute(group, entry, value), fmt::format("an entry of '{}' is no such value", name));
      check_value(entry, entry);
      check_value(entry, value);
      entries.emplace_back(entry, value);
    }
  }

  void check_facts() {
    const EnsembleFacts& facts = result_.facts;
    check(facts.real == "double" || facts.real == "float", "its number type is not known");
    check(facts.step > 0 && facts.steps > 0 && facts.accuracy > 0,
          "its step or its accuracy is not positive");
    check(facts.states > 0 && facts.states <= kMostStates,
          fmt::format("it is of {} states, not of 1 to {}", facts.states, kMostStates));
  }

  void read_shard_of_it() {
    std::string word;
    Shard& shard = result_.shard;
    fact("shard", word);
    fact("begin", shard.begin);
    fact("end", shard.end);
    if (!problem_.empty()) return;
    const std::optional<Shard> part = read_shard(word, result_.facts.states);
    if (!check(part && part->begin == shard.begin && part->end == shard.end,
               fmt::format("states {} to {} are no shard {}", shard.begin, shard.end, word)))
      return;
    shard = *part;
  }

  /// The state's numbers and the flags of a group whose columns have so many values.
  void read_frame(const Hdf5Object& group, std::uint64_t count, std::vector<std::uint8_t>& trusted) {
    std::vector<std::uint64_t> states;
    check(read_column(group, kState, count, states) && states == state_numbers(result_.shard.begin, count),
          "its states are not those of its shard");
    check(read_column(group, kTrusted, count, trusted) &&
              std::all_of(trusted.begin(), trusted.end(), [](std::uint8_t flag) { return flag <= 1; }),
          "'trusted' is not 0 or 1 for each state");
  }

  std::vector<double> read_values(const Hdf5Object& group, const EnsembleColumn& column,
                                  const std::vector<std::uint8_t>& trusted) {
    std::vector<double> values;
    const std::string name = printable(column.name);
    if (!check(read_column(group, column.name, trusted.size(), values),
               fmt::format("column '{}' has no double for each state", name)))
      return values;
    bool is_sound = true;
    for (std::size_t k = 0; k < values.size(); ++k) is_sound &= !trusted[k] || std::isfinite(values[k]);
    check(is_sound, fmt::format("column '{}' is not finite where it is trusted", name));
    return values;
  }

  EnsembleColumn read_description(const Hdf5Object& group, const std::string& name) {
    EnsembleColumn column{name, "", false};
    std::string kind;
    const Hdf5Object of = open_column(group, name);
    check(of && read_attribute(of, "unit", column.unit) && read_attribute(of, "kind", kind) &&
              (kind == "drawn" || kind == "end"),
          fmt::format("column '{}' has no unit or kind", printable(name)));
    column.is_drawn = kind == "drawn";
    check_value(name, name);
    check_value(name, column.unit);
    return column;
  }

  /// Descriptions of all columns between the state and the flags.
  std::vector<EnsembleColumn> read_descriptions(const Hdf5Object& group) {
    std::vector<EnsembleColumn> columns;
    const auto names = group ? names_in(group) : std::nullopt;
    if (!check(names && names->size() > 2 && names->front() == kState && names->back() == kTrusted,
               "it has no columns from 'state' to 'trusted'"))
      return columns;
    for (std::size_t i = 1; i + 1 < names->size(); ++i)
      columns.push_back(read_description(group, (*names)[i]));
    return columns;
  }

  void read_rows() {
    const Hdf5Object group = open_group(file_, kRows);
    result_.columns = read_descriptions(group);
    if (!problem_.empty()) return;
    const auto& columns = result_.columns;
    check(std::is_partitioned(columns.begin(), columns.end(), [](const auto& c) { return c.is_drawn; }) &&
              result_.drawn_count() == result_.facts.spreads.size() && !columns.back().is_drawn,
          "its drawn columns are not those of its spreads");
    read_frame(group, result_.shard.size(), result_.trusted);
    for (std::size_t i = 0; problem_.empty() && i < columns.size(); ++i)
      read_values(group, columns[i], result_.trusted);
  }

  void read_half_step() {
    const Hdf5Object group = open_group(file_, kHalfStep);
    const std::vector<EnsembleColumn> columns = read_descriptions(group);
    const auto ends = result_.columns.begin() + static_cast<std::ptrdiff_t>(result_.drawn_count());
    check(std::equal(columns.begin(), columns.end(), ends, result_.columns.end()),
          "its ends with half the step are of other columns");
    if (!problem_.empty()) return;
    read_frame(group, judged_count(result_.shard), result_.halved.trusted);
    for (std::size_t i = 0; problem_.empty() && i < columns.size(); ++i)
      result_.halved.columns.push_back(read_values(group, columns[i], result_.halved.trusted));
  }

  Hdf5Object file_;
  EnsembleResult result_;
  std::string problem_;
};

}  // namespace

std::optional<EnsembleResult> read_ensemble_file(const std::string& path, std::string& problem) {
  problem = broken_seal(path);
  if (!problem.empty()) return {};
  Reader reader(path);
  problem = reader.problem();
  if (!problem.empty()) return {};
  EnsembleResult result = reader.take();
  result.values = [path, columns = result.columns, count = result.shard.size()](std::size_t i) {
    const Hdf5Object file = open_hdf5_file(path);
    std::vector<double> values;
    if (!file || !read_column(open_group(file, kRows), columns[i].name, count, values))
      throw support::EnvironmentError(path + ": cannot be read any more");
    return values;
  };
  return result;
}

}  // namespace jourdain::commands
