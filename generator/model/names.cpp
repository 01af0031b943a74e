#include "model/names.hpp"

#include <algorithm>
#include <array>

namespace jourdain::model {

namespace {

constexpr std::array<std::string_view, 97> kKeywords{
    "alignas",     "alignof",   "and",        "and_eq",    "asm",      "auto",         "bitand",
    "bitor",       "bool",      "break",      "case",      "catch",    "char",         "char8_t",
    "char16_t",    "char32_t",  "class",      "compl",     "concept",  "const",        "consteval",
    "constexpr",   "constinit", "const_cast", "continue",  "co_await", "co_return",    "co_yield",
    "decltype",    "default",   "delete",     "do",        "double",   "dynamic_cast", "else",
    "enum",        "explicit",  "export",     "extern",    "false",    "float",        "for",
    "friend",      "goto",      "if",         "inline",    "int",      "long",         "mutable",
    "namespace",   "new",       "noexcept",   "not",       "not_eq",   "nullptr",      "operator",
    "or",          "or_eq",     "private",    "protected", "public",   "register",     "reinterpret_cast",
    "requires",    "return",    "short",      "signed",    "sizeof",   "static",       "static_assert",
    "static_cast", "struct",    "switch",     "template",  "this",     "thread_local", "throw",
    "true",        "try",       "typedef",    "typeid",    "typename", "union",        "unsigned",
    "using",       "virtual",   "void",       "volatile",  "wchar_t",  "while",        "xor",
    "xor_eq",      "final",     "override",   "import",    "module",   "restrict"};

/// Macros of the C library's headers and of common compilers.
constexpr std::array<std::string_view, 52> kMacros{
    "assert",         "errno",    "offsetof",   "isnan",      "isinf",        "isfinite",
    "isnormal",       "signbit",  "fpclassify", "isgreater",  "isless",       "isunordered",
    "setjmp",         "stdin",    "stdout",     "stderr",     "linux",        "unix",
    "major",          "minor",    "NULL",       "NAN",        "INFINITY",     "EOF",
    "BUFSIZ",         "RAND_MAX", "HUGE_VAL",   "HUGE_VALF",  "EXIT_SUCCESS", "EXIT_FAILURE",
    "CLOCKS_PER_SEC", "FP_NAN",   "FP_ZERO",    "FP_NORMAL",  "FP_INFINITE",  "M_E",
    "M_LOG2E",        "M_LOG10E", "M_LN2",      "M_LN10",     "M_PI",         "M_PI_2",
    "M_PI_4",         "M_1_PI",   "M_2_PI",     "M_2_SQRTPI", "M_SQRT2",      "M_SQRT1_2",
    "DOMAIN",         "OVERFLOW", "UNDERFLOW",  "MAXFLOAT"};

constexpr std::array<std::string_view, 10> kEmitted{"Real",       "Model",   "State",         "Input",
                                                    "Parameters", "Outputs", "Linearization", "RateHistory",
                                                    "detail",     "jourdain"};

/// Functions and types that C headers put into the global namespace: no namespace can have these names.
constexpr std::array<std::string_view, 101> kGlobalNames{
    "std",    "main",   "sin",    "cos",     "tan",     "asin",   "acos",  "atan",   "atan2",     "sinh",
    "cosh",   "tanh",   "asinh",  "acosh",   "atanh",   "exp",    "exp2",  "expm1",  "log",       "log2",
    "log10",  "log1p",  "logb",   "pow",     "sqrt",    "cbrt",   "hypot", "erf",    "erfc",      "gamma",
    "lgamma", "tgamma", "ceil",   "floor",   "trunc",   "round",  "rint",  "fmod",   "remainder", "modf",
    "frexp",  "ldexp",  "scalb",  "drem",    "fabs",    "fmax",   "fmin",  "fma",    "fdim",      "nan",
    "finite", "j0",     "j1",     "jn",      "y0",      "y1",     "yn",    "abs",    "div",       "exit",
    "abort",  "free",   "malloc", "random",  "rand",    "system", "time",  "clock",  "signal",    "raise",
    "index",  "remove", "rename", "read",    "write",   "open",   "close", "link",   "unlink",    "pipe",
    "sleep",  "pause",  "select", "sync",    "access",  "wait",   "stat",  "daemon", "nice",      "puts",
    "printf", "perror", "gets",   "tmpfile", "timer_t", "size_t", "crypt", "swab",   "fork",      "alarm",
    "acct"};

template <std::size_t n>
bool contains(const std::array<std::string_view, n>& list, std::string_view name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

bool is_identifier(std::string_view name) {
  return !name.empty() && is_letter(name[0]) &&
         std::all_of(name.begin(), name.end(), [](char c) { return is_letter(c) || is_digit(c); });
}

bool is_reserved(std::string_view name) {
  return contains(kKeywords, name) || contains(kMacros, name) || contains(kEmitted, name);
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
  return is_reserved(out) || contains(kGlobalNames, out) ? out + "_model" : out;
}

}  // namespace jourdain::model
