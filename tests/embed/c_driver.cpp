#include "embed/c_driver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <vector>

namespace jourdain::tests {

namespace {

constexpr const char* kBegin = R"(#include <cstdio>
#include <cstring>

static long compared = 0, failures = 0;
static void same(const char* what, const void* cpp, const void* c, std::size_t size) {
  ++compared;
  if (std::memcmp(cpp, c, size) == 0) return;
  ++failures;
  std::printf("%s differs\n", what);
}
#define SAME(what, a, b) \
  static_assert(sizeof(a) == sizeof(b), what); \
  same(what, &(a), &(b), sizeof(a))
static void same_names(const char* what, const char* const* cpp, const char* const* c) {
  for (++compared; *cpp && *c && std::strcmp(*cpp, *c) == 0; ++cpp) ++c;
  if (!*cpp && !*c) return;
  ++failures;
  std::printf("%s differ\n", what);
}
)";

struct Declared {
  std::string result, name;
  std::vector<std::string> parameters;
};

bool is_word(char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// What stands between commas, with single blanks.
std::vector<std::string> separated(const std::string& list) {
  std::vector<std::string> parts(1);
  for (const char c : list)
    if (c == ',')
      parts.emplace_back();
    else if (std::isspace(static_cast<unsigned char>(c)) == 0)
      parts.back() += c;
    else if (!parts.back().empty() && parts.back().back() != ' ')
      parts.back() += ' ';
  return parts;
}

/// Functions that the header declares at the begin of a line, by their names without prefix.
std::vector<Declared> functions_of(const std::string& header, const std::string& prefix) {
  std::vector<Declared> found;
  const std::string before = " " + prefix;
  for (std::size_t at = 0; (at = header.find(before, at)) != std::string::npos; at += before.size()) {
    const std::size_t line = header.rfind('\n', at) + 1, name = at + before.size(),
                      open = header.find('(', name), close = header.find(");", name);
    if (open == std::string::npos || close == std::string::npos || header.find(';', name) < close) continue;
    const std::string result = header.substr(line, at - line), called = header.substr(name, open - name);
    if (result.empty() || called.empty() || !std::all_of(result.begin(), result.end(), is_word) ||
        !std::all_of(called.begin(), called.end(), is_word))
      continue;
    found.push_back({result, called, separated(header.substr(open + 1, close - open - 1))});
  }
  return found;
}

class Driver {
 public:
  Driver(const std::string& model, const std::string& header, const std::string& prefix,
         const std::string& real)
      : model_(model), header_(header), prefix_(prefix), real_(real) {}

  std::string text() const {
    std::string calls, before;
    for (const Declared& function : functions_of(header_, prefix_)) calls += call(function);
    if (has("loops_closed("))
      calls += fmt::format(
          "    {{ const bool a = {0}::Model<{1}>::loops_closed(s); const bool b = {2}loops_closed(&c_s) != "
          "0;\n"
          "      SAME(\"loops_closed\", a, b); }}\n",
          model_, real_, prefix_);
    if (has("loops_proven("))
      before += fmt::format(
          "  {{ const bool a = {0}::Model<{1}>::loops_proven({{}}); const bool b = {2}loops_proven(&c_p) != "
          "0;\n"
          "    SAME(\"loops_proven\", a, b); }}\n",
          model_, real_, prefix_);
    if (has("least_regularity;"))
      before += fmt::format(
          "  {{ const {1} a[] = {{{1}({0}::Model<>::least_regularity), "
          "{1}({0}::Model<>::greatest_opening)}};\n"
          "    const {1} b[] = {{{2}least_regularity, {2}greatest_opening}}; SAME(\"limits\", a, b); }}\n",
          model_, real_, prefix_);
    for (const char* what : {"position", "velocity", "input", "output", "parameter"})
      before += fmt::format("  same_names(\"{0}\", {1}::{0}_names, {2}{0}_names);\n", what, model_, prefix_);
    const std::vector<std::string> called = called_functions();
    std::string pointers;
    for (const std::string& name : called)
      pointers += fmt::format("  c_m.functions.{0} = user_{1}_{0};\n", name, real_);
    return sampler() + wrappers(called) +
           fmt::format(
               "static void check_{}() {{\n"
               "  const {}::Model<{}> m;\n  {}parameters c_p;\n  {}default_parameters(&c_p);\n"
               "  {}model c_m;\n{}  {}set_model(&c_m, &c_p);\n",
               real_, model_, real_, prefix_, prefix_, prefix_, pointers, prefix_) +
           compare_unless_empty("parameters", fmt::format("const {}::Parameters<{}> p;", model_, real_), "p",
                                "c_p") +
           (called.empty() ? compare_unless_empty("model", "", "m", "c_m") : "") + before +
           fmt::format("  {}::State<{}> s = initial_state(m);\n  {}state c_s = {}initial_state(&c_m);\n",
                       model_, real_, prefix_, prefix_) +
           "  SAME(\"initial_state\", s, c_s);\n" + inputs() +
           "  for (int round = 0; round < 4; ++round) {\n" + calls + perturb() + "  }\n}\n";
  }

 private:
  bool has(const std::string& name) const { return header_.find(prefix_ + name) != std::string::npos; }
  bool is_empty(const std::string& name) const {
    return header_.find("char none; /**< nothing */\n} " + prefix_ + name + ";") != std::string::npos;
  }
  bool has_member(const std::string& name, const std::string& member) const {
    const std::size_t end = header_.find("} " + prefix_ + name + ";"), begin = header_.rfind("typedef", end);
    return header_.substr(begin, end - begin).find(" " + member) != std::string::npos;
  }

  /// Functions of the user that the model has pointers to.
  std::vector<std::string> called_functions() const {
    const std::size_t end = header_.find("} " + prefix_ + "functions;");
    if (end == std::string::npos) return {};
    std::vector<std::string> names;
    for (std::size_t at = header_.rfind("typedef", end); (at = header_.find("(*", at)) < end; ++at)
      names.push_back(header_.substr(at + 2, header_.find(')', at) - at - 2));
    return names;
  }

  /// Pointers to what C++ calls, with its arguments.
  std::string wrappers(const std::vector<std::string>& called) const {
    std::string text;
    for (const std::string& name : called)
      text += fmt::format(
          "template <class... Arguments>\nstatic {1} user_{1}_{0}(void*, Arguments... a) {{\n"
          "  return {2}::Functions<{1}>{{}}.{0}(a...);\n}}\n",
          name, real_, model_);
    return text;
  }

  std::string compare_unless_empty(const std::string& name, const std::string& before, const char* a,
                                   const char* b) const {
    return is_empty(name) ? "" : fmt::format("  {}\n  SAME(\"{}\", {}, {});\n", before, name, a, b);
  }

  std::string inputs() const {
    std::string text = fmt::format("  {}::Input<{}> u{{}};\n  {}input c_u;\n", model_, real_, prefix_);
    if (!is_empty("input"))
      text +=
          fmt::format("  for (int i = 0; i < {}input_count; ++i) c_u.u[i] = u.u[i] = {}(0.3) * {}(i + 1);\n",
                      prefix_, real_, real_);
    return text;
  }

  /// Inputs that follow from a state, in both languages.
  std::string sampler() const {
    if (!has("input_at)")) return "";
    std::string value = fmt::format("{}(0.1) * {}(i + 1)", real_, real_);
    if (has_member("state", "y[")) value += fmt::format(" + {}(0.01) * s.y[0]", real_);
    if (has_member("state", "z[")) value += fmt::format(" - {}(0.02) * s.z[0]", real_);
    if (has_member("state", "t;")) value += " + s.t.high";
    const std::string loop =
        fmt::format("for (int i = 0; i < {}input_count; ++i) input.u[i] = {};", prefix_, value);
    return fmt::format(
        "struct At_{1} {{\n  {0}::Input<{1}> operator()(const {0}::State<{1}>& s) const {{\n"
        "    {0}::Input<{1}> input;\n    {3}\n    return input;\n  }}\n}};\n"
        "static void at_{1}(void*, const {2}state* state, {2}input* to) {{\n"
        "  const {2}state& s = *state;\n  {2}input& input = *to;\n  {3}\n}}\n",
        model_, real_, prefix_, loop);
  }

  std::string perturb() const {
    std::string text;
    for (const char* member : {"y", "z"})
      if (has_member("state", std::string(member) + "["))
        text += fmt::format("    for (auto& x : s.{0}) x += {1}(0.003) * {1}(1 + (&x - s.{0}) % 3);\n",
                            member, real_);
    return text + "    std::memcpy(static_cast<void*>(&c_s), &s, sizeof s);\n";
  }

  /// A block that calls both, a step several times.
  std::string call(const Declared& function) const {
    static const char* const kOther[] = {"default_parameters", "set_model", "initial_state", "loops_closed",
                                         "loops_proven",       "time_at",   "time_after"};
    for (const char* other : kOther)
      if (function.name == other) return "";
    const bool sampled = function.name.ends_with("_sampled"),
               step = function.name.find("_step") != std::string::npos;
    const std::string name = function.name.substr(0, function.name.size() - (sampled ? 8 : 0));
    std::string text = "    {\n", cpp = "m", c = "&c_m", after;
    const auto both = [&](const std::string& a, const std::string& b) {
      cpp += ", " + a;
      c += ", " + b;
    };
    for (const std::string& parameter : function.parameters) {
      const std::string last = parameter.substr(parameter.find_last_of(" *") + 1);
      if (last == "model") {
        continue;
      } else if (parameter.starts_with("const " + prefix_ + "state ")) {
        both("s", "&c_s");
      } else if (parameter.starts_with(prefix_ + "state ")) {
        text += "      auto a = s;\n      auto b = c_s;\n";
        after += fmt::format("      SAME(\"{}: state\", a, b);\n", function.name);
        both("a", "&b");
      } else if (last == "input") {
        both("u", "&c_u");
      } else if (last == "input_at") {
        both(fmt::format("At_{}{{}}", real_), fmt::format("at_{}, nullptr", real_));
      } else if (last == "context") {
        continue;
      } else if (last == "h") {
        both(fmt::format("{}(1e-5)", real_), fmt::format("{}(1e-5)", real_));
      } else if (parameter.starts_with("const " + real_ + " ")) {  // accelerations
        text += fmt::format(
            "      {} x[{}velocity_count];\n      for (auto& e : x) e = {}(0.7) * {}(1 + (&e - x));\n", real_,
            prefix_, real_, real_);
        both("x", "x");
      } else if (parameter.starts_with(real_ + " ")) {
        const std::size_t bracket = last.find('[');
        const std::string array = last.substr(0, bracket), bounds = last.substr(bracket);
        text += fmt::format(
            "      {0} a_{1}{2}, b_{1}{2};\n      std::memset(a_{1}, 255, sizeof a_{1});\n"
            "      std::memset(b_{1}, 255, sizeof b_{1});\n",
            real_, array, bounds);
        after += fmt::format("      SAME(\"{0}: {1}\", a_{1}, b_{1});\n", function.name, array);
        both("a_" + array, "b_" + array);
      } else {
        const std::string type = parameter.substr(0, parameter.find(' ')).substr(prefix_.size());
        const std::string in_cpp = type == "output_values"   ? "Outputs"
                                   : type == "linearization" ? "Linearization"
                                   : type == "accelerations" ? "Accelerations"
                                                             : "RateHistory";
        const std::string depth = in_cpp == "RateHistory" ? type.substr(12) + ", " : "";
        text += fmt::format(
            "      {0}::{1}<{2}{3}> a_{4};\n      {5}{6} b_{4};\n"
            "      std::memset(static_cast<void*>(&a_{4}), 0, sizeof a_{4});\n"
            "      std::memset(&b_{4}, 0, sizeof b_{4});\n",
            model_, in_cpp, depth, real_, last, prefix_, type);
        after += fmt::format("      SAME(\"{0}: {1}\", a_{1}, b_{1});\n", function.name, last);
        both("a_" + last, "&b_" + last);
      }
    }
    if (function.result != "void") {
      text += fmt::format("      const auto a = {}({});\n      const auto b = {}{}({});\n", name, cpp,
                          prefix_, function.name, c);
      after += fmt::format("      SAME(\"{}\", a, b);\n", function.name);
    } else {
      text +=
          fmt::format("      for (int k = 0; k < {}; ++k) {{\n        {}({});\n        {}{}({});\n      }}\n",
                      step ? 4 : 1, name, cpp, prefix_, function.name, c);
    }
    return text + after + "    }\n";
  }

  std::string model_, header_, prefix_, real_;
};

}  // namespace

std::string c_driver(const std::string& model, const std::string& header, const std::string& float_header) {
  const std::string written = fmt::format("{}/models/{}_functions.hpp", JOURDAIN_SOURCE_DIR, model);
  const std::string functions =
      std::filesystem::exists(written) ? fmt::format("#include \"{}\"\n", written) : "";
  return fmt::format("{1}#include \"{0}_kernels.hpp\"\n#include \"{0}.h\"\n#include \"{0}_f.h\"\n", model,
                     functions) +
         kBegin + Driver(model, header, model + "_", "double").text() +
         Driver(model, float_header, model + "_f_", "float").text() +
         "int main() {\n  check_double();\n  check_float();\n"
         "  std::printf(\"%ld compared\\n\", compared);\n  return failures != 0;\n}\n";
}

}  // namespace jourdain::tests
