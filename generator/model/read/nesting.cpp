#include "model/read/nesting.hpp"

namespace jourdain::model {

namespace {

constexpr auto npos = std::string_view::npos;

std::size_t after(std::string_view text, std::string_view what, std::size_t from) {
  const std::size_t found = text.find(what, from);
  return found == npos ? text.size() : found + what.size();
}

/// Behind the TOML string whose quote stands at `begin`. Strings on one line end with the line at the latest.
std::size_t after_toml_string(std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  const std::string_view triple = quote == '"' ? "\"\"\"" : "'''";
  const bool long_form = text.substr(begin, 3) == triple;
  for (std::size_t i = begin + (long_form ? 3 : 1); i < text.size(); ++i) {
    if (text[i] == '\\' && quote == '"')
      ++i;
    else if (long_form && text.substr(i, 3) == triple)
      return i + 3;
    else if (!long_form && (text[i] == quote || text[i] == '\n'))
      return i + 1;
  }
  return text.size();
}

/// Behind the start tag at `begin`; '>' may stand in quoted values.
std::size_t after_tag(std::string_view text, std::size_t begin) {
  for (std::size_t i = begin; i < text.size(); ++i) {
    if (text[i] == '>') return i + 1;
    if (text[i] == '"' || text[i] == '\'') i = after(text, text.substr(i, 1), i + 1) - 1;
  }
  return text.size();
}

}  // namespace

std::optional<std::size_t> deep_toml_nesting(std::string_view text) {
  int depth = 0;
  int dots = 0;  // of one dotted key; numbers have one at most
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      i = after_toml_string(text, i);
      continue;
    }
    if (c == '#') {
      i = text.find('\n', i);
      if (i == npos) break;
      continue;
    }
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (c == '.') ++dots;
    if (std::string_view("[]{}=,\n").find(c) != npos) dots = 0;
    if (depth > kMaximumNesting || dots > kMaximumNesting) return i;
    ++i;
  }
  return {};
}

XmlTags scan_xml_tags(std::string_view text) {
  XmlTags tags;
  int depth = 0;
  for (std::size_t i = text.find('<'); i != npos; i = text.find('<', i)) {
    const std::string_view rest = text.substr(i);
    if (rest.starts_with("<!--")) {
      i = after(text, "-->", i + 4);
    } else if (rest.starts_with("<![CDATA[")) {
      i = after(text, "]]>", i);
    } else if (rest.starts_with("<?")) {
      i = after(text, "?>", i);
    } else if (rest.starts_with("<!")) {
      i = after(text, ">", i);
    } else if (rest.starts_with("</")) {
      --depth;
      i = after(text, ">", i);
    } else {
      const std::size_t end = after_tag(text, i);
      const bool closed = end >= 2 && text[end - 1] == '>' && text[end - 2] == '/';
      tags.starts.push_back(i);
      if (depth + 1 > kMaximumNesting) {
        tags.deep_nesting = i;
        return tags;
      }
      if (!closed) ++depth;
      i = end;
    }
  }
  return tags;
}

}  // namespace jourdain::model
