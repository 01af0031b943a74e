// Constants that say where an entry of y, z or u stands.
#include <cctype>
#include <set>

#include "readback/header_check.hpp"

namespace jourdain::readback {

namespace {

/// ASCII letters and digits of the name; what is between them becomes one '_'.
std::string spelt(char letter, const std::string& name) {
  std::string text = {letter, '_'};
  for (const char c : name) {
    const bool stays = c > 0 && std::isalnum(static_cast<unsigned char>(c));
    if (stays || text.back() != '_') text += stays ? c : '_';
  }
  return text;
}

std::string text_of(const Unit& unit, const Constant& constant) {
  const Expression* value = constant.declarator.initial;
  const bool is_integer = value && value->kind == ExpressionKind::kInteger;
  return fmt::format(
      "{}{} {} = {}", constant.is_inline ? "inline " : "", text_of(unit, constant.type, constant.declarator),
      unit.symbols.text(constant.declarator.name), is_integer ? std::to_string(value->integer) : "?");
}

}  // namespace

std::vector<std::pair<std::string, std::size_t>> index_names(const Expected& expected) {
  std::vector<std::pair<std::string, std::size_t>> found;
  const auto add = [&found](char letter, const std::vector<std::string>& names) {
    std::set<std::string> taken;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::string plain = spelt(letter, names[i]);
      std::string name = plain;
      for (int k = 2; !taken.insert(name).second; ++k)
        name = plain + (plain.back() == '_' ? "" : "_") + std::to_string(k);
      found.emplace_back(name, i);
    }
  };
  add('y', expected.positions);
  add('z', expected.velocities);
  add('u', expected.inputs);
  return found;
}

void check_indices(const Unit& unit, const Expected& expected, Findings& findings) {
  std::vector<std::string> wanted;
  for (const auto& [name, entry] : index_names(expected))
    wanted.push_back(fmt::format("inline int {} = {}", name, entry));
  std::size_t next = 0;
  for (const Constant* constant : unit.constants) {
    if (constant->scope.empty() || constant->scope == "detail") continue;
    const std::string text = text_of(unit, *constant);
    if (constant->scope != "index" || constant->declarator.place.file != 0 || next == wanted.size())
      findings.add("the constant '{}' does not belong into {}", text, constant->scope);
    else
      findings.expect("an index", text, wanted[next++]);
  }
  if (next < wanted.size()) findings.add("'{}' is missing", wanted[next]);
}

}  // namespace jourdain::readback
