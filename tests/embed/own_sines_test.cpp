// Models with sines and cosines of their own: how far off these are, whether compilers agree on them, and what models
// make of them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>

#include "embed/emit_model.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

support::ProcessResult compile(const std::string& compiler, const std::string& folder,
                               const std::string& unit, const std::vector<std::string>& more) {
  std::vector<std::string> command = {
      compiler, "-std=c++17", "-I" + folder, folder + "/" + unit + ".cpp", "-o", folder + "/" + unit};
  command.insert(command.end(), more.begin(), more.end());
  return support::run_process(command);
}

/// Every angle goes through blocks of four, of three and of two and alone, with both signs. Prints how many results
/// differ between these, of floats too, a digest of all bits of doubles and, with QUAD, the largest error in units of
/// the last place. HARD are those nearest to a multiple of pi/2 in each binade from 1 to 2^30: of the sums of multiples
/// of the last two denominators below 2^53 in the continued fraction of 2^(e+1)/pi, the one in the binade whose
/// fraction is nearest to a whole.
constexpr const char* kAngles = R"(
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#ifdef QUAD
#include <quadmath.h>
#endif
#include "squeezer_kernels.hpp"

namespace own = squeezer::detail;
static uint64_t seed = 88172645463325252u, digest = 1469598103934665603u;
static int different = 0;
static double worst = 0;

static double fraction() {
  seed ^= seed << 13;
  seed ^= seed >> 7;
  seed ^= seed << 17;
  return (double)(seed >> 11) / 4503599627370496.0 - 1;
}
static void same(double a, double b) { different += memcmp(&a, &b, sizeof a) != 0; }
static void result(double value) {
  uint64_t bits;
  memcpy(&bits, &value, sizeof bits);
  digest = (digest ^ bits) * 1099511628211u;
}
#ifdef QUAD
static void compare(double value, __float128 exact) {
  int e = exact == 0 ? -1022 : ilogb((double)exact);
  if (e < -1022) e = -1022;
  const double error = fabs((double)((value - exact) / ldexpq(1, e - 52)));
  if (!(error <= worst)) worst = error;
}
#endif
static void four(double x0, double x1, double x2, double x3) {
  const double x[4] = {x0, x1, x2, x3};
  double s[4], c[4], s2[4], c2[4], s3[4], c3[4];
  own::sine_cosine4(x0, s[0], c[0], x1, s[1], c[1], x2, s[2], c[2], x3, s[3], c[3]);
  for (int i = 0; i < 4; i += 2) own::sine_cosine2(x[i], s2[i], c2[i], x[i + 1], s2[i + 1], c2[i + 1]);
  own::sine_cosine3(x3, s3[3], c3[3], x1, s3[1], c3[1], x0, s3[0], c3[0]);
  own::sine_cosine3(x1, s3[1], c3[1], x2, s3[2], c3[2], x3, s3[3], c3[3]);
  for (int i = 0; i < 4; ++i) {
    same(s2[i], s[i]);
    same(c2[i], c[i]);
    same(s3[i], s[i]);
    same(c3[i], c[i]);
    same(own::sine(x[i]), s[i]);
    same(own::cosine(x[i]), c[i]);
    same(own::sine(-x[i]), -s[i]);
    same(own::cosine(-x[i]), c[i]);
    result(s[i]);
    result(c[i]);
#ifdef QUAD
    __float128 sine, cosine;
    sincosq(x[i], &sine, &cosine);
    compare(s[i], sine);
    compare(c[i], cosine);
#endif
  }
}
static float as_float(uint32_t bits) {
  float x;
  memcpy(&x, &bits, sizeof x);
  return x;
}
static void same(float x, float s, float c) {
  float sine, cosine;
  own::sine_cosine(x, sine, cosine);
  if (x - x == 0)
    different += memcmp(&sine, &s, sizeof s) != 0 || memcmp(&cosine, &c, sizeof c) != 0;
  else
    different += s == s || c == c;
}
static void floats(const float (&x)[4]) {
  float s[4], c[4];
  own::sine_cosine4(x[0], s[0], c[0], x[1], s[1], c[1], x[2], s[2], c[2], x[3], s[3], c[3]);
  for (int i = 0; i < 4; ++i) same(x[i], s[i], c[i]);
  own::sine_cosine3(x[3], s[0], c[0], x[2], s[1], c[1], x[1], s[2], c[2]);
  for (int i = 0; i < 3; ++i) same(x[3 - i], s[i], c[i]);
  own::sine_cosine2(x[1], s[0], c[0], x[2], s[1], c[1]);
  for (int i = 0; i < 2; ++i) same(x[1 + i], s[i], c[i]);
}
static const struct { long long m; int e; } hard[] = {HARD};

