#include <fstream>

#include "commands/content_hash.hpp"
#include "commands/ensemble_file.hpp"
#include "commands/ensemble_file_layout.hpp"
#include "commands/hdf5_object.hpp"
#include "support/check.hpp"
#include "support/files.hpp"

namespace jourdain::commands {

namespace {

void write_facts(const Hdf5Object& file, const EnsembleResult& result) {
  write_attribute(file, "format", std::string(kEnsembleFormat));
  write_attribute(file, "format_version", kEnsembleFormatVersion);
  for_each_fact(result.facts,
                [&](const char* name, const auto& value) { write_attribute(file, name, value); });
  write_attribute(file, "shard", result.shard.text());
  write_attribute(file, "begin", result.shard.begin);
  write_attribute(file, "end", result.shard.end);
  for_each_list(result.facts, [&](const char* name, const auto& list) {
    const Hdf5Object group = make_group(file, name);
    for (const auto& [entry, value] : list) write_attribute(group, entry, value);
  });
}

void write_column(const Hdf5Object& group, const EnsembleColumn& column, const std::vector<double>& values) {
  const Hdf5Object made = make_column(group, column.name, values);
  write_attribute(made, "unit", column.unit);
  write_attribute(made, "kind", std::string(column.is_drawn ? "drawn" : "end"));
}

void write_rows(const Hdf5Object& file, const EnsembleResult& result) {
  const Hdf5Object rows = make_group(file, kRows);
  make_column(rows, kState, state_numbers(result.shard.begin, result.shard.size()));
  for (std::size_t i = 0; i < result.columns.size(); ++i)
    write_column(rows, result.columns[i], result.values(i));
  make_column(rows, kTrusted, result.trusted);
}

void write_half_step(const Hdf5Object& file, const EnsembleResult& result) {
  const Hdf5Object group = make_group(file, kHalfStep);
  make_column(group, kState, state_numbers(result.shard.begin, judged_count(result.shard)));
  const std::size_t drawn = result.drawn_count();
  for (std::size_t i = drawn; i < result.columns.size(); ++i)
    write_column(group, result.columns[i], result.halved.columns[i - drawn]);
  make_column(group, kTrusted, result.halved.trusted);
}

/// Puts the hash of what is behind the head into it.
void seal(const std::string& path) {
  const std::string head = head_of(sha256_of_file(path, kHead));
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  file.write(head.data(), static_cast<std::streamsize>(head.size()));
  file.close();
  if (!file) throw support::EnvironmentError(path + ": cannot be written");
}

}  // namespace

bool is_ensemble_file(const std::string& path) { return path.ends_with(".h5"); }

void write_ensemble_file(const std::string& path, const EnsembleResult& result) {
  support::write_file_by(path, [&](const std::string& temporary) {
    try {
      const Hdf5Object file = make_hdf5_file(temporary, kHead);
      write_facts(file, result);
      write_rows(file, result);
      write_half_step(file, result);
      flush_hdf5_file(file);
    } catch (const Hdf5Failure&) {
      throw support::EnvironmentError(path + ": cannot be written by HDF5; is there room for it?");
    }
    seal(temporary);
  });
}

}  // namespace jourdain::commands
