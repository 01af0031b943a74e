#include "dynamics/harmonics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "dynamics/high_precision.hpp"
#include "kinematics/function_calls.hpp"
#include "kinematics/numbers.hpp"
#include "support/check.hpp"

namespace jourdain::dynamics {

using GiNaC::ex_to;
using GiNaC::is_a;

void Harmonics::add(std::vector<int> k, const Ex& c, const Ex& s) {
  while (!k.empty() && k.back() == 0) k.pop_back();
  const auto first = std::find_if(k.begin(), k.end(), [](int i) { return i != 0; });
  const bool negative = first != k.end() && *first < 0;
  if (negative)
    for (int& i : k) i = -i;
  Coefficients& sum = terms_[k];
  sum.cosine = (sum.cosine + c).expand();
  if (!k.empty()) sum.sine = (sum.sine + (negative ? Ex(-s) : s)).expand();
  if (sum.cosine.is_zero() && sum.sine.is_zero()) terms_.erase(k);
}

Harmonics Harmonics::cosine(std::vector<int> k) {
  Harmonics h;
  h.add(std::move(k), 1, 0);
  return h;
}

Harmonics Harmonics::sine(std::vector<int> k) {
  Harmonics h;
  h.add(std::move(k), 0, 1);
  return h;
}

Harmonics Harmonics::operator+(const Harmonics& other) const {
  Harmonics sum = *this;
  for (const auto& [k, c] : other.terms_) sum.add(k, c.cosine, c.sine);
  return sum;
}

Harmonics Harmonics::operator*(const Harmonics& other) const {
  Harmonics product;
  const Ex half(GiNaC::numeric(1, 2));
  for (const auto& [k, a] : terms_)
    for (const auto& [l, b] : other.terms_) {
      std::vector<int> sum(std::max(k.size(), l.size()), 0), difference = sum;
      for (std::size_t i = 0; i < k.size(); ++i) sum[i] = difference[i] = k[i];
      for (std::size_t i = 0; i < l.size(); ++i) {
        sum[i] += l[i];
        difference[i] -= l[i];
      }
      // (c cos k + s sin k)(c' cos l + s' sin l)
      product.add(sum, half * (a.cosine * b.cosine - a.sine * b.sine),
                  half * (a.sine * b.cosine + a.cosine * b.sine));
      product.add(difference, half * (a.cosine * b.cosine + a.sine * b.sine),
                  half * (a.sine * b.cosine - a.cosine * b.sine));
    }
  return product;
}

namespace {

class Expansion {
 public:
  explicit Expansion(const Equations& equations) {
    for (const kinematics::Leaf& leaf : equations.statements.leaves()) {
      values_[leaf.symbol] = Harmonics(leaf.symbol);
      if (leaf.kind == kinematics::LeafKind::kPosition) coordinates_.push_back(leaf.symbol);
    }
    for (const kinematics::Statement& statement : equations.statements.all())
      statements_[statement.name] = statement.value;
  }

  Harmonics value(const Ex& e) {
    if (is_a<GiNaC::numeric>(e)) return Harmonics(e);
    if (is_a<GiNaC::symbol>(e)) return symbol(ex_to<GiNaC::symbol>(e));
    if (is_a<GiNaC::add>(e) || is_a<GiNaC::mul>(e)) {
      Harmonics total = value(e.op(0));
      for (std::size_t i = 1; i < e.nops(); ++i)
        total = is_a<GiNaC::add>(e) ? total + value(e.op(i)) : total * value(e.op(i));
      return total;
    }
    if (is_ex_the_function(e, GiNaC::sin) || is_ex_the_function(e, GiNaC::cos)) return trigonometric(e);
    if (const auto function = kinematics::function_in(e)) {
      const Ex first = only_constant(value(e.op(0))), last = only_constant(value(e.op(e.nops() - 1)));
      return Harmonics(kinematics::applied(*function, first, last));
    }
    JD_CHECK(is_a<GiNaC::power>(e), "neither sum nor product");
    return power(value(e.op(0)), e.op(1));
  }

 private:
  Harmonics symbol(const GiNaC::symbol& s) {
    const auto known = values_.find(s);
    if (known != values_.end()) return known->second;
    const Harmonics expanded = value(statements_.at(s));
    return values_[s] = expanded;
  }

