#include "readback/function_texts.hpp"

#include <fmt/format.h>

namespace jourdain::readback {

namespace {

ChoosingText choosing(const char* name, const char* meaning, const char* cpp, const char* c) {
  ChoosingText made{name, cpp, c, "", ""};
  made.cpp_meaning = fmt::format(
      "JOURDAIN_FUNCTION inline double {0}(double a, double b) noexcept {{ return ::{1}(a, b); }}\n"
      "JOURDAIN_FUNCTION inline float {0}(float a, float b) noexcept {{ return ::{1}f(a, b); }}\n"
      "template <class Real> JOURDAIN_FUNCTION\n"
      "Real {0}(const Real& a, const Real& b) noexcept {{ return {1}(a, b); }}\n",
      name, meaning);
  made.c_meaning =
      fmt::format("static @R@ @D@{0}(@R@ a, @R@ b) {{\n  return {1}@F@(a, b);\n}}\n", name, meaning);
  return made;
}

}  // namespace

const std::vector<LibraryName>& library_names() {
  static const std::vector<LibraryName> names = {{"sin", ir::Op::kSin},
                                                 {"cos", ir::Op::kCos},
                                                 {"sqrt", ir::Op::kSqrt},
                                                 {"atan2", ir::Op::kAtan2},
                                                 {"exp", ir::Op::kExp},
                                                 {"log", ir::Op::kLog},
                                                 {"sinh", ir::Op::kSinh},
                                                 {"cosh", ir::Op::kCosh},
                                                 {"tanh", ir::Op::kTanh},
                                                 {"pow", ir::Op::kPower},
                                                 {"fabs", ir::Op::kAbs},
                                                 {"floor", ir::Op::kFloor},
                                                 {"meant_smaller", ir::Op::kMin},
                                                 {"meant_larger", ir::Op::kMax},
                                                 {"meant_where_negative", ir::Op::kWhereNegative},
                                                 {"meant_where_not_negative", ir::Op::kWhereNotNegative}};
  return names;
}

const std::vector<LibraryName>& emitted_names() {
  static const std::vector<LibraryName> names = {{"arctangent2", ir::Op::kAtan2},
                                                 {"exponential", ir::Op::kExp},
                                                 {"logarithm", ir::Op::kLog},
                                                 {"hyperbolic_sine", ir::Op::kSinh},
                                                 {"hyperbolic_cosine", ir::Op::kCosh},
                                                 {"hyperbolic_tangent", ir::Op::kTanh},
                                                 {"real_power", ir::Op::kPower},
                                                 {"absolute", ir::Op::kAbs},
                                                 {"whole_below", ir::Op::kFloor},
                                                 {"smaller", ir::Op::kMin},
                                                 {"larger", ir::Op::kMax},
                                                 {"where_negative", ir::Op::kWhereNegative},
                                                 {"where_not_negative", ir::Op::kWhereNotNegative}};
  return names;
}

const std::vector<ChoosingText>& choosing_texts() {
  static const std::vector<ChoosingText> texts = {choosing("smaller", "meant_smaller",
                                                           R"(template <class Real> JOURDAIN_FUNCTION
Real smaller(const Real& a, const Real& b) noexcept { return hooks::chosen(b < a, b, a, hooks::BySelect()); }
)",
                                                           R"(static @R@ @D@smaller(@R@ a, @R@ b) {
  return b < a ? b : a;
}
)"),
                                                  choosing("larger", "meant_larger",
                                                           R"(template <class Real> JOURDAIN_FUNCTION
Real larger(const Real& a, const Real& b) noexcept { return hooks::chosen(a < b, b, a, hooks::BySelect()); }
)",
                                                           R"(static @R@ @D@larger(@R@ a, @R@ b) {
  return a < b ? b : a;
}
)"),
                                                  choosing("where_negative", "meant_where_negative",
                                                           R"(template <class Real> JOURDAIN_FUNCTION
Real where_negative(const Real& d, const Real& x) noexcept {
  return hooks::chosen(d < Real(0.0), x, Real(0.0), hooks::BySelect());
}
)",
                                                           R"(static @R@ @D@where_negative(@R@ d, @R@ x) {
  return d < 0.0@F@ ? x : 0.0@F@;
}
)"),
                                                  choosing("where_not_negative", "meant_where_not_negative",
                                                           R"(template <class Real> JOURDAIN_FUNCTION
Real where_not_negative(const Real& d, const Real& x) noexcept {
  return hooks::chosen(d < Real(0.0), Real(0.0), x, hooks::BySelect());
}
)",
                                                           R"(static @R@ @D@where_not_negative(@R@ d, @R@ x) {
  return d < 0.0@F@ ? 0.0@F@ : x;
}
)")};
  return texts;
}

