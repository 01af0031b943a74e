#include "fuzz/verdict.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <string_view>

#include "support/files.hpp"
#include "support/utf8.hpp"

namespace jourdain::tests {

namespace {

namespace fs = std::filesystem;

std::string first_line_with(const std::string& text, const std::string& part) {
  const std::size_t at = text.find(part);
  if (at == std::string::npos) return text.substr(0, text.find('\n'));
  const std::size_t begin = text.rfind('\n', at) + 1;
  return text.substr(begin, text.find('\n', begin) - begin);
}

/// Without numbers and quoted names, at most 160 characters.
std::string essence(const std::string& text) {
  std::string found;
  for (std::size_t i = 0; i < text.size() && found.size() < 160; ++i) {
    const std::size_t quote = text[i] == '\'' ? text.find('\'', i + 1) : std::string::npos;
    if (quote != std::string::npos) {
      found += "'…'";
      i = quote;
    } else if (text[i] >= '0' && text[i] <= '9') {
      if (!found.ends_with('#')) found += '#';
    } else {
      found += text[i] == '\t' ? ' ' : text[i];
    }
  }
  return found;
}

/// "…model.toml:12:3"
bool is_place(std::string_view text) {
  for (int i = 0; i < 2; ++i) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string_view::npos || colon + 1 == text.size() ||
        text.find_first_not_of("0123456789", colon + 1) != std::string_view::npos)
      return false;
    text = text.substr(0, colon);
  }
  return text.ends_with(".toml") || text.ends_with(".urdf") || text.ends_with(".xml") ||
         text.ends_with(".csv");
}

bool is_placed(const std::string& errors) {
  const std::string mark = ": error: ";
  for (std::size_t at = errors.find(mark); at != std::string::npos; at = errors.find(mark, at + 1)) {
    const std::size_t newline = errors.rfind('\n', at),
                      begin = newline == std::string::npos ? 0 : newline + 1;
    if (is_place(std::string_view(errors).substr(begin, at - begin))) return true;
  }
  return false;
}

/// The file as a whole is what is wrong.
bool is_of_whole_file(const std::string& errors) {
  return errors.find("error: the file is empty") != std::string::npos ||
         errors.find("error: the file has no rows") != std::string::npos ||
         errors.find(" bytes, more than the ") != std::string::npos;
}

/// Text that a terminal can show.
bool is_printable(const std::string& text) {
  for (std::size_t i = 0; i < text.size();) {
    const support::Utf8Character character = support::utf8_at(text, i);
    const bool blank = text[i] == '\n' || text[i] == '\t' || text[i] == '\r';
    if (!character.printable && !blank) return false;
    i += character.bytes;
  }
  return true;
}

std::string temporary_left(const std::string& folder) {
  for (const auto& entry : fs::directory_iterator(fs::path(folder) / "tmp"))
    return "temporary " + entry.path().filename().string().substr(0, std::string("jourdain-").size());
  return "";
}

/// What lies in the case's folder beside its own files, and in the temporary one; "" where nothing does.
std::string left_behind(const Case& tried, const std::string& folder) {
  for (const auto& entry : fs::directory_iterator(fs::path(folder) / "case")) {
    const std::string name = entry.path().filename().string();
    const auto is_it = [&](const support::FileText& file) { return file.name == name; };
    if (std::none_of(tried.files.begin(), tried.files.end(), is_it)) return name;
  }
  return temporary_left(folder);
}

/// What is wrong with what `compile` has written; "" where nothing is.
std::string written_badly(const ChildResult& result, const std::string& folder) {
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(folder) / "case" / "out")) {
    const std::string text = support::read_file(entry.path().string());
    if (text.empty()) return "an empty file";
    if (entry.path().extension() == ".json" && !nlohmann::json::accept(text))
      return "the manifest is no JSON";
    ++files;
  }
  if (files != 4) return fmt::format("{} files", files);
  return result.output.find("read back from the files:") == std::string::npos ? "not read back" : "";
}

Verdict judge_success(const Case& tried, const ChildResult& result, const std::string& folder) {
  if (const std::string left = temporary_left(folder); !left.empty())
    return {Outcome::kUntidy, "left behind: " + left};
  if (tried.kind == CaseKind::kOptions) return {};
  const std::string wrong = written_badly(result, folder);
  return wrong.empty() ? Verdict{} : Verdict{Outcome::kUntidy, wrong};
}

Verdict judge_refusal(const Case& tried, const ChildResult& result, const std::string& folder) {
  const std::string message = essence(first_line_with(result.errors, "error: "));
  if (tried.must_pass) return {Outcome::kValidRefused, message};
  if (result.errors.find("error: ") == std::string::npos) return {Outcome::kUnplaced, "says nothing"};
  const bool options = tried.kind == CaseKind::kOptions;
  if (const std::string left = left_behind(tried, folder); !left.empty() && !options)
    return {Outcome::kUntidy, "left behind: " + left};
  if (!is_printable(result.errors)) return {Outcome::kUntidy, "a message with control characters"};
  if (is_placed(result.errors)) return {Outcome::kRefused, ""};
  if (options || is_of_whole_file(result.errors)) return {Outcome::kRefusedWhole, ""};
  return {Outcome::kUnplaced, message};
}

Verdict judge_usage(const Case& tried, const ChildResult& result) {
  const std::string message = essence(result.errors.substr(0, result.errors.find('\n')));
  if (tried.kind != CaseKind::kOptions)
    return {Outcome::kInternal, fmt::format("status {}: {}", result.status, message)};
  if (result.errors.empty() && result.output.empty()) return {Outcome::kUntidy, "refused without a word"};
  return is_printable(result.errors) ? Verdict{Outcome::kUsage, ""}
                                     : Verdict{Outcome::kUntidy, "a usage message with control characters"};
}

}  // namespace

std::string_view outcome_name(Outcome outcome) {
  static constexpr std::array<std::string_view, kOutcomes> kNames = {
      "done", "refused", "whole",    "usage",         "internal", "signal",
      "slow", "large",   "unplaced", "valid refused", "untidy",   "not compiled"};
  return kNames[static_cast<std::size_t>(outcome)];
}

bool is_failure(Outcome outcome) { return outcome > Outcome::kUsage; }

Verdict judge(const Case& tried, const ChildResult& result, const std::string& folder) {
  constexpr int kSanitizer = 99;
  if (result.too_slow) return {Outcome::kTooSlow, tried.arguments[0]};
  if (result.too_large) return {Outcome::kTooLarge, tried.arguments[0]};
  if (result.status > 128) return {Outcome::kSignal, strsignal(result.status - 128)};
  if (result.status == kSanitizer)
    return {Outcome::kSignal, essence(first_line_with(result.errors, "ERROR: "))};
  switch (result.status) {
    case 0:
      return judge_success(tried, result, folder);
    case 1:
      return judge_refusal(tried, result, folder);
    case 2:
    case 3:
      return judge_usage(tried, result);
    default:
      return {Outcome::kInternal, essence(first_line_with(result.errors, "error: "))};
  }
}

}  // namespace jourdain::tests
