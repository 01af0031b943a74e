// Where a compiler may reorder sums, emitted sines and cosines are still right.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "embed/emit_model.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

/// Compiled with the flags in question: no arithmetic but the model's own.
constexpr const char* kSinesOfCpp = R"(
#include "double_pendulum_kernels.hpp"
#include "panda_kernels.hpp"

extern "C" void sines(const double* x, double* s, double* c) {
  panda::detail::sine_cosine4(x[0], s[0], c[0], x[1], s[1], c[1], x[2], s[2], c[2], x[3], s[3], c[3]);
}
extern "C" void single_sine(const double* x, double* s, double* c) {
  double_pendulum::detail::sine_cosine(*x, *s, *c);
}
extern "C" void float_sine(const float* x, float* s, float* c) {
  double_pendulum::detail::sine_cosine(*x, *s, *c);
}
)";

constexpr const char* kSinesOfC = R"(
#include "double_pendulum.c"
#include "double_pendulum_f.c"

void single_sine(const double *x, double *s, double *c) { double_pendulum_detail_sine_cosine(*x, s, c); }
void sines(const double *x, double *s, double *c) {
  int i;
  for (i = 0; i < 4; ++i) single_sine(x + i, s + i, c + i);
}
void float_sine(const float *x, float *s, float *c) { double_pendulum_f_detail_sine_cosine(*x, s, c); }
)";

/// Compiled without: prints the largest errors in units of the last place, of double and of float. Angles up to 2^30,
/// many of them near multiples of pi/2.
constexpr const char* kCompare = R"(
#include <cmath>
#include <cstdio>

extern "C" void sines(const double*, double*, double*);
extern "C" void single_sine(const double*, double*, double*);
extern "C" void float_sine(const float*, float*, float*);

static double worst = 0, worst_float = 0;

static double units(long double value, long double exact, int digits) {
  const int e = exact == 0 ? -126 : std::ilogb(exact);
  return static_cast<double>(std::fabs(std::ldexp(value - exact, digits - 1 - e)));
}
static void keep(double error, double& largest) {
  if (!(error <= largest)) largest = error;
}

int main() {
  for (long i = 1; i <= 400000; ++i) {
    double x[4], s[4], c[4];
    for (int k = 0; k < 4; ++k)
      x[k] = i % 2 ? std::ldexp(std::fmod(0.618033988749895 * (4 * i + k), 1) - 0.5, i % 60 - 28)
                   : 1.5707963267948966 * (4 * i + k) + (k - 1.5) * 1e-9;
    sines(x, s, c);
    for (int k = 0; k < 4; ++k) {
      const long double sine = std::sin(static_cast<long double>(x[k])), cosine = std::cos(static_cast<long double>(x[k]));
      keep(units(s[k], sine, 53), worst);
      keep(units(c[k], cosine, 53), worst);
      double s1, c1;
      single_sine(x + k, &s1, &c1);
      keep(units(s1, sine, 53), worst);
      keep(units(c1, cosine, 53), worst);
      const float y = static_cast<float>(x[k]);
      float sf, cf;
      float_sine(&y, &sf, &cf);
      keep(units(sf, std::sin(static_cast<long double>(y)), 24), worst_float);
      keep(units(cf, std::cos(static_cast<long double>(y)), 24), worst_float);
    }
  }
  std::printf("%.3f %.3f\n", worst, worst_float);
}
)";

using Flags = std::vector<std::string>;

class ReorderedSums : public testing::Test {
 protected:
  void SetUp() override {
    emit_model("double_pendulum", folder_.path(), {});
    emit_model("panda", folder_.path(), {});
    emit_model("double_pendulum", folder_.path(), {"--language", "c"});
    support::write_file(at("sines.cpp"), kSinesOfCpp);
    support::write_file(at("sines.c"), kSinesOfC);
    support::write_file(at("compare.cpp"), kCompare);
    run({"g++", "-O2", "-c", at("compare.cpp"), "-o", at("compare.o")});
  }

  std::string at(const std::string& name) const { return folder_.path() + "/" + name; }

  void run(const std::vector<std::string>& command) {
    const support::ProcessResult result = support::run_process(command);
    ASSERT_EQ(result.status, 0) << fmt::format("{}", fmt::join(command, " ")) << "\n" << result.output;
  }

  void expect_right(const std::string& compiler, const Flags& flags) {
    const bool is_c = compiler == "gcc" || compiler == "clang";
    std::vector<std::string> command = {compiler,  is_c ? "-std=c99" : "-std=c++17",
                                        "-O3",     "-march=native",
                                        "-Wall",   "-Wextra",
                                        "-Werror", "-Wno-unused-function"};
    command.insert(command.end(), flags.begin(), flags.end());
    command.insert(command.end(), {"-c", at(is_c ? "sines.c" : "sines.cpp"), "-o", at("sines.o")});
    run(command);
    run({"g++", at("compare.o"), at("sines.o"), "-o", at("compare")});
    double worst = -1, worst_float = -1;
    const std::string output = support::run_process({at("compare")}).output;
    ASSERT_EQ(std::sscanf(output.c_str(), "%lf %lf", &worst, &worst_float), 2) << output;
    const std::string where = fmt::format("{} {}", compiler, fmt::join(flags, " "));
    EXPECT_LT(worst, 1) << where;
    EXPECT_LT(worst_float, 1) << where;
    EXPECT_GT(worst, 0.4) << where;
  }

  support::TemporaryFolder folder_;
};

TEST_F(ReorderedSums, LeaveSinesRight) {
  const Flags associative = {"-fassociative-math", "-fno-signed-zeros", "-fno-trapping-math"};
  for (const char* compiler : {"g++", "clang++", "gcc", "clang"})
    for (const Flags& flags : {Flags{},
                               {"-ffast-math"},
                               {"-Ofast"},
                               {"-funsafe-math-optimizations"},
                               associative,
                               {"-frounding-math"}})
      expect_right(compiler, flags);
}

TEST_F(ReorderedSums, AreNoneWhereTheLibraryIsChosenByTheMacro) {
  expect_right("g++", {"-DJOURDAIN_LIBRARY_SINES"});
  const std::string names = support::run_process({"nm", "-u", at("sines.o")}).output;
  EXPECT_NE(names.find("sin"), std::string::npos) << names;
}

}  // namespace
}  // namespace jourdain::tests
