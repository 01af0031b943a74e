#include "commands/committed_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "commands/printable.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::commands {

namespace {

namespace fs = std::filesystem;

/// The manifest of a file; null where it is none.
nlohmann::json manifest_of(const fs::path& path) {
  nlohmann::json root = nlohmann::json::parse(support::read_file(path.string()), nullptr, false);
  const bool ours = root.is_object() && root.contains("generator") && root["generator"].is_string() &&
                    root["generator"].get<std::string>().starts_with("Jourdain ");
  return ours ? root : nlohmann::json();
}

std::vector<std::string> words_of(const nlohmann::json& manifest) {
  std::vector<std::string> words;
  if (manifest.contains("options") && manifest["options"].is_array())
    for (const nlohmann::json& word : manifest["options"])
      if (word.is_string()) words.push_back(word.get<std::string>());
  return words;
}

/// What a line holds from a little before `column` on, as it may stand in a message.
std::string part(std::string_view line, std::size_t column) {
  constexpr std::size_t kBefore = 20;
  const std::size_t from = column > kBefore ? column - kBefore : 0;
  return (from > 0 ? "..." : "") + support::shown(line.substr(std::min(from, line.size())));
}

std::string first_difference(const std::string& path, std::string_view there, std::string_view now) {
  const std::size_t at = static_cast<std::size_t>(
      std::mismatch(there.begin(), there.end(), now.begin(), now.end()).first - there.begin());
  const std::size_t last = there.substr(0, at).rfind('\n');
  const std::size_t begin = last == std::string_view::npos ? 0 : last + 1;
  const auto line = [begin, at](std::string_view text) -> std::string {
    if (begin >= text.size()) return "(the file ends)";
    return part(text.substr(begin, text.find('\n', begin) - begin), at - begin);
  };
  return fmt::format("{}:{}:{}: error: differs\n  there: {}\n  now:   {}\n", printable(path),
                     1 + std::count(there.begin(), there.begin() + static_cast<std::ptrdiff_t>(begin), '\n'),
                     at - begin + 1, line(there), line(now));
}

}  // namespace

std::vector<RecordedModel> recorded_models(const std::string& folder, const std::string& description,
                                           const std::string& name) {
  std::vector<RecordedModel> models;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() != ".json" || !entry.is_regular_file(error) ||
        (!name.empty() && stem != name))
      continue;
    const nlohmann::json manifest = manifest_of(entry.path());
    if (manifest.is_object() && manifest.value("model", nlohmann::json()) == description)
      models.push_back({stem, words_of(manifest)});
  }
  std::sort(models.begin(), models.end(),
            [](const RecordedModel& a, const RecordedModel& b) { return a.name < b.name; });
  return models;
}

std::vector<std::string> differences(const std::string& folder, const std::vector<support::FileText>& files) {
  std::vector<std::string> texts;
  for (const support::FileText& file : files) {
    const std::string path = (fs::path(folder) / file.name).generic_string();
    if (!fs::exists(path)) {
      texts.push_back(fmt::format("{}: error: missing\n", printable(path)));
      continue;
    }
    const std::string there = support::read_file(path);
    if (there != file.text) texts.push_back(first_difference(path, there, file.text));
  }
  return texts;
}

}  // namespace jourdain::commands
