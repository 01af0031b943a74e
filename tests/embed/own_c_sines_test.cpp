// Sines and cosines of emitted C, and of C++ in float: their error and that both languages and compilers have the same.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>

#include "embed/emit_model.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

/// For C and C++, with BOTH(x, s, c): every 211th finite float, or doubles of every size up to 2^31, with both signs.
/// Prints how many signs are wrong, a digest of all bits, and for float the largest error in units of the last place.
constexpr const char* kAngles = R"(
#include <math.h>
#include <stdio.h>
#include <string.h>
#ifdef __cplusplus
#include "double_pendulum_kernels.hpp"
#define BOTH(x, s, c) double_pendulum::detail::sine_cosine(x, s, c)
#elif defined(FLOAT)
#include "double_pendulum_f.c"
#define BOTH(x, s, c) double_pendulum_f_detail_sine_cosine(x, &s, &c)
#else
#include "double_pendulum.c"
#define BOTH(x, s, c) double_pendulum_detail_sine_cosine(x, &s, &c)
#endif

static unsigned long long digest = 7;
static int wrong = 0;
static double worst = 0;

#ifdef FLOAT
static void compare(float value, double exact) {
  int e = ilogb(exact);
  double error;
  if (e < -126) e = -126;
  error = fabs(value - exact) * ldexp(1, 23 - e);
  if (!(error <= worst)) worst = error;
}

static void angle(unsigned bits) {
  float x, s, c, t, d;
  unsigned result;
  memcpy(&x, &bits, sizeof x);
  BOTH(x, s, c);
  t = s, d = c;
  x = -x;
  BOTH(x, t, d);
  if (t != -s || d != c || fabsf(s) > 1 || fabsf(c) > 1 || signbit(t) == signbit(s)) ++wrong;
  compare(s, -sin((double)x));
  compare(c, cos((double)x));
  memcpy(&result, &s, sizeof s);
  digest = digest * 31 + result;
  memcpy(&result, &c, sizeof c);
  digest = digest * 31 + result;
}

int main(void) {
  unsigned bits;
  float none[] = {INFINITY, -INFINITY, NAN};
  int i;
  for (bits = 0; bits < 2139095040u; bits += 211) angle(bits);
  for (bits = 1061752795u - 50; bits < 1061752795u + 50; ++bits) angle(bits);
  for (i = 0; i < 3; ++i) {
    float s = 0, c = 0;
    BOTH(none[i], s, c);
    if (s == s || c == c) ++wrong;
  }
  printf("%d %llx %.3f\n", wrong, digest, worst);
  return 0;
}
#else
int main(void) {
  unsigned long long seed = 88172645463325252u, bits;
  int i;
  for (i = 0; i < 1000000; ++i) {
    double x, s, c, t, d;
    seed ^= seed << 13;
    seed ^= seed >> 7;
    seed ^= seed << 17;
    x = ldexp((double)(seed >> 11), i % 84 - 106);
    BOTH(x, s, c);
    x = -x;
    BOTH(x, t, d);
    if (t != -s || d != c) ++wrong;
    if (x < -1073741824) continue;
    memcpy(&bits, &s, sizeof s);
    digest = digest * 31 + bits;
    memcpy(&bits, &c, sizeof c);
    digest = digest * 31 + bits;
  }
  printf("%d %llx %.3f\n", wrong, digest, worst);
  return 0;
}
#endif
)";

struct Printed {
  int wrong = -1;
  std::string digest;
  double worst = -1;
};

class OwnSinesInBoth : public testing::Test {
 protected:
  void SetUp() override {
    emit_model("double_pendulum", folder_.path(), {});
    emit_model("double_pendulum", folder_.path(), {"--language", "c"});
    for (const char* ending : {".c", ".cpp"})
      support::write_file(folder_.path() + "/angles" + ending, kAngles);
  }

  Printed run(const std::string& compiler, const std::vector<std::string>& flags) {
    const bool is_c = compiler == "gcc" || compiler == "clang";
    std::vector<std::string> command = {compiler,
                                        is_c ? "-std=c99" : "-std=c++17",
                                        "-Wall",
                                        "-Wextra",
                                        "-Wno-unused-function",
                                        "-Werror",
                                        "-I" + folder_.path(),
                                        folder_.path() + (is_c ? "/angles.c" : "/angles.cpp"),
                                        "-o",
                                        folder_.path() + "/angles"};
    command.insert(command.end(), flags.begin(), flags.end());
    command.emplace_back("-lm");
    const support::ProcessResult built = support::run_process(command);
    EXPECT_EQ(built.status, 0) << built.output;
    std::istringstream output(support::run_process({folder_.path() + "/angles"}).output);
    Printed printed;
    output >> printed.wrong >> printed.digest >> printed.worst;
    return printed;
  }

  support::TemporaryFolder folder_;
};

TEST_F(OwnSinesInBoth, HaveTheSameBits) {
  for (const char* real : {"-DFLOAT", "-DDOUBLE"}) {
    const Printed first = run("gcc", {"-O0", "-ffp-contract=off", real});
    EXPECT_GE(first.digest.size(), 10u);
    for (const char* compiler : {"gcc", "clang", "g++", "clang++"}) {
      const Printed printed = run(compiler, {"-O2", "-march=native", "-ffp-contract=off", real});
      EXPECT_EQ(printed.wrong, 0) << compiler << real;
      EXPECT_EQ(printed.digest, first.digest) << compiler << real;
    }
  }
}

TEST_F(OwnSinesInBoth, AreLessThanOneUnitOfTheLastPlaceOffInFloat) {
  for (const char* contracts : {"-ffp-contract=off", "-ffp-contract=fast"}) {
    const Printed printed = run("g++", {"-O2", "-march=native", contracts, "-DFLOAT"});
    EXPECT_EQ(printed.wrong, 0);
    EXPECT_LT(printed.worst, 0.82) << contracts;
    EXPECT_GT(printed.worst, 0.5) << contracts;
  }
}

TEST_F(OwnSinesInBoth, OfFloatCallNoLibrary) {
  for (const bool is_c : {true, false}) {
    const std::string object = folder_.path() + "/model.o";
    support::write_file(
        folder_.path() + "/float.cpp",
        "#include \"double_pendulum_kernels.hpp\"\n"
        "template void double_pendulum::forward_dynamics(const double_pendulum::Model<float>&, const "
        "double_pendulum::State<float>&, const double_pendulum::Input<float>&, float (&)[2]) noexcept;\n");
    const support::ProcessResult built = support::run_process(
        is_c ? std::vector<std::string>{"gcc", "-std=c99", "-O2", "-c",
                                        folder_.path() + "/double_pendulum_f.c", "-o", object}
             : std::vector<std::string>{"g++", "-std=c++17", "-O2", "-c", folder_.path() + "/float.cpp", "-o",
                                        object});
    ASSERT_EQ(built.status, 0) << built.output;
    const std::string names = support::run_process({"nm", "-u", object}).output;
    EXPECT_EQ(names.find("sin"), std::string::npos) << names;
    EXPECT_EQ(names.find("cos"), std::string::npos) << names;
  }
}

}  // namespace
}  // namespace jourdain::tests
