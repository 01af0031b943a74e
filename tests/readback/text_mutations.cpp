#include "readback/text_mutations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <optional>
#include <random>
#include <set>

namespace jourdain::tests {

namespace {

struct Piece {
  enum Kind { kName, kInteger, kFloating, kString, kPunctuation, kComment } kind;
  std::size_t at, length;
};

bool is_word(char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)); }

std::size_t number_end(const std::string& text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && (is_word(text[end]) || text[end] == '.' ||
                               ((text[end] == '-' || text[end] == '+') && (text[end - 1] == 'e'))))
    ++end;
  return end;
}

std::vector<Piece> pieces_of(const std::string& text) {
  std::vector<Piece> pieces;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at + 1;
    Piece::Kind kind = Piece::kPunctuation;
    if (std::isspace(static_cast<unsigned char>(text[at]))) {
      at = end;
      continue;
    }
    if (text.compare(at, 2, "//") == 0) {
      kind = Piece::kComment;
      end = std::min(text.find('\n', at), text.size());
    } else if (text.compare(at, 2, "/*") == 0) {
      kind = Piece::kComment;
      end = std::min(text.find("*/", at), text.size() - 2) + 2;
    } else if (text[at] == '"') {
      kind = Piece::kString;
      while (end < text.size() && text[end] != '"') end += text[end] == '\\' ? 2 : 1;
      ++end;
    } else if (std::isdigit(static_cast<unsigned char>(text[at]))) {
      end = number_end(text, at);
      kind = text.substr(at, end - at).find_first_of(".e") == std::string::npos ? Piece::kInteger
                                                                                : Piece::kFloating;
    } else if (is_word(text[at])) {
      kind = Piece::kName;
      while (end < text.size() && is_word(text[end])) ++end;
    } else {
      for (const char* two : {"++", "--", "->", "::", "<=", ">=", "==", "!=", "&&", "||"})
        if (text.compare(at, 2, two) == 0) end = at + 2;
    }
    pieces.push_back({kind, at, end - at});
    at = end;
  }
  return pieces;
}

class Mutator {
 public:
  explicit Mutator(const std::string& text) : text_(text), pieces_(pieces_of(text)) {}

  using Change = std::optional<TextMutant>;
  struct Operator {
    const char* name;
    Change (Mutator::*change)(std::size_t piece, std::mt19937_64& random) const;
  };
  static const std::vector<Operator>& operators();
  std::size_t size() const { return pieces_.size(); }
  int line(std::size_t at) const {
    return 1 + static_cast<int>(std::count(text_.begin(), text_.begin() + static_cast<long>(at), '\n'));
  }

 private:
  std::string piece(std::size_t i) const {
    return i < pieces_.size() ? text_.substr(pieces_[i].at, pieces_[i].length) : std::string();
  }
  bool is(std::size_t i, Piece::Kind kind) const { return i < pieces_.size() && pieces_[i].kind == kind; }
  Change replaced(std::size_t i, const std::string& by) const {
    return TextMutant{"", pieces_[i].at, pieces_[i].length, by, 0};
  }
  Change range(std::size_t begin, std::size_t end, const std::string& by) const {
    return TextMutant{"", begin, end - begin, by, 0};
  }
  std::size_t end_of(std::size_t i) const { return pieces_[i].at + pieces_[i].length; }

  Change one_of(std::size_t i, std::initializer_list<std::pair<const char*, const char*>> list) const {
    if (!is(i, Piece::kPunctuation)) return {};
    for (const auto& [from, to] : list)
      if (piece(i) == from) return replaced(i, to);
    return {};
  }
  bool is_operand_end(std::size_t i) const {
    return is(i, Piece::kName) || is(i, Piece::kInteger) || is(i, Piece::kFloating) || piece(i) == ")" ||
           piece(i) == "]";
  }

  Change flip_sum(std::size_t i, std::mt19937_64&) const {
    return i > 0 && is_operand_end(i - 1) ? one_of(i, {{"+", "-"}, {"-", "+"}}) : Change();
  }
  Change flip_product(std::size_t i, std::mt19937_64&) const { return one_of(i, {{"*", "/"}, {"/", "*"}}); }
  Change sum_to_product(std::size_t i, std::mt19937_64&) const { return one_of(i, {{"+", "*"}, {"*", "+"}}); }
  Change change_comparison(std::size_t i, std::mt19937_64&) const {
    return one_of(
        i, {{"<", "<="}, {">=", ">"}, {"<=", "<"}, {"==", "!="}, {"&&", "||"}, {"++", "--"}, {"--", "++"}});
  }

