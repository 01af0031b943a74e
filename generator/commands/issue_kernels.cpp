#include "commands/issue_kernels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "support/check.hpp"

namespace jourdain::commands {

namespace {

/// Loops: of one kind each, and of sums and products by turns, which some processors issue faster.
constexpr const char *kSum = "sum", *kProduct = "product", *kBoth = "both", *kQuotient = "quotient",
                     *kRoot = "root";
constexpr std::array kLoops = {kSum, kProduct, kBoth, kQuotient, kRoot};
constexpr std::array kWidths = {Width::kOne, Width::k128, Width::k256, Width::k512};

std::string name_of(const std::string& loop, Width width) {
  return fmt::format("{}{}", loop, static_cast<int>(width));
}

/// The loops that tell about a kind.
std::vector<std::string> loops_of(Arithmetic arithmetic) {
  switch (arithmetic) {
    case Arithmetic::kSum:
      return {kSum, kBoth};
    case Arithmetic::kProduct:
      return {kProduct, kBoth};
    case Arithmetic::kExtreme:
      return {kBoth};
    case Arithmetic::kQuotient:
      return {kQuotient};
    case Arithmetic::kRoot:
      return {kRoot};
  }
  JD_CHECK(false, "an arithmetic without a loop");
}

/// Writes one loop. Numbers of issue_numbers lie in registers 0 to 13: a start; in 14: a factor or divisor; in 15: 0.
class KernelText {
 public:
  KernelText(bool is_float, Width width) : is_float_(is_float), width_(width) {}

  static constexpr int kRegisters = 13, kTurns = 4;

  std::string function(const std::string& loop) const {
    std::string load, body, clobbers;
    for (int i = 0; i <= kZero; ++i) {
      load += text(fmt::format("{} {}(%1), {}", is_wide() ? "vmovups" : "movups", place_of(i), reg(i)));
      clobbers += fmt::format(", \"xmm{}\"", i);
    }
    for (int turn = 0; turn < kTurns; ++turn)
      for (int i = 0; i < kRegisters; ++i) body += instruction(loop, i, (i + turn) % 2 == 0);
    return fmt::format(
        "void issue_{}(long rounds) {{\n  __asm__ volatile(\n{}{}{}{}{}"
        "      : \"+r\"(rounds) : \"r\"(issue_numbers) : \"cc\", \"memory\"{});\n}}\n",
        name_of(loop, width_), load, text("1:"), body, text("dec %0\\n jnz 1b"),
        is_wide() ? text("vzeroupper") : "", clobbers);
  }

 private:
  static constexpr int kStart = 13, kFactor = 14, kZero = 15;

  bool is_wide() const { return width_ == Width::k256 || width_ == Width::k512; }
  static int place_of(int i) {
    constexpr int kRow = 64;
    return std::max(i - kStart, 0) * kRow;
  }
  std::string reg(int i) const {
    return fmt::format("%%{}mm{}", width_ == Width::k512 ? 'z' : width_ == Width::k256 ? 'y' : 'x', i);
  }
  static std::string text(const std::string& line) { return fmt::format("      \"{}\\n\"\n", line); }
  std::string mnemonic(const char* stem) const {
    return fmt::format("{}{}{}{}", is_wide() ? "v" : "", stem, width_ == Width::kOne ? 's' : 'p',
                       is_float_ ? 's' : 'd');
  }
  /// Register i and another one, into i.
  std::string changed(const char* stem, int other, int i) const {
    return text(is_wide() ? fmt::format("{0} {1}, {2}, {2}", mnemonic(stem), reg(other), reg(i))
                          : fmt::format("{} {}, {}", mnemonic(stem), reg(other), reg(i)));
  }
  std::string instruction(const std::string& loop, int i, bool even) const {
    if (loop == kSum || (loop == kBoth && even)) return changed("add", kZero, i);
    if (loop == kProduct || loop == kBoth) return changed("mul", kFactor, i);
    if (loop == kRoot) return text(fmt::format("{} {}, {}", mnemonic("sqrt"), reg(kStart), reg(i)));
    // No quotient of a quotient of a quotient, which ends in simple numbers.
    return text(fmt::format("{} {}, {}", is_wide() ? "vmovaps" : "movaps", reg(kStart), reg(i))) +
           changed("div", kFactor, i);
  }

