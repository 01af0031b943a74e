#include "model/names.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "model/c_names.hpp"

namespace jourdain::model {

namespace {

constexpr std::array<std::string_view, 99> kKeywords{
    "alignas",      "alignof",   "and",        "and_eq",    "asm",      "auto",         "bitand",
    "bitor",        "bool",      "break",      "case",      "catch",    "char",         "char8_t",
    "char16_t",     "char32_t",  "class",      "compl",     "concept",  "const",        "consteval",
    "constexpr",    "constinit", "const_cast", "continue",  "co_await", "co_return",    "co_yield",
    "decltype",     "default",   "delete",     "do",        "double",   "dynamic_cast", "else",
    "enum",         "explicit",  "export",     "extern",    "false",    "float",        "for",
    "friend",       "goto",      "if",         "inline",    "int",      "long",         "mutable",
    "namespace",    "new",       "noexcept",   "not",       "not_eq",   "nullptr",      "operator",
    "or",           "or_eq",     "private",    "protected", "public",   "register",     "reinterpret_cast",
    "requires",     "return",    "short",      "signed",    "sizeof",   "static",       "static_assert",
    "static_cast",  "struct",    "switch",     "template",  "this",     "thread_local", "throw",
    "true",         "try",       "typedef",    "typeid",    "typename", "union",        "unsigned",
    "using",        "virtual",   "void",       "volatile",  "wchar_t",  "while",        "xor",
    "xor_eq",       "final",     "override",   "import",    "module",   "restrict",     "typeof",
    "typeof_unqual"};

/// What emitted code and the check that reads it call their own.
constexpr std::array<std::string_view, 15> kEmitted{
    "Real",          "Scalar",      "Time",   "Model",    "State", "Input", "Parameters", "Outputs",
    "Linearization", "RateHistory", "detail", "jourdain", "NAME",  "std",   "main"};

/// Beginnings of names that emitted files give to what is not the model's: a model `get` would bring `get_parameters`,
/// for one, a second time. And functions that kernels call in a number type's namespace, which a namespace would hide.
constexpr auto kOfEmittedFiles = std::to_array<std::string_view>(
    {// beginnings, in C
     "before", "bias", "by", "call", "call_constraint", "compute", "drift", "get", "has", "is", "no", "old",
     "output_by", "position_by", "read", "saved", "set", "set_step", "step", "step_linearly_implicit",
     "step_semi_implicit", "stop", "write",
     // of number types
     "from_literal", "sine_cosine", "table_entry", "where"});

/// In small letters. Headers of the C library that NAME.h would be found before, and files that are written or compiled
/// beside the model's; the guards of the tool's own headers too.
constexpr auto kFiles = std::to_array<std::string_view>(
    {"alloca", "assert", "complex", "ctype", "endian", "errno", "features", "fenv", "float", "inttypes",
     "iso646", "limits", "locale", "malloc", "math", "memory", "pthread", "sched", "semaphore", "setjmp",
     "signal", "stdalign", "stdarg", "stdatomic", "stdbool", "stdckdint", "stddef", "stdint", "stdio",
     "stdlib", "stdnoreturn", "string", "strings", "syscall", "syslimits", "tgmath", "threads", "time",
     "uchar", "unistd", "values", "wchar", "wctype",
     // the tool's
     "bench", "board", "cost", "draws", "ensemble", "ensemble_interface", "functions", "jourdain",
     "long_real", "model_table", "pack", "shim", "stepping"});

std::string in_small_letters(std::string_view name) {
  std::string small(name);
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return small;
}

template <std::size_t n>
bool contains(const std::array<std::string_view, n>& list, std::string_view name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

/// Names of the tool's own begin so, and none ends with `_model`, which is how models are renamed.
bool is_of_the_tool(std::string_view small) {
  return small.starts_with("jourdain_") && !small.ends_with("_model");
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

bool is_identifier(std::string_view name) {
  return !name.empty() && is_letter(name[0]) &&
         std::all_of(name.begin(), name.end(), [](char c) { return is_letter(c) || is_digit(c); });
}

bool is_reserved(std::string_view name) {
  const bool is_of_c = name.size() > 1 && name[0] == '_' && name[1] >= 'A' && name[1] <= 'Z';  // _Bool
  return contains(kKeywords, name) || contains(kEmitted, name) || is_macro(name) || is_of_c ||
         (name.starts_with("JOURDAIN_") && !name.ends_with("_model"));
}

bool is_taken_by_files(std::string_view name) {
  const std::string small = in_small_letters(name);
  return contains(kOfEmittedFiles, name) || contains(kFiles, small) || is_of_the_tool(small);
}

std::string cpp_name(std::string_view name) {
  std::string out;
  for (const char c : name) {
    const char kept = is_letter(c) || is_digit(c) ? c : '_';
    if (kept != '_' || out.empty() || out.back() != '_') out += kept;
  }
  while (out.size() > 1 && out.back() == '_') out.pop_back();
  if (out.empty() || out == "_") return "model";
  if (out[0] == '_') return "model" + out;
  if (is_digit(out[0])) return "model_" + out;
  return is_reserved(out) || is_global_name(out) || is_taken_by_files(out) ? out + "_model" : out;
}

}  // namespace jourdain::model