  Change drop_minus(std::size_t i, std::mt19937_64&) const {
    return piece(i) == "-" && i > 0 && !is_operand_end(i - 1) ? replaced(i, "") : Change();
  }
  Change insert_minus(std::size_t i, std::mt19937_64&) const {
    const bool begins =
        i > 0 && (is(i, Piece::kName) || piece(i) == "(") && (piece(i - 1) == "=" || piece(i - 1) == "(");
    return begins ? range(pieces_[i].at, pieces_[i].at, "-") : Change();
  }

  std::size_t closing(std::size_t i) const {
    int depth = 0;
    for (std::size_t k = i; k < pieces_.size(); ++k) {
      if (!is(k, Piece::kPunctuation)) continue;
      depth += piece(k) == "(" || piece(k) == "[";
      depth -= piece(k) == ")" || piece(k) == "]";
      if (depth == 0) return k;
    }
    return pieces_.size();
  }

  Change drop_parentheses(std::size_t i, std::mt19937_64&) const {
    if (piece(i) != "(" || i == 0 || is(i - 1, Piece::kName)) return {};
    const std::size_t close = closing(i);
    if (close >= pieces_.size()) return {};
    return range(pieces_[i].at, end_of(close), text_.substr(end_of(i), pieces_[close].at - end_of(i)));
  }

  /// Around the operands next to an operation.
  Change insert_parentheses(std::size_t i, std::mt19937_64&) const {
    static const std::set<std::string> operations = {"+", "-", "*", "/"};
    if (i == 0 || !operations.count(piece(i)) || !is(i, Piece::kPunctuation) || !is_operand_end(i - 1))
      return {};
    std::size_t first = i - 1;
    for (int depth = 0;; --first) {
      depth += piece(first) == ")" || piece(first) == "]";
      depth -= piece(first) == "(" || piece(first) == "[";
      const bool goes_on = depth > 0 || piece(first) == "." || piece(first) == "[" || piece(first) == "(" ||
                           (first > 0 && (piece(first - 1) == "." || piece(first - 1) == "::"));
      if (first == 0 || !goes_on || depth < 0) break;
    }
    std::size_t last = i + 1;
    while (last + 1 < pieces_.size() &&
           (piece(last + 1) == "." || piece(last + 1) == "[" || piece(last + 1) == "(" ||
            piece(last) == "." || piece(last) == "::" || piece(last + 1) == "::"))
      last = piece(last + 1) == "[" || piece(last + 1) == "(" ? closing(last + 1) : last + 1;
    if (last >= pieces_.size()) return {};
    const std::size_t begin = pieces_[first].at, end = end_of(last);
    return range(begin, end, "(" + text_.substr(begin, end - begin) + ")");
  }

  Change change_integer(std::size_t i, std::mt19937_64& random) const {
    if (!is(i, Piece::kInteger) || piece(i).size() > 9) return {};
    const long value = std::stol(piece(i));
    return replaced(i, std::to_string(value == 0 || random() % 2 ? value + 1 : value - 1));
  }
  Change change_index(std::size_t i, std::mt19937_64& random) const {
    return i > 0 && piece(i - 1) == "[" ? change_integer(i, random) : Change();
  }
  Change change_digit(std::size_t i, std::mt19937_64& random) const {
    return is(i, Piece::kFloating) ? digit(i, random() % piece(i).size(), random) : Change();
  }
  Change change_last_digit(std::size_t i, std::mt19937_64& random) const {
    if (!is(i, Piece::kFloating)) return {};
    const std::size_t e = std::min(piece(i).find('e'), piece(i).size());
    return digit(i, e - 1, random);
  }
  Change digit(std::size_t i, std::size_t k, std::mt19937_64& random) const {
    std::string number = piece(i);
    if (!std::isdigit(static_cast<unsigned char>(number[k]))) return {};
    number[k] = static_cast<char>('0' + (number[k] - '0' + 1 + static_cast<int>(random() % 9)) % 10);
    return replaced(i, number);
  }

