// Emitted code on simulated processors: the host's bits, nothing of double where all is float, exact counts.
#include "firmware/firmware.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <sstream>

#include "support/check.hpp"

namespace jourdain::tests {
namespace {

using commands::Target;

/// A processor, and a model in its usual number type.
struct Case {
  Target target;
  Motion motion;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const Target& target : commands::all_targets())
    for (const char* model : kModels) all.push_back({target, motion_of(model, target)});
  return all;
}

void PrintTo(const Case& which, std::ostream* out) {
  *out << which.motion.model << " on " << which.target.name;
}

std::string name_of(const testing::TestParamInfo<Case>& info) {
  std::string name = info.param.target.name + "_" + info.param.motion.model;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

class Firmware : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override { require_tools(GetParam().target); }
};

INSTANTIATE_TEST_SUITE_P(Models, Firmware, testing::ValuesIn(cases()), name_of);

/// The target's numbers are those of the host's C++, bit for bit.
void expect_same_bits(const Target& target, const Motion& motion, const std::vector<Line>& here) {
  const std::vector<Line> there = target_motion(target, motion, Sines::kOwn);
  ASSERT_EQ(here.size(), there.size());
  ASSERT_GE(here.size(), 11u * 5u);  // ten times 20 steps
  for (std::size_t i = 0; i < here.size(); ++i)
    ASSERT_EQ(here[i].bits, there[i].bits) << "line " << i << ", " << here[i].what;
  EXPECT_NE(here.front().bits, here[here.size() * 10 / 11].bits) << "nothing moves";
}

TEST_P(Firmware, HasTheHostsBits) {
  const auto& [target, motion] = GetParam();
  expect_same_bits(target, motion, host_motion(motion, Sines::kOwn));
}

TEST_P(Firmware, HasTheSameBitsInC) {
  const auto& [target, motion] = GetParam();
  Motion in_c = motion;
  in_c.is_c = true;
  expect_same_bits(target, in_c, host_motion(motion, Sines::kOwn));
}

// The libraries' sines are off by less than a unit in the last place, as fdlibm's, from which newlib's and picolibc's
// come, say; glibc's by less. Moving each sine on the host up or down by one unit disturbs the motion as much: what
// that does at the most, in some patterns, is the measure. A library's is another pattern, hence a factor; where
// disturbances cancel by luck another need not, hence the floor.
constexpr double kOtherPattern = 4, kFloor = 4;
constexpr unsigned kPatterns = 4;

TEST_P(Firmware, WithTheLibrarysSinesIsAsNearAsTheseAre) {
  const auto& [target, motion] = GetParam();
  const std::vector<Line> here = host_motion(motion, Sines::kLibrary);
  const std::vector<Line> there = target_motion(target, motion, Sines::kLibrary);
  ASSERT_EQ(here.size(), there.size());
  std::map<std::string, double> disturbed;
  for (unsigned pattern = 0; pattern < kPatterns; ++pattern)
    for (const auto& [what, most] : differences(here, host_motion(motion, Sines::kWobbling, pattern)))
      disturbed[what] = std::max(disturbed[what], most);
  std::string text;
  for (const auto& [what, most] : differences(here, there)) {
    text += fmt::format(" {} {:.1f} ({:.1f})", what, most, disturbed.at(what));
    EXPECT_LE(most, kOtherPattern * disturbed.at(what) + kFloor) << what;
    EXPECT_TRUE(std::isfinite(most)) << what;
  }
  std::cout << fmt::format("units in the last place (of a disturbed library):{}\n", text);
}

/// __aeabi_dadd, __aeabi_cdcmple, __aeabi_f2d, __adddf3 and the like.
bool computes_in_double(const std::string& name) {
  const std::string of_arm = "__aeabi_";
  if (!name.starts_with("__")) return false;
  if (!name.starts_with(of_arm)) return name.find("df", 3) != std::string::npos;
  const std::string what = name.substr(of_arm.size());
  return what.starts_with("d") || what.starts_with("cd") || what.find("2d", 1) != std::string::npos;
}

/// Functions of double arithmetic, of the compiler's library, in a list of symbols.
std::vector<std::string> double_functions(const std::string& symbols) {
  std::vector<std::string> found;
  std::istringstream lines(symbols);
  for (std::string line; std::getline(lines, line);) {
    const std::string name = line.substr(line.rfind(' ') + 1);
    if (computes_in_double(name)) found.push_back(name);
  }
  return found;
}

TEST(FloatFirmware, LinksNothingOfDouble) {
  const Target& target = *commands::find_target("cortex-m4");
  require_tools(target);
  for (const char* model : kModels)
    for (const bool is_c : {false, true}) {
      Motion motion = motion_of(model, "float");
      motion.is_c = is_c;
      for (const Sines sines : {Sines::kOwn, Sines::kLibrary})
        EXPECT_THAT(double_functions(firmware_symbols(target, motion, sines)), testing::IsEmpty())
            << model << (is_c ? " in C" : " in C++");
    }
  // The same in double has them all.
  EXPECT_THAT(double_functions(firmware_symbols(target, motion_of("pendulum", "double"), Sines::kLibrary)),
              testing::IsSupersetOf({"__aeabi_dadd", "__aeabi_dmul"}));
}

std::vector<long> numbers_of(const std::string& output) {
  std::istringstream text(output);
  std::vector<long> numbers;
  for (long number = 0; text >> number;) numbers.push_back(number);
  return numbers;
}

TEST(Counting, IsThatOfALoopOfKnownLengthAndTheSameInEveryRun) {
  for (const Target& target : commands::all_targets()) {
    require_tools(target);
    const std::string output = run_program(target, "counting");
    const std::vector<long> counts = numbers_of(output);
    ASSERT_EQ(counts.size(), 3u) << output;
    // A thousand calls of 2000 rounds more, of two instructions each. A count is a multiple of 40, or exact.
    EXPECT_NEAR(static_cast<double>(counts[1] - counts[0]), 4e6, 2 * 40) << target.name;
    EXPECT_NEAR(static_cast<double>(counts[0]), 2e6, 1000 * 10) << target.name;
    EXPECT_EQ(run_program(target, "counting"), output) << target.name;
  }
}

/// What running a program of programs/ that cannot end well is refused with.
std::string refusal_of(const Target& target, const std::string& program) {
  try {
    return "it wrote " + run_program(target, program);
  } catch (const support::EnvironmentError& error) {
    return error.what();
  }
}

TEST(Board, AFaultAndAStackTooShortEndAProgram) {
  for (const Target& target : commands::all_targets()) {
    require_tools(target);
    EXPECT_THAT(refusal_of(target, "faulting"),
                testing::HasSubstr("status 120:\nthe firmware has made a fault"));
    EXPECT_THAT(refusal_of(target, "deep"), testing::HasSubstr("status 121:\nthe stack is too short"));
  }
}

TEST(Painting, FindsAnArrayOnTheStack) {
  constexpr long kRegisters = 64;  // saved beside the array, and its alignment
  for (const Target& target : commands::all_targets()) {
    require_tools(target);
    const long used = numbers_of(run_program(target, "counting")).at(2);
    EXPECT_GE(used, 1000) << target.name;
    EXPECT_LE(used, 1000 + kRegisters) << target.name;
  }
}

}  // namespace
}  // namespace jourdain::tests
