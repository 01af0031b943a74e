#include "mutants/text_mutants.hpp"

#include <algorithm>
#include <cctype>
#include <set>

#include "properties/random.hpp"

namespace jourdain::tests {

using support::FileText;

namespace {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)); }
bool is_letter(char c) { return is_word(c) && !is_digit(c); }

std::size_t line_begin(const std::string& text, std::size_t at) {
  const std::size_t end = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  return end == std::string::npos ? 0 : end + 1;
}
std::size_t line_end(const std::string& text, std::size_t at) {
  const std::size_t end = text.find('\n', at);
  return end == std::string::npos ? text.size() : end;
}

/// For each character whether a compiler (or a reader of JSON) looks at it.
std::vector<bool> code_of(const std::string& text) {
  std::vector<bool> code(text.size(), true);
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = line_end(text, begin), first = text.find_first_not_of(' ', begin);
    std::size_t from = end;
    if (first < end && text[first] == '#')
      from = begin;
    else if (const std::size_t comment = text.find("//", begin); comment < end)
      from = comment;
    for (std::size_t i = from; i < end; ++i) code[i] = false;
    begin = end + 1;
  }
  return code;
}

/// Is the character within quotation marks of its line?
bool is_quoted(const std::string& text, std::size_t at) {
  bool quoted = false;
  for (std::size_t i = line_begin(text, at); i < at; ++i) quoted ^= text[i] == '"';
  return quoted;
}

/// The name that starts at `at`.
std::string word_at(const std::string& text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && is_word(text[end])) ++end;
  return text.substr(at, end - at);
}

bool starts_word(const std::string& text, std::size_t at) {
  return is_letter(text[at]) && (at == 0 || !is_word(text[at - 1]));
}

/// The parenthesis that closes the one at `at`.
std::size_t closing(const std::string& text, std::size_t at) {
  int depth = 0;
  for (std::size_t i = at; i < text.size(); ++i) {
    depth += text[i] == '(';
    depth -= text[i] == ')';
    if (depth == 0) return i;
  }
  return std::string::npos;
}

/// Do the parentheses that open at `at` hold nothing but factors?
bool is_product(const std::string& text, std::size_t at) {
  const std::string inside = text.substr(at, closing(text, at) - at);
  return std::none_of(inside.begin(), inside.end(),
                      [](char c) { return std::string("+-/,?<>=&|").find(c) != std::string::npos; });
}

/// Nothing, or a comment.
bool is_blank(const std::string& text, std::size_t begin) {
  const std::size_t first = text.find_first_not_of(' ', begin);
  return first == std::string::npos || text[first] == '\n' || text.compare(first, 2, "//") == 0;
}

/// A string without blanks is a name; sentences are for people.
bool is_name(const std::string& text, std::size_t at) {
  const std::size_t begin = text.rfind('"', at), end = text.find('"', at);
  return text.substr(begin, end - begin).find(' ') == std::string::npos;
}

/// Does the line at `begin` declare a value that the next one names?
bool is_needed_next(const std::string& text, std::size_t begin) {
  const std::string declares = "const Real ";
  const std::size_t first = text.find_first_not_of(' ', begin), end = line_end(text, begin);
  if (text.compare(first, declares.size(), declares) != 0 || text[end - 1] != ';') return false;
  const std::string name = word_at(text, first + declares.size());
  for (std::size_t i = end + 1; i < line_end(text, end + 1); ++i)
    if (starts_word(text, i) && word_at(text, i) == name) return true;
  return false;
}

bool fits(const std::string& text, std::size_t i, TextFault fault) {
  const auto is = [&](const char* pattern) {
    return text.compare(i, std::char_traits<char>::length(pattern), pattern) == 0;
  };
  switch (fault) {
    case TextFault::kSum:
      return is(" + ") || is(" - ");
    case TextFault::kProduct:
      return is(" * ") || is(" / ");
    case TextFault::kParentheses:
      return text[i] == '(' && i > 0 && std::string(" (-!").find(text[i - 1]) != std::string::npos;
    case TextFault::kNegative:
      return is(" = ") && text[i + 3] != '{' && text[i + 3] != '"';
    case TextFault::kIndex:
      return text[i] == '[' && is_digit(text[i + 1]);
    case TextFault::kDigit:
      return is_digit(text[i]) && !is_quoted(text, i) &&
             (i == 0 || std::string(" (.,-[").find(text[i - 1]) != std::string::npos);
    case TextFault::kName:
      return starts_word(text, i) && !is_quoted(text, i);
    case TextFault::kSineCosine:
      return is("sine(") || is("cosine(") || is("sine_cosine(");
    case TextFault::kDropLine:
      return i == line_begin(text, i) && !is_blank(text, i);
    case TextFault::kSwapLines:
      return i == line_begin(text, i) && !is_blank(text, i) && is_needed_next(text, i);
    case TextFault::kQuoted:
      return is_letter(text[i]) && is_quoted(text, i) && is_name(text, i);
  }
  return false;
}

std::string other_name(const std::string& text, const std::string& name, Random& random) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (starts_word(text, i) && !is_quoted(text, i)) names.insert(word_at(text, i));
  names.erase(name);
  return *std::next(names.begin(), static_cast<long>(random.below(names.size())));
}

