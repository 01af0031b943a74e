// Andrews' squeezing mechanism, seven bodies in three loops, against digits that were computed independently.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "agreement/shared_data.hpp"
#include "linkage.hpp"
#include "reference/descriptor.hpp"

namespace jourdain::reference {
namespace {

using Long = long double;
using VectorL = Eigen::VectorX<Long>;
using model::Expression;
using model::JointType;
using model::LoopType;
using tests::Linkage;

/// In the order of the coordinates below, which is not that of the published vector.
const std::vector<std::string> kCoordinates = {"beta", "Theta", "gamma", "delta", "Phi", "epsilon", "Omega"};
constexpr std::size_t kPublishedOrder[] = {0, 1, 2, 4, 3, 6, 5};

/// Numbers of the file are decimal and the digits to compare with were computed from them in 80 bits: here they are
/// parameters, so that no number is rounded to double.
class Squeezer {
 public:
  Squeezer() {
    const Expression zero = 0.0, lost_e = minus(number("e"), number("ea"));
    plate(1, number("ra"), zero);
    plate(2, negative("da"), zero);
    plate(3, number("sb"), negative("sa"));
    plate(4, zero, Expression::unary(Expression::Op::kNegate, lost_e));
    plate(5, number("ta"), number("tb"));
    plate(6, minus(number("zf"), number("fa")), zero);
    plate(7, negative("ub"), negative("ua"));
    hinge({}, 0, zero, zero);
    hinge(0, 1, number("rr"), zero);
    hinge({}, 2, number("xB"), number("yB"));
    hinge({}, 4, number("xA"), number("yA"));
    hinge(4, 3, number("zt"), zero);
    hinge({}, 6, number("xA"), number("yA"));
    hinge(6, 5, zero, negative("u"));
    const model::FrameIndex common = linkage_.add_frame(1, {negative("d"), zero, zero});
    close(2, zero, negative("ss"), common);
    close(3, zero, negative("e"), common);
    close(5, number("zf"), zero, common);
    add_forces();
  }

  DescriptorReference<Long> reference() const {
    return DescriptorReference<Long>(linkage_.mechanism, std::span<const Long>(values_));
  }

 private:
  static Expression minus(const Expression& a, const Expression& b) {
    return Expression::binary(Expression::Op::kSubtract, a, b);
  }
  Expression negative(const char* name) { return Expression::unary(Expression::Op::kNegate, number(name)); }

  Expression number(const std::string& name) {
    static const std::map<std::string, const char*> kNumbers = {
        {"m1", "0.04325"},  {"m2", "0.00365"},  {"m3", "0.02373"},  {"m4", "0.00706"},  {"m5", "0.07050"},
        {"m6", "0.00706"},  {"m7", "0.05498"},  {"I1", "2.194e-6"}, {"I2", "4.410e-7"}, {"I3", "5.255e-6"},
        {"I4", "5.667e-7"}, {"I5", "1.169e-5"}, {"I6", "5.667e-7"}, {"I7", "1.912e-5"}, {"d", "0.028"},
        {"da", "0.0115"},   {"e", "0.02"},      {"ea", "0.01421"},  {"rr", "0.007"},    {"ra", "0.00092"},
        {"ss", "0.035"},    {"sa", "0.01874"},  {"sb", "0.01043"},  {"sc", "0.018"},    {"sd", "0.02"},
        {"ta", "0.02308"},  {"tb", "0.00916"},  {"u", "0.04"},      {"ua", "0.01228"},  {"ub", "0.00449"},
        {"zf", "0.02"},     {"zt", "0.04"},     {"fa", "0.01421"},  {"xA", "-0.06934"}, {"yA", "-0.00227"},
        {"xB", "-0.03635"}, {"yB", "0.03273"},  {"xC", "0.014"},    {"yC", "0.072"},    {"c0", "4530"},
        {"l0", "0.07785"},  {"drive", "0.033"}};
    model::Parameter parameter;
    parameter.name = name;
    linkage_.mechanism.parameters.push_back(parameter);
    values_.push_back(std::strtold(kNumbers.at(name), nullptr));
    return Expression::parameter(model::ParameterIndex(values_.size() - 1));
  }