int main() {
  const double ranges[] = {1e-320, 1e-300, 1e-8, 0.7854, 3.2, 100, 1e5, 1e8, 1073741824};
  for (double range : ranges)
    for (int i = 0; i < 30000; ++i) {
      double x[4];
      for (double& angle : x) angle = range * fraction();
      four(x[0], x[1], x[2], x[3]);
    }
  for (const auto& h : hard) {
    const double x = ldexp((double)h.m, h.e);
    four(x, nextafter(x, 0), nextafter(x, 2 * x), x / 2);
  }
  for (int n = 0; n < 40000; ++n) {
    const double x = n * 1.5707963267948966, half = x / 2;
    four(x, nextafter(x, 0), half, nextafter(half, 0));
  }
  four(0.0, -0.0, 5e-324, 1073741824.0);
  const double beyond[] = {1073741824.0000002, 1e22, 1e308};
  for (double x : beyond) {
    double s[4], c[4];
    own::sine_cosine4(x, s[0], c[0], 1.0, s[1], c[1], -x, s[2], c[2], 2.0, s[3], c[3]);
    same(s[0], sin(x));
    same(c[0], cos(x));
    same(s[2], -sin(x));
    same(s[1], own::sine(1.0));
    same(c[3], own::cosine(2.0));
    own::sine_cosine3(1.0, s[0], c[0], 2.0, s[1], c[1], x, s[2], c[2]);
    same(s[0], own::sine(1.0));
    same(c[1], own::cosine(2.0));
    same(s[2], sin(x));
  }
  const double none[] = {INFINITY, -INFINITY, NAN};
  for (double x : none) {
    double s, c, s1, c1;
    own::sine_cosine2(x, s, c, 1.0, s1, c1);
    different += s == s || c == c;
    same(s1, own::sine(1.0));
    own::sine_cosine3(2.0, s1, c1, x, s, c, 1.0, s1, c1);
    different += s == s || c == c;
    same(s1, own::sine(1.0));
  }
  for (uint32_t bits = 0; bits < 0x80000000u - 40000; bits += 10007) {  // infinities and what is no number, too
    const float x[4] = {as_float(bits), -as_float(bits + 1), as_float(bits + 20000), -as_float(bits + 30000)};
    floats(x);
    const float apart[4] = {as_float(bits), 1, -as_float(0x80000000u - 40000 - bits), 0.5f};
    floats(apart);
  }
  printf("%d %016llx %.3f\n", different, (unsigned long long)digest, worst);
}
)";

constexpr const char* kHard =
    "{7074237752028440, -52}, {7074237752028440, -51}, {5305678314021330, -50}, {5305678314021330, -49}, "
    "{8400657330533773, -48}, {6411027962775774, -47}, {6411027962775774, -46}, {6411027962775774, -45}, "
    "{6411027962775774, -44}, {6411027962775774, -43}, {6411027962775774, -42}, {6411027962775774, -41}, "
    "{6411027962775774, -40}, {6411027962775774, -39}, {6251702173560778, -38}, {6331365068168276, -37}, "
    "{6291533620864527, -36}, {7874374887906596, -35}, {5520028710995367, -34}, {5520028710995367, -33}, "
    "{7295746205504726, -32}, {7295746205504726, -31}, {7295746205504726, -30}, {7763785107565477, -29}, "
    "{7763785107565477, -28}, {7763785107565477, -27}, {7763785107565477, -26}, {7763785107565477, -25}, "
    "{7763785107565477, -24}, {7763785107565477, -23}";

struct Printed {
  int different = -1;
  std::string digest;
  double worst = -1;
};

class OwnSines : public testing::Test {
 protected:
  void SetUp() override {
    emit_model("squeezer", folder_.path(), {});
    std::string text = kAngles;
    text.replace(text.find("{HARD}"), 6, fmt::format("{{{}}}", kHard));
    support::write_file(folder_.path() + "/angles.cpp", text);
  }