void plant(std::string& text, std::size_t i, TextFault fault, Random& random) {
  switch (fault) {
    case TextFault::kSum:
      text[i + 1] = text[i + 1] == '+' ? '-' : '+';
      break;
    case TextFault::kProduct:
      text[i + 1] = text[i + 1] == '*' ? '/' : '*';
      break;
    case TextFault::kParentheses:
      text.erase(closing(text, i), 1);
      text.erase(i, 1);
      break;
    case TextFault::kNegative:
      text.insert(i + 3, "-");
      break;
    case TextFault::kIndex: {
      const std::string digits = word_at(text, i + 1);
      text.replace(i + 1, digits.size(), std::to_string(std::stoul(digits) + 1));
      break;
    }
    case TextFault::kDigit:
      text[i] = static_cast<char>('0' + (text[i] - '0' + 1 + static_cast<int>(random.below(8))) % 10);
      break;
    case TextFault::kName: {
      const std::string name = word_at(text, i);
      text.replace(i, name.size(), other_name(text, name, random));
      break;
    }
    case TextFault::kSineCosine: {
      const std::string name = word_at(text, i);
      text.replace(i, name.size(), name == "sine" ? "cosine" : "sine");
      break;
    }
    case TextFault::kDropLine:
      text.erase(i, line_end(text, i) + 1 - i);
      break;
    case TextFault::kSwapLines: {
      const std::size_t middle = line_end(text, i) + 1,
                        end = std::min(line_end(text, middle) + 1, text.size());
      text = text.substr(0, i) + text.substr(middle, end - middle) + text.substr(i, middle - i) +
             text.substr(end);
      break;
    }
    case TextFault::kQuoted:
      text[i] = text[i] == 'q' ? 'k' : 'q';
      break;
  }
}

}  // namespace

const char* name_of(TextFault fault) {
  constexpr const char* kNames[kTextFaults] = {
      "sum <-> difference", "product <-> quotient", "parentheses dropped", "minus inserted",
      "subscript plus one", "another digit",        "another name",        "sine <-> cosine",
      "line dropped",       "lines swapped",        "letter of a string"};
  return kNames[static_cast<std::size_t>(fault)];
}

std::vector<TextSite> sites(const std::vector<FileText>& files, TextFault fault) {
  std::vector<TextSite> list;
  for (std::size_t f = 0; f < files.size(); ++f) {
    const std::vector<bool> code = code_of(files[f].text);
    for (std::size_t i = 0; i < files[f].text.size(); ++i)
      if (code[i] && fits(files[f].text, i, fault)) list.push_back({fault, f, i});
  }
  return list;
}

std::vector<FileText> planted(const std::vector<FileText>& files, const TextSite& site, std::uint64_t seed) {
  Random random(seed);
  std::vector<FileText> changed = files;
  plant(changed[site.file].text, site.offset, site.fault, random);
  return changed;
}

std::string same_because(const std::vector<FileText>& files, const TextSite& site) {
  const std::string& text = files[site.file].text;
  const std::size_t end = line_end(text, site.offset);
  const std::string line = text.substr(line_begin(text, site.offset), end - line_begin(text, site.offset));
  const auto is_in_line = [&line](const char* part) { return line.find(part) != std::string::npos; };
  if (site.fault == TextFault::kNegative) {
    const std::string value = text.substr(site.offset + 3, 9);
    if (value[0] == '0' || value == "Real(0.0)") return "minus zero is zero";
  }
  const bool instantiates = files[site.file].name.ends_with(".cpp");
  if (site.fault == TextFault::kName &&
      (instantiates || (line.compare(0, 9, "template ") == 0 && line.find('(') != std::string::npos)))
    if (const char before = text[site.offset - 1];
        before == '&' || text.compare(site.offset - 2, 2, "& ") == 0)
      return "names of parameters in a declaration";
  if (site.fault == TextFault::kParentheses && site.offset >= 2 &&
      text.compare(site.offset - 2, 2, "+ ") == 0)
    return "a sum in another order, the same but for rounding";
  if (site.fault == TextFault::kParentheses && site.offset >= 2 &&
      text.compare(site.offset - 2, 2, "* ") == 0 && is_product(text, site.offset))
    return "a product in another order, the same but for rounding";
  if (site.fault == TextFault::kDropLine && line.find("stage.state.z[i] = state.z[i];") != std::string::npos)
    return "stage.state is a copy of state";
  const bool of_number = site.fault == TextFault::kIndex || site.fault == TextFault::kDigit;
  if (of_number && (is_in_line("], sum_z[") || is_in_line("  Real y["))) return "a scratch array is longer";
  const bool of_coupled = is_in_line("W[i][k] =") || is_in_line("W[k][i] =") || is_in_line("[i][k] * c[k]") ||
                          is_in_line("[k][i] * c[i]") || is_in_line("coupled(p)") ||
                          is_in_line("coupled(q)") || is_in_line("first_coupled(k)");
  if (of_coupled &&
      text.find("int coupled(int k) noexcept {\n  static constexpr int list[] = {0};") != std::string::npos)
    return "velocities are not coupled, so it is never executed";
  if (site.fault == TextFault::kNegative && line.find("= first_coupled(k); ") != std::string::npos &&
      text.find("int first_coupled(int k) noexcept {\n  static constexpr int list[] = {0, 0, 1};") !=
          std::string::npos)
    return "minus zero is zero";
  return "";
}

std::string line_of(const std::vector<FileText>& files, const TextSite& site) {
  const std::string& text = files[site.file].text;
  const std::size_t begin = line_begin(text, site.offset);
  return files[site.file].name + ": " + text.substr(begin, line_end(text, site.offset) - begin);
}

}  // namespace jourdain::tests