  /// sin or cos of an integer combination of coordinates, or of something without coordinates.
  Harmonics trigonometric(const Ex& e) {
    const bool is_sine = is_ex_the_function(e, GiNaC::sin);
    const Ex angle = only_constant(value(e.op(0)));
    std::vector<int> k;
    Ex rest = angle;
    for (const Ex& y : coordinates_) {
      const Ex coefficient = angle.coeff(y);
      JD_CHECK(is_a<GiNaC::numeric>(coefficient) && ex_to<GiNaC::numeric>(coefficient).is_integer(), "angle");
      k.push_back(ex_to<GiNaC::numeric>(coefficient).to_int());
      rest = (rest - coefficient * y).expand();
    }
    if (std::all_of(k.begin(), k.end(), [](int i) { return i == 0; }))
      return Harmonics(is_sine ? kinematics::sine(angle) : kinematics::cosine(angle));
    JD_CHECK(rest.is_zero(), "angle with an offset");
    return is_sine ? Harmonics::sine(k) : Harmonics::cosine(k);
  }

  static Ex only_constant(const Harmonics& h) {
    if (h.terms().empty()) return 0;
    JD_CHECK(h.terms().size() == 1 && h.terms().begin()->first.empty(), "not a polynomial");
    return h.terms().begin()->second.cosine;
  }

  static Harmonics power(const Harmonics& base, const Ex& exponent) {
    if (!exponent.info(GiNaC::info_flags::posint))
      return Harmonics(GiNaC::pow(only_constant(base), exponent));
    Harmonics product = base;
    for (int i = 1; i < ex_to<GiNaC::numeric>(exponent).to_int(); ++i) product = product * base;
    return product;
  }