  Printed run(const std::string& compiler, const std::vector<std::string>& flags) {
    const support::ProcessResult built = compile(compiler, folder_.path(), "angles", flags);
    EXPECT_EQ(built.status, 0) << built.output;
    std::istringstream output(support::run_process({folder_.path() + "/angles"}).output);
    Printed printed;
    output >> printed.different >> printed.digest >> printed.worst;
    return printed;
  }

  support::TemporaryFolder folder_;
};

TEST_F(OwnSines, AreLessThanOneUnitOfTheLastPlaceOff) {
  for (const char* contracts : {"-ffp-contract=off", "-ffp-contract=fast"}) {
    const Printed printed = run("g++", {"-O2", "-march=native", contracts, "-DQUAD", "-lquadmath"});
    EXPECT_LT(printed.worst, 0.85) << contracts;
    EXPECT_GT(printed.worst, 0.5) << contracts;
    if (std::string(contracts) == "-ffp-contract=off") {
      EXPECT_EQ(printed.different, 0);
    }
  }
}

TEST_F(OwnSines, HaveTheSameBitsFromEveryCompiler) {
  const Printed first = run("g++", {"-O2", "-ffp-contract=off"});
  EXPECT_EQ(first.different, 0);
  EXPECT_EQ(first.digest.size(), 16u);
  for (const std::string compiler : {"g++", "clang++"})
    for (const std::vector<std::string>& flags : {std::vector<std::string>{"-O0"},
                                                  {"-O3", "-march=native"},
                                                  {"-O2", "-D__CUDA__"}}) {  // the last: no vectors
      std::vector<std::string> more = flags;
      more.emplace_back("-ffp-contract=off");
      const Printed printed = run(compiler, more);
      EXPECT_EQ(printed.different, 0) << compiler << " " << flags[0];
      EXPECT_EQ(printed.digest, first.digest) << compiler << " " << flags[0];
    }
}

/// Velocities of NAME, with the library's sines, and of NAME_own over 200 steps; prints the largest difference over
/// 1 + size.
constexpr const char* kBeside = R"(
#include <math.h>
#include <stdio.h>
#include "NAME_kernels.hpp"
#include "NAME_own_kernels.hpp"

int main() {
  const NAME::Model<double> library;
  const NAME_own::Model<double> own;
  auto a = initial_state(library);
  auto b = initial_state(own);
  typename NAME::Model<double>::Input u{};
  typename NAME_own::Model<double>::Input v{};
  double worst = 0;
  for (int i = 0; i < 200; ++i) {
    rk4_step(library, a, u, 1e-3);
    rk4_step(own, b, v, 1e-3);
    for (int k = 0; k < NAME::Model<double>::velocity_count; ++k) {
      const double off = fabs(a.z[k] - b.z[k]) / (1 + fabs(a.z[k]));
      if (!(off <= worst)) worst = off;
    }
  }
  printf("%.3g\n", worst);
}
)";

TEST(OwnSinesOfModels, MoveThemAsTheLibraryDoes) {
  for (const std::string model : {"double_pendulum", "panda", "quadrotor", "four_bar", "shaking_cart"})
    for (const bool packs : {false, true}) {
      const support::TemporaryFolder folder;
      std::vector<std::string> options = {"--name", model + "_own"};
      if (packs) options.emplace_back("--packs");
      emit_model(model, folder.path(), {"--libm"});
      emit_model(model, folder.path(), options);
      std::string text = kBeside;
      for (std::size_t at = 0; (at = text.find("NAME", at)) != std::string::npos;) text.replace(at, 4, model);
      support::write_file(folder.path() + "/beside.cpp", text);
      for (const char* compiler : {"g++", "clang++"}) {
        const support::ProcessResult built =
            compile(compiler, folder.path(), "beside", {"-O1", "-Wall", "-Wextra", "-Werror"});
        ASSERT_EQ(built.status, 0) << compiler << " " << model << "\n" << built.output.substr(0, 2000);
        const support::ProcessResult result = support::run_process({folder.path() + "/beside"});
        ASSERT_EQ(result.status, 0) << model;
        EXPECT_LT(std::stod(result.output), 1e-11) << model;
      }
    }
}

}  // namespace
}  // namespace jourdain::tests