const char* entries() {
  return R"(namespace hooks {

template <class Real, class Value = float>
struct TableOf { using Type = double; };
template <>
struct TableOf<float, float> { using Type = float; };
template <class Real>
struct TableOf<Real, typename Real::value_type> { using Type = float; };

struct ByComparison {};
struct BySearch : ByComparison {};
struct ByLane : BySearch {};
template <class Real>
struct ByOwnEntry : ByLane {};

template <class Value> JOURDAIN_FUNCTION
int place(const Value& i, int last) noexcept { return i > 0 ? (i < static_cast<Value>(last) ? static_cast<int>(i) : last) : 0; }

template <class Value, int n> JOURDAIN_FUNCTION
double entry(const Value (&values)[n], const double& i, ByOwnEntry<double>) noexcept { return values[place(i, n - 1)]; }
template <class Value, int n> JOURDAIN_FUNCTION
float entry(const Value (&values)[n], const float& i, ByOwnEntry<float>) noexcept { return static_cast<float>(values[place(i, n - 1)]); }
template <class Real, class Value, int n> JOURDAIN_FUNCTION
auto entry(const Value (&values)[n], const Real& i, ByOwnEntry<Real>) noexcept -> decltype(table_entry(values, n - 1, i)) {
  return table_entry(values, n - 1, i);
}
template <class Real, class Value, int n> JOURDAIN_FUNCTION
auto entry(const Value (&values)[n], const Real& i, ByLane) noexcept
    -> decltype(void((*static_cast<Real*>(nullptr))[0] = values[0]), Real{}) {
  Real result = i;
  auto lane = i[0];
  for (unsigned k = 0; k < sizeof(result) / sizeof(lane); ++k) {
    lane = i[k];
    result[k] = static_cast<decltype(lane)>(values[place(lane, n - 1)]);
  }
  return result;
}
template <class Real, class Value, int n> JOURDAIN_FUNCTION
auto entry(const Value (&values)[n], const Real& i, BySearch) noexcept -> decltype(void(i < i ? 0 : 1), Real{}) {
  int found = 0, step = 1;
  while (2 * step < n) step *= 2;
  for (; step > 0; step /= 2)
    if (found + step < n && !(i < Real(found + step))) found += step;
  return Real(values[found]);
}
template <class Real, class Value, int n> JOURDAIN_FUNCTION
Real entry(const Value (&values)[n], const Real& i, ByComparison) noexcept {
  Real result = Real(values[0]);
  for (int k = 1; k < n; ++k) result = hooks::chosen(i < Real(k), result, Real(values[k]), hooks::BySelect());
  return result;
}

}
)";
}

const char* choice() {
  return R"(namespace hooks {

struct ByCondition {};
struct ByWhere : ByCondition {};
struct BySelect : ByWhere {};

template <class Mask, class Real> JOURDAIN_FUNCTION
auto chosen(const Mask& mask, const Real& a, const Real& b, BySelect) noexcept -> decltype(Real(select(mask, a, b))) {
  return select(mask, a, b);
}
template <class Mask, class Real> JOURDAIN_FUNCTION
auto chosen(const Mask& mask, const Real& a, Real b, ByWhere) noexcept -> decltype(void(where(mask, b) = a), Real(b)) {
  where(mask, b) = a;
  return b;
}
template <class Mask, class Real> JOURDAIN_FUNCTION
Real chosen(const Mask& mask, const Real& a, const Real& b, ByCondition) noexcept { return mask ? a : b; }

}
)";
}

}  // namespace jourdain::readback
