#include "model/read/import_file.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "support/check.hpp"
#include "support/files.hpp"

namespace jourdain::model {

namespace {

using support::shown;

constexpr int kDeepest = 8;

/// Empty: nothing is in the way.
std::string why_unreadable(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) return "there is no such file";
  if (error) return error.message();
  if (std::filesystem::is_directory(status)) return "it is a folder";
  return std::filesystem::is_regular_file(status) ? "" : "it is no regular file";
}

/// Of the file itself: not of its text.
void check_chain(const std::string& name, const ImportChain& chain, FoundFile& found) {
  int depth = 0;
  for (const ImportChain* outer = &chain; outer; outer = outer->outer, ++depth) {
    if (outer->path != found.chain.path) continue;
    found.problem = fmt::format("'{}' imports itself", shown(name));
    if (depth > 0) found.hint = "it is being read: it imports this file, or one that does";
    return;
  }
  if (depth > kDeepest)
    found.problem = fmt::format("files import each other deeper than {} levels", kDeepest);
  else if (chain.budget->files == 0)
    found.problem = "too many files are imported: no more than 100 are read";
}

}  // namespace

std::string canonical_path(const std::string& path) {
  std::error_code error;
  const std::filesystem::path found = std::filesystem::weakly_canonical(path, error);
  return error ? path : found.string();
}

FoundFile find_import(const std::string& name, const std::string& importing, const ImportChain& chain) {
  FoundFile found;
  found.path = (std::filesystem::path(importing).parent_path() / name).lexically_normal().string();
  found.chain = {canonical_path(found.path), &chain, chain.budget};
  check_chain(name, chain, found);
  if (!found.problem.empty()) return found;
  const std::string why = why_unreadable(found.path);
  if (!why.empty()) {
    found.problem = fmt::format("'{}' cannot be read: {}", shown(name), why);
    return found;
  }
  try {
    found.text = support::read_file(found.path);
  } catch (const support::EnvironmentError& failure) {
    found.problem = shown(failure.what());
  }
  --chain.budget->files;
  if (found.text.size() > chain.budget->bytes)
    found.problem =
        fmt::format("with '{}' more than {} bytes are imported", shown(name), ImportBudget().bytes);
  else
    chain.budget->bytes -= found.text.size();
  return found;
}

}  // namespace jourdain::model
