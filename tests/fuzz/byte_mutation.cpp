#include "fuzz/byte_mutation.hpp"

#include <algorithm>

#include "fuzz/hostile_values.hpp"

namespace jourdain::tests {

namespace {

std::string slice(const std::string& text, Random& random) {
  if (text.empty()) return "";
  const std::size_t begin = random.below(text.size());
  return text.substr(begin, 1 + random.below(random.chance(0.5) ? 8 : 200));
}

const std::string& odd_bytes(Random& random) {
  static const std::vector<std::string> kBytes = {std::string(1, '\0'),
                                                  "\xff",
                                                  "\xfe\xff",
                                                  "\xc0\x80",
                                                  "\xed\xa0\x80",
                                                  "\xf4\x90\x80\x80",
                                                  "\xe2\x82",
                                                  "\xef\xbb\xbf",
                                                  "\r",
                                                  "\r\n",
                                                  "\x7f",
                                                  "\x1b",
                                                  "\t",
                                                  "\n\n",
                                                  "\"",
                                                  "'''",
                                                  "\"\"\"",
                                                  "[",
                                                  "]",
                                                  "[[",
                                                  "]]",
                                                  "{",
                                                  "}",
                                                  "=",
                                                  "#",
                                                  "\\",
                                                  "\\u0000",
                                                  "\\uD800",
                                                  "<",
                                                  ">",
                                                  "</",
                                                  "/>",
                                                  "&",
                                                  "&#0;",
                                                  "&#x110000;",
                                                  "&lt;",
                                                  "<!--",
                                                  "-->",
                                                  "<![CDATA[",
                                                  "]]>",
                                                  "<?",
                                                  "<!DOCTYPE r [<!ENTITY a \"&a;&a;\">]>",
                                                  "&a;",
                                                  "-",
                                                  "+",
                                                  "e",
                                                  ".",
                                                  "9",
                                                  "0",
                                                  " ",
                                                  ",",
                                                  "^",
                                                  "*",
                                                  "(",
                                                  ")",
                                                  "\xc2\xa0"};
  return one_of(kBytes, random);
}

}  // namespace

std::string mutated_bytes(std::string text, const std::string& donor, Random& random) {
  if (text.empty()) return odd_bytes(random);
  const std::size_t at = random.below(text.size());
  switch (random.below(7)) {
    case 0:
      text[at] = static_cast<char>(text[at] ^ (1 << random.below(8)));
      return text;
    case 1:
      return text.erase(at, slice(text, random).size());
    case 2:
      return text.insert(at, slice(text, random));
    case 3:
      return text.insert(at, slice(donor, random));
    case 4:
      return random.chance(0.3) ? text.substr(0, at) : text.replace(at, 1, std::to_string(random.below(10)));
    case 5:
      return text.insert(at, odd_bytes(random));
    default:
      text[at] = static_cast<char>(random.chance(0.7) ? 0x20 + random.below(0x5f) : random.below(256));
      return text;
  }
}

}  // namespace jourdain::tests