  std::optional<std::size_t> other_name(std::size_t i, std::mt19937_64& random, std::size_t reach) const {
    if (!is(i, Piece::kName)) return {};
    const std::size_t low = i > reach ? i - reach : 0, high = std::min(i + reach, pieces_.size() - 1);
    for (int tries = 0; tries < 10; ++tries) {
      const std::size_t k = low + random() % (high - low + 1);
      if (is(k, Piece::kName) && piece(k) != piece(i)) return k;
    }
    return {};
  }
  Change replace_name(std::size_t i, std::mt19937_64& random) const {
    const auto k = other_name(i, random, 60);
    return k ? replaced(i, piece(*k)) : Change();
  }
  Change swap_names(std::size_t i, std::mt19937_64& random) const {
    const auto k = other_name(i, random, 12);
    if (!k) return {};
    const std::size_t a = std::min(i, *k), b = std::max(i, *k);
    return range(pieces_[a].at, end_of(b),
                 piece(b) + text_.substr(end_of(a), pieces_[b].at - end_of(a)) + piece(a));
  }
  /// x op y to y op x, of names and what belongs to them.
  Change swap_operands(std::size_t i, std::mt19937_64&) const {
    if (i == 0 || i + 1 >= pieces_.size() || !is(i, Piece::kPunctuation)) return {};
    const std::string op = piece(i);
    if ((op != "+" && op != "-" && op != "*" && op != "/") || !is(i - 1, Piece::kName) ||
        !is(i + 1, Piece::kName))
      return {};
    if (piece(i + 2) == "." || piece(i + 2) == "[" || piece(i + 2) == "(" || piece(i + 2) == "::" ||
        piece(i - 2) == ".")
      return {};
    return range(pieces_[i - 1].at, end_of(i + 1), piece(i + 1) + " " + op + " " + piece(i - 1));
  }

  /// From after the last ';', '{' or '}' to the next ';', where `i` begins a statement.
  std::optional<std::size_t> statement_end(std::size_t i) const {
    if (i >= pieces_.size() || is(i, Piece::kComment) || (is(i, Piece::kPunctuation) && piece(i) != "("))
      return {};
    if (i > 0 && !is(i - 1, Piece::kComment) && piece(i - 1) != ";" && piece(i - 1) != "{" &&
        piece(i - 1) != "}")
      return {};
    for (std::size_t k = i; k < std::min(i + 400, pieces_.size()); ++k) {
      if (piece(k) == "{" || piece(k) == "}") return {};
      if (piece(k) == ";") return k;
    }
    return {};
  }
  std::string statement(std::size_t i, std::size_t end) const {
    return text_.substr(pieces_[i].at, end_of(end) - pieces_[i].at);
  }
  Change delete_statement(std::size_t i, std::mt19937_64&) const {
    const auto end = statement_end(i);
    return end ? range(pieces_[i].at, end_of(*end), "") : Change();
  }
  Change duplicate_statement(std::size_t i, std::mt19937_64&) const {
    const auto end = statement_end(i);
    return end ? range(pieces_[i].at, end_of(*end), statement(i, *end) + " " + statement(i, *end)) : Change();
  }
  Change swap_statements(std::size_t i, std::mt19937_64&) const {
    const auto first = statement_end(i);
    if (!first) return {};
    const auto second = statement_end(*first + 1);
    if (!second) return {};
    return range(pieces_[i].at, end_of(*second),
                 statement(*first + 1, *second) + "\n" + statement(i, *first));
  }

  Change change_string(std::size_t i, std::mt19937_64& random) const {
    std::string text = piece(i);
    if (!is(i, Piece::kString) || text.size() < 3) return {};
    const std::size_t k = 1 + random() % (text.size() - 2);
    text[k] = text[k] == 'q' ? 'r' : 'q';
    return replaced(i, text);
  }
  Change drop_string(std::size_t i, std::mt19937_64&) const {
    return is(i, Piece::kString) && piece(i + 1) == "," ? range(pieces_[i].at, end_of(i + 1), "") : Change();
  }
  Change drop_word(std::size_t i, std::mt19937_64&) const {
    static const std::set<std::string> words = {"const",     "noexcept", "inline",  "static",
                                                "constexpr", "explicit", "template"};
    return is(i, Piece::kName) && words.count(piece(i)) ? replaced(i, "") : Change();
  }
  Change drop_punctuation(std::size_t i, std::mt19937_64&) const {
    return is(i, Piece::kPunctuation) ? replaced(i, "") : Change();
  }
  Change change_count_in_comment(std::size_t i, std::mt19937_64& random) const {
    std::string text = piece(i);
    if (!is(i, Piece::kComment) || text.find(" operations") == std::string::npos) return {};
    std::vector<std::size_t> digits;
    for (std::size_t k = 0; k < text.size(); ++k)
      if (std::isdigit(static_cast<unsigned char>(text[k]))) digits.push_back(k);
    if (digits.empty()) return {};
    char& digit = text[digits[random() % digits.size()]];
    digit = digit == '9' ? '8' : static_cast<char>(digit + 1);
    return replaced(i, text);
  }
  Change append_to_comment(std::size_t i, std::mt19937_64&) const {
    return is(i, Piece::kComment) ? range(end_of(i), end_of(i), " x") : Change();
  }
  Change insert_space(std::size_t i, std::mt19937_64&) const {
    return is(i, Piece::kName) || is(i, Piece::kString) ? range(end_of(i), end_of(i), " ") : Change();
  }

