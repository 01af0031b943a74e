// Arctangents of emitted code: their error, and that both languages and compilers have the same.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>

#include "embed/emit_model.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

/// For C and C++: points of all directions and sizes, with both signs of y. Prints how many results are wrong in what
/// is exact (signs, points on the axes), a digest of all bits, and the largest error in units of the last place.
constexpr const char* kPoints = R"(
#include <math.h>
#include <stdio.h>
#include <string.h>
#ifdef FLOAT
typedef float REAL;
enum { DIGITS = 24, SMALLEST = -126 };
#else
typedef double REAL;
enum { DIGITS = 53, SMALLEST = -1022 };
#endif
#ifdef __cplusplus
#include "four_bar_kernels.hpp"
#define ANGLE(y, x) four_bar::detail::arctangent2(y, x)
#elif defined(FLOAT)
#include "four_bar_f.c"
#define ANGLE(y, x) four_bar_f_detail_arctangent2(y, x)
#else
#include "four_bar.c"
#define ANGLE(y, x) four_bar_detail_arctangent2(y, x)
#endif

static unsigned long long seed = 88172645463325252u, digest = 7;
static int wrong = 0;
static long double worst = 0;

static double fraction(void) {
  seed ^= seed << 13;
  seed ^= seed >> 7;
  seed ^= seed << 17;
  return (double)(seed >> 11) / 4503599627370496.0 - 1;
}

static void point(REAL y, REAL x) {
  const REAL angle = ANGLE(y, x), below = ANGLE(-y, x);
  const long double exact = atan2l(y, x);
  unsigned char bytes[sizeof(REAL)];
  unsigned i;
  int e = exact == 0 ? SMALLEST : ilogbl(exact);
  long double error;
  if (e < SMALLEST) e = SMALLEST;
  error = fabsl(ldexpl(angle - exact, DIGITS - 1 - e));
  if (!(error <= worst)) worst = error;
  if (below != -angle || signbit(below) == signbit(angle) || signbit(angle) != signbit(y)) ++wrong;
  memcpy(bytes, &angle, sizeof angle);
  for (i = 0; i < sizeof angle; ++i) digest = digest * 31 + bytes[i];
}

static void exactly(REAL y, REAL x, REAL angle) {
  const REAL found = ANGLE(y, x);
  if (memcmp(&found, &angle, sizeof angle)) ++wrong;
}

int main(void) {
  const REAL zero = 0, pi = (REAL)3.14159265358979323846L, none[] = {(REAL)NAN, (REAL)INFINITY};
  long i;
  for (i = 0; i < 1000000; ++i) {
    const double a = 3.2 * fraction(), size = ldexp(1, (int)(i % 60) - 30);
    const double y = ldexp(fraction(), (int)(i % 87) - 43), x = ldexp(fraction(), (int)(i % 59) - 29);
    if (i % 2)
      point((REAL)(size * sin(a)), (REAL)(size * cos(a)));
    else
      point((REAL)y, (REAL)x);
  }
  exactly(zero, zero, zero);
  exactly(zero, -zero, pi);
  exactly(zero, 1, zero);
  exactly(zero, -1, pi);
  exactly(1, zero, pi / 2);
  exactly(1, -zero, pi / 2);
  exactly(1, 1, pi / 4);
  exactly(3, -3, 3 * (pi / 4));
  exactly(2, (REAL)1e-30, pi / 2);
  for (i = 0; i < 2; ++i)
    if (ANGLE(none[i], 1) == ANGLE(none[i], 1) || ANGLE(1, none[i]) == ANGLE(1, none[i])) ++wrong;
  printf("%d %llx %.3Lf\n", wrong, digest, worst);
  return 0;
}
)";

struct Printed {
  int wrong = -1;
  std::string digest;
  double worst = -1;
};

class OwnArctangent : public testing::Test {
 protected:
  void SetUp() override {
    emit_model("four_bar", folder_.path(), {});
    emit_model("four_bar", folder_.path(), {"--language", "c"});
    for (const char* ending : {".c", ".cpp"})
      support::write_file(folder_.path() + "/points" + ending, kPoints);
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
                                        folder_.path() + (is_c ? "/points.c" : "/points.cpp"),
                                        "-o",
                                        folder_.path() + "/points"};
    command.insert(command.end(), flags.begin(), flags.end());
    command.emplace_back("-lm");
    const support::ProcessResult built = support::run_process(command);
    EXPECT_EQ(built.status, 0) << built.output;
    std::istringstream output(support::run_process({folder_.path() + "/points"}).output);
    Printed printed;
    output >> printed.wrong >> printed.digest >> printed.worst;
    return printed;
  }

  support::TemporaryFolder folder_;
};

TEST_F(OwnArctangent, HasTheSameBitsFromEveryCompiler) {
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

TEST_F(OwnArctangent, IsLessThanTwoUnitsOfTheLastPlaceOff) {
  for (const char* real : {"-DFLOAT", "-DDOUBLE"})
    for (const char* contracts : {"-ffp-contract=off", "-ffp-contract=fast"}) {
      const Printed printed = run("g++", {"-O2", "-march=native", contracts, real});
      EXPECT_EQ(printed.wrong, 0) << real;
      EXPECT_LT(printed.worst, 1.65) << real << contracts;
      EXPECT_GT(printed.worst, 0.5) << real << contracts;
    }
}

}  // namespace
}  // namespace jourdain::tests