  void plate(int body, const Expression& x, const Expression& y) {
    const Expression mass = number("m" + std::to_string(body));
    linkage_.add_plate(mass, x, y, number("I" + std::to_string(body)));
  }
  void hinge(tests::OptionalBody parent, std::size_t child, const Expression& x, const Expression& y) {
    linkage_.add_joint(JointType::kRevolute, parent, child, {x, y, 0.0});
  }
  /// A pin between a point of a body and the common pin: the published rows are the common pin less the other.
  void close(std::size_t body, const Expression& x, const Expression& y, model::FrameIndex common) {
    linkage_.add_loop(LoopType::kPlanarPin, linkage_.add_frame(body, {x, y, 0.0}), common);
  }
  void add_forces() {
    model::Spring& spring = linkage_.mechanism.springs.emplace_back();
    spring.from = linkage_.add_frame({}, {number("xC"), number("yC"), 0.0});
    spring.to = linkage_.add_frame(2, {number("sd"), negative("sc"), 0.0});
    spring.stiffness = number("c0");
    spring.free_length = number("l0");
    model::CoordinateForce& drive = linkage_.mechanism.coordinate_forces.emplace_back();
    drive.joint = model::JointIndex(0);
    drive.force = number("drive");
  }

  Linkage linkage_;
  std::vector<Long> values_;
};

using Digits = std::map<std::string, Long>;

nlohmann::json squeezer_data() {
  std::ifstream file(tests::data_path("reference/andrews_squeezer.json"));
  return nlohmann::json::parse(file);
}

Long digits(const nlohmann::json& text) { return std::strtold(text.get<std::string>().c_str(), nullptr); }

VectorL of_coordinates(const Digits& values, const std::string& prefix) {
  VectorL result(Eigen::Index(kCoordinates.size()));
  for (std::size_t i = 0; i < kCoordinates.size(); ++i)
    result[Eigen::Index(i)] = values.at(prefix + kCoordinates[i]);
  return result;
}

// What is left of rounding 19 digits: of angles up to 16 rad, through spring and inertias at rates up to 1.4e3 rad/s.
constexpr Long kDigits = 1e-13L;

TEST(AndrewsSqueezer, GivesAccelerationsAndMultipliersInMotion) {
  const nlohmann::json data = squeezer_data();
  Digits values;
  for (const auto& row : data["rows"]) values[row["name"]] = digits(row["computed"]);
  const VectorL y = of_coordinates(values, ""), z = of_coordinates(values, "d"),
                zdot = of_coordinates(values, "dd");
  const auto solution = Squeezer().reference().solve(0.03L, y, z, {});
  EXPECT_LE(solution.loops.g.lpNorm<Eigen::Infinity>(), 1e-17L);
  EXPECT_LE(solution.loops.rate.lpNorm<Eigen::Infinity>(), 1e-14L);
  EXPECT_EQ(solution.loop_rank, 6);
  for (Eigen::Index i = 0; i < 7; ++i)
    EXPECT_NEAR(solution.zdot[i], zdot[i], kDigits * zdot.norm()) << kCoordinates[std::size_t(i)];
  for (Eigen::Index i = 0; i < 6; ++i) {
    const Long expected = values.at("lambda" + std::to_string(i + 1));
    EXPECT_NEAR(solution.loop_lambda[i], expected, kDigits * 200) << "lambda" << i + 1;
  }
}

// The initial angles of the test set; Φ and Ω are opposite.
TEST(AndrewsSqueezer, StartsWithTheCrankAlone) {
  const nlohmann::json data = squeezer_data();
  const Digits values = {
      {"beta", -0.0617138900142764496358948458001L}, {"Theta", 0},
      {"gamma", 0.455279819163070380255912382449L},  {"Phi", 0.222668390165885884674473185609L},
      {"delta", 0.487364979543842550225598953530L},  {"Omega", -0.222668390165885884674473185609L},
      {"epsilon", 1.23054744454982119249735015568L}};
  const auto solution = Squeezer().reference().solve(0, of_coordinates(values, ""), VectorL::Zero(7), {});
  EXPECT_LE(solution.loops.g.lpNorm<Eigen::Infinity>(), 1e-18L);
  for (std::size_t i = 0; i < 7; ++i)
    EXPECT_NEAR(solution.zdot[Eigen::Index(i)], digits(data["initial_accel"][kPublishedOrder[i]]),
                kDigits * 1e4L)
        << kCoordinates[i];
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(solution.loop_lambda[Eigen::Index(i)], digits(data["initial_lambda"][i]), kDigits * 100) << i;
}

}  // namespace
}  // namespace jourdain::reference