  const std::string& text_;
  std::vector<Piece> pieces_;
};

const std::vector<Mutator::Operator>& Mutator::operators() {
  static const std::vector<Operator> list = {{"flip_sum", &Mutator::flip_sum},
                                             {"flip_product", &Mutator::flip_product},
                                             {"sum_to_product", &Mutator::sum_to_product},
                                             {"change_comparison", &Mutator::change_comparison},
                                             {"drop_minus", &Mutator::drop_minus},
                                             {"insert_minus", &Mutator::insert_minus},
                                             {"drop_parentheses", &Mutator::drop_parentheses},
                                             {"insert_parentheses", &Mutator::insert_parentheses},
                                             {"change_integer", &Mutator::change_integer},
                                             {"change_index", &Mutator::change_index},
                                             {"change_digit", &Mutator::change_digit},
                                             {"change_last_digit", &Mutator::change_last_digit},
                                             {"replace_name", &Mutator::replace_name},
                                             {"swap_names", &Mutator::swap_names},
                                             {"swap_operands", &Mutator::swap_operands},
                                             {"delete_statement", &Mutator::delete_statement},
                                             {"duplicate_statement", &Mutator::duplicate_statement},
                                             {"swap_statements", &Mutator::swap_statements},
                                             {"change_string", &Mutator::change_string},
                                             {"drop_string", &Mutator::drop_string},
                                             {"drop_word", &Mutator::drop_word},
                                             {"drop_punctuation", &Mutator::drop_punctuation},
                                             {"change_count_in_comment", &Mutator::change_count_in_comment},
                                             {"append_to_comment", &Mutator::append_to_comment},
                                             {"insert_space", &Mutator::insert_space}};
  return list;
}

}  // namespace

std::string TextMutant::applied_to(const std::string& text) const {
  return text.substr(0, at) + replacement + text.substr(at + length);
}

std::string TextMutant::describe(const std::string& text) const {
  return fmt::format("{} in line {}: '{}' became '{}'", operation, line, text.substr(at, length),
                     replacement);
}

std::vector<std::string> text_operators() {
  std::vector<std::string> names;
  for (const Mutator::Operator& operation : Mutator::operators()) names.emplace_back(operation.name);
  return names;
}

std::vector<TextMutant> text_mutants(const std::string& text, std::uint64_t seed,
                                     std::size_t count_per_operator) {
  const Mutator mutator(text);
  std::vector<TextMutant> mutants;
  for (const Mutator::Operator& operation : Mutator::operators()) {
    std::mt19937_64 random(seed++);
    std::vector<std::size_t> sites;
    for (std::size_t i = 0; i < mutator.size(); ++i)
      if ((mutator.*operation.change)(i, random)) sites.push_back(i);
    std::shuffle(sites.begin(), sites.end(), random);
    std::size_t made = 0;
    for (const std::size_t site : sites) {
      if (made == count_per_operator) break;
      std::optional<TextMutant> mutant = (mutator.*operation.change)(site, random);
      if (!mutant || mutant->replacement == text.substr(mutant->at, mutant->length)) continue;
      mutant->operation = operation.name;
      mutant->line = mutator.line(mutant->at);
      mutants.push_back(*mutant);
      ++made;
    }
  }
  return mutants;
}

bool changes_only_space_or_comments(const std::string& text, const std::string& mutant) {
  const auto tokens = [](const std::string& of) {
    std::vector<std::string> list;
    for (const Piece& piece : pieces_of(of))
      if (piece.kind != Piece::kComment) list.push_back(of.substr(piece.at, piece.length));
    return list;
  };
  return tokens(text) == tokens(mutant);
}

}  // namespace jourdain::tests