  std::map<GiNaC::symbol, Harmonics, GiNaC::ex_is_less> values_;
  std::map<GiNaC::symbol, Ex, GiNaC::ex_is_less> statements_;
  std::vector<Ex> coordinates_;
};

/// A term of an expanded polynomial: number, then factors as sorted text.
struct Monomial {
  double number = 1;
  std::vector<std::string> factors;
};

std::string function_text(const Ex& call, bool latex) {
  const std::optional<support::Function> function = kinematics::function_in(call);
  std::vector<std::string> operands;
  for (std::size_t i = 0; i < call.nops(); ++i) operands.push_back(to_text(Harmonics(call.op(i)), latex));
  if (latex && function == support::Function::kWhereNegative)
    return "\\left(" + latex_cases(operands[0], operands[1], "0") + "\\right)";
  if (latex && function == support::Function::kWhereNotNegative)
    return "\\left(" + latex_cases(operands[0], "0", operands[1]) + "\\right)";
  const std::string name =
      function ? std::string(support::facts_of(*function).name) : ex_to<GiNaC::function>(call).get_name();
  return fmt::format(fmt::runtime(latex ? "\\operatorname{{{}}}({})" : "{}({})"), name,
                     fmt::join(operands, ", "));
}

std::string factor_text(const Ex& e, bool latex) {
  if (is_a<GiNaC::power>(e)) {
    const double exponent = support::nearest_double(cln::realpart(ex_to<GiNaC::numeric>(e.op(1)).to_cl_N()));
    const std::string base = factor_text(e.op(0), latex);
    return fmt::format(fmt::runtime(latex ? "{}^{{{}}}" : "{}^{}"),
                       is_a<GiNaC::power>(e.op(0)) ? "(" + base + ")" : base, exponent);
  }
  if (is_a<GiNaC::symbol>(e)) {
    const std::string name = ex_to<GiNaC::symbol>(e).get_name();
    return latex ? latex_name(name) : name;
  }
  if (is_a<GiNaC::function>(e)) return function_text(e, latex);
  return fmt::format("({})", to_text(Harmonics(e), latex));  // a sum under a power
}

Monomial to_monomial(const Ex& term, bool latex) {
  Monomial monomial;
  const auto take = [&](const Ex& factor) {
    if (is_a<GiNaC::numeric>(factor))
      monomial.number *= support::nearest_double(cln::realpart(ex_to<GiNaC::numeric>(factor).to_cl_N()));
    else
      monomial.factors.push_back(factor_text(factor, latex));
  };
  if (is_a<GiNaC::mul>(term))
    for (std::size_t i = 0; i < term.nops(); ++i) take(term.op(i));
  else
    take(term);
  std::sort(monomial.factors.begin(), monomial.factors.end());
  return monomial;
}

void append_terms(const Ex& coefficient, const std::string& harmonic, bool latex,
                  std::vector<Monomial>& terms) {
  std::vector<Monomial> list;
  const Ex expanded = coefficient.expand();
  if (expanded.is_zero()) return;
  if (is_a<GiNaC::add>(expanded))
    for (std::size_t i = 0; i < expanded.nops(); ++i) list.push_back(to_monomial(expanded.op(i), latex));
  else
    list.push_back(to_monomial(expanded, latex));
  std::sort(list.begin(), list.end(),
            [](const Monomial& a, const Monomial& b) { return a.factors < b.factors; });
  constexpr double kNothing = 1e-40;  // what cancelled floats of 60 digits leave
  for (Monomial& monomial : list) {
    if (std::fabs(monomial.number) < kNothing) continue;
    if (!harmonic.empty()) monomial.factors.push_back(harmonic);
    terms.push_back(monomial);
  }
}

std::string harmonic_text(const char* function, const std::vector<int>& k, bool latex) {
  std::string angle;
  for (std::size_t i = 0; i < k.size(); ++i) {
    if (k[i] == 0) continue;
    const std::string y = latex ? fmt::format("y_{{{}}}", i) : fmt::format("y{}", i);
    angle += angle.empty() ? (k[i] < 0 ? "-" : "") : (k[i] < 0 ? " - " : " + ");
    angle += std::abs(k[i]) == 1 ? y : fmt::format("{}{}{}", std::abs(k[i]), latex ? " " : "*", y);
  }
  return fmt::format(fmt::runtime(latex ? "\\{}({})" : "{}({})"), function, angle);
}

}  // namespace

Harmonics expand(const Equations& equations, const Ex& value) { return Expansion(equations).value(value); }

std::string to_text(const Harmonics& harmonics, bool latex) {
  std::vector<Monomial> terms;
  for (const auto& [k, c] : harmonics.terms()) {
    append_terms(c.cosine, k.empty() ? "" : harmonic_text("cos", k, latex), latex, terms);
    append_terms(c.sine, harmonic_text("sin", k, latex), latex, terms);
  }
  std::string text;
  for (const Monomial& term : terms) {
    text += text.empty() ? (term.number < 0 ? "-" : "") : (term.number < 0 ? " - " : " + ");
    const double size = std::fabs(term.number);
    const char* times = latex ? " " : "*";
    const std::string factors = fmt::format("{}", fmt::join(term.factors, times));
    if (size != 1 || factors.empty())
      text += (latex ? latex_number(size) : fmt::format("{}", size)) + (factors.empty() ? "" : times);
    text += factors;
  }
  return text.empty() ? "0" : text;
}

std::string latex_number(double value) {
  std::string text = fmt::format("{}", value);
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text;
  const std::string digits = text.substr(0, e),
                    power = fmt::format("10^{{{}}}", std::stoi(text.substr(e + 1)));
  if (digits == "1" || digits == "-1") return digits.substr(0, digits.size() - 1) + power;
  return digits + " \\cdot " + power;
}

std::string latex_cases(const std::string& decides, const std::string& negative,
                        const std::string& otherwise) {
  return fmt::format("\\begin{{cases}} {} & {} < 0 \\\\ {} & \\text{{otherwise}} \\end{{cases}}", negative,
                     decides, otherwise);
}

std::string latex_name(const std::string& name) {
  std::size_t letters = 0;
  while (letters < name.size() &&
         ((name[letters] >= 'a' && name[letters] <= 'z') || (name[letters] >= 'A' && name[letters] <= 'Z')))
    ++letters;
  if (letters == 0) return fmt::format("\\mathrm{{{}}}", name);
  const std::string base =
      letters == 1 ? name.substr(0, 1) : fmt::format("\\mathrm{{{}}}", name.substr(0, letters));
  std::string subscript;
  for (char c : name.substr(letters)) {
    if (c != '_')
      subscript += c;
    else if (!subscript.empty())
      subscript += ',';
  }
  return subscript.empty() ? base : fmt::format("{}_{{{}}}", base, subscript);
}

}  // namespace jourdain::dynamics