  bool is_float_;
  Width width_;
};

}  // namespace

std::optional<ArithmeticInstruction> read_instruction(const std::string& mnemonic,
                                                      const std::string& operands) {
  static const std::map<std::string, Arithmetic> kStems = {
      {"add", Arithmetic::kSum},          {"sub", Arithmetic::kSum},
      {"addsub", Arithmetic::kSum},       {"mul", Arithmetic::kProduct},
      {"fmadd", Arithmetic::kProduct},    {"fmsub", Arithmetic::kProduct},
      {"fnmadd", Arithmetic::kProduct},   {"fnmsub", Arithmetic::kProduct},
      {"fmaddsub", Arithmetic::kProduct}, {"fmsubadd", Arithmetic::kProduct},
      {"min", Arithmetic::kExtreme},      {"max", Arithmetic::kExtreme},
      {"div", Arithmetic::kQuotient},     {"sqrt", Arithmetic::kRoot}};
  // "vfmadd231pd": a stem, of fused ones the order of operands, one number or several, double or float.
  std::string stem = mnemonic.substr(mnemonic.starts_with('v') ? 1 : 0);
  if (stem.size() < 3) return {};
  const char count = stem[stem.size() - 2], type = stem.back();
  if ((count != 's' && count != 'p') || (type != 's' && type != 'd')) return {};
  stem.resize(stem.size() - 2);
  for (const char* order : {"132", "213", "231"})
    if (stem.starts_with('f') && stem.ends_with(order)) stem.resize(stem.size() - 3);
  const auto found = kStems.find(stem);
  if (found == kStems.end()) return {};
  Width width = Width::k128;
  if (count == 's')
    width = Width::kOne;
  else if (operands.find("%zmm") != std::string::npos)
    width = Width::k512;
  else if (operands.find("%ymm") != std::string::npos)
    width = Width::k256;
  return ArithmeticInstruction{found->second, width};
}

bool is_x87_arithmetic(const std::string& mnemonic) {
  // Behind some stems, "r" swaps the operands, "p" takes one from the stack, "s" or "l" is of one in memory.
  constexpr std::array kStems = {"fadd",  "fsub",  "fmul", "fdiv", "fiadd", "fisub",  "fimul", "fidiv",
                                 "fsqrt", "fprem", "fsin", "fcos", "fptan", "fpatan", "f2xm1", "fyl2x"};
  return std::any_of(kStems.begin(), kStems.end(),
                     [&](const char* stem) { return mnemonic.starts_with(stem); });
}

IssueKernels issue_kernels(bool is_float) {
  IssueKernels kernels;
  // They stay ordinary however often they are multiplied.
  for (const char* number : {"1.7123456789", "1.0001234567891", "0"}) {
    kernels.numbers += "{";
    for (int i = 0; i < (is_float ? 16 : 8); ++i) kernels.numbers += fmt::format("{}, ", number);
    kernels.numbers += "}, ";
  }
  for (const Width width : kWidths)
    for (const char* loop : kLoops) {
      const std::string name = name_of(loop, width);
      kernels.functions += KernelText(is_float, width).function(loop);
      kernels.table += fmt::format("    {{\"{0}\", {1}, issue_{0}}},\n", name,
                                   KernelText::kRegisters * KernelText::kTurns);
    }
  return kernels;
}

std::vector<std::string> issue_names(const ArithmeticCounts& counts) {
  std::set<std::string> names;
  for (const auto& [instruction, count] : counts)
    for (const std::string& loop : loops_of(instruction.arithmetic))
      names.insert(name_of(loop, instruction.width));
  return {names.begin(), names.end()};
}

double least_time(const ArithmeticCounts& counts, const std::map<std::string, double>& rates) {
  std::map<std::string, double> busy;
  for (const auto& [instruction, count] : counts)
    for (const std::string& loop : loops_of(instruction.arithmetic)) {
      const std::string unit = loop == kRoot ? kQuotient : loop;  // one unit takes both
      busy[unit] += count / rates.at(name_of(loop, instruction.width));
    }
  double most = 0;
  for (const auto& [unit, time] : busy) most = std::max(most, time);
  return most;
}

}  // namespace jourdain::commands
