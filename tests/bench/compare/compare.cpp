// Emitted code side by side with libraries of rigid bodies that Debian has: ./dev bench. The same robots, states and
// results; a library whose results differ is not timed. Blocks take turns over the libraries, because machines are
// shared and noisy. Nothing is asserted here.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>

#include "bench/compare/emitted.hpp"
#include "bench/compare/robots.hpp"
#include "support/uniform.hpp"

namespace jourdain::compare {

const char* name_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::kForward:
      return "forward dynamics";
    case Quantity::kInverse:
      return "inverse dynamics";
    case Quantity::kMass:
      return "mass matrix";
    case Quantity::kStep:
      return "RK4 step";
  }
  return "";
}

namespace {

constexpr std::size_t kSamples = 16;
constexpr int kBlocks = 150;
constexpr double kBlockLength = 50e-6;  // s
/// Results differ by at most this, of the largest entry: rounding, times what is lost in a badly conditioned M.
/// MuJoCo's step turns quaternions by a rotation vector, not by its rate: h⁵ apart.
constexpr double kTolerance = 1e-8;

std::vector<Sample> draw(const Robot& robot) {
  support::Uniform uniform(1);
  std::vector<Sample> samples(kSamples);
  for (Sample& s : samples) {
    for (std::size_t i = 0; i < robot.positions(); ++i) s.y.push_back(uniform(-2, 2));
    for (std::size_t i = 0; i < robot.velocities(); ++i) s.z.push_back(uniform(-1, 1));
    for (std::size_t i = 0; i < robot.velocities(); ++i) s.zdot.push_back(uniform(-5, 5));
    if (!robot.has_free_root()) continue;
    double square = 0;
    for (std::size_t i = 3; i < 7; ++i) square += s.y[i] * s.y[i];
    for (std::size_t i = 3; i < 7; ++i) s.y[i] /= std::sqrt(square);
  }
  return samples;
}

/// Largest difference over the samples, of the largest entry.
double difference(Library& a, Library& b, Quantity quantity, const std::vector<Sample>& samples) {
  double worst = 0;
  for (std::size_t sample = 0; sample < kSamples; ++sample) {
    std::vector<double> left = a.result(quantity, sample), right = b.result(quantity, sample);
    if (left.size() != right.size()) return INFINITY;
    if (quantity == Quantity::kStep) {  // how fast the state moved
      std::vector<double> start = samples[sample].y;
      start.insert(start.end(), samples[sample].z.begin(), samples[sample].z.end());
      for (std::vector<double>* end : {&left, &right})
        for (std::size_t i = 0; i < start.size(); ++i) (*end)[i] = ((*end)[i] - start[i]) / kStepLength;
    }
    double size = 0, apart = 0;
    for (std::size_t i = 0; i < left.size(); ++i) {
      size = std::max(size, std::abs(left[i]));
      apart = std::max(apart, std::abs(left[i] - right[i]));
      if (!std::isfinite(right[i])) return INFINITY;
    }
    worst = std::max(worst, apart / size);
  }
  return worst;
}

struct Timed {
  Library* library = nullptr;
  double apart = 0;
  int times = 1;
  std::vector<double> nanoseconds = {};

  /// ns a call.
  double block(Quantity quantity) {
    const auto begin = std::chrono::steady_clock::now();
    library->run(quantity, times);
    const std::chrono::duration<double, std::nano> passed = std::chrono::steady_clock::now() - begin;
    return passed.count() / times / static_cast<double>(kSamples);
  }
};

void compare(const std::string& robot, Quantity quantity, const std::vector<Sample>& samples,
             const std::vector<std::unique_ptr<Library>>& libraries) {
  std::vector<Timed> rows;
  for (const auto& library : libraries) {
    if (library->calls(quantity).empty()) continue;
    const double apart = difference(*libraries.front(), *library, quantity, samples);
    if (apart <= kTolerance)
      rows.push_back({library.get(), apart});
    else
      fmt::print("{:<16} {:<17} {:<20} differs by {:.1e}: not timed\n", robot, name_of(quantity),
                 library->name(), apart);
  }
  for (Timed& row : rows)
    while (row.block(quantity) * row.times * kSamples < kBlockLength * 1e9 / 1.5) row.times *= 2;
  for (int i = 0; i < kBlocks; ++i)
    for (Timed& row : rows) row.nanoseconds.push_back(row.block(quantity));
  for (Timed& row : rows) std::sort(row.nanoseconds.begin(), row.nanoseconds.end());
  for (const Timed& row : rows)
    fmt::print("{:<16} {:<17} {:<20} {:>10.1f} {:>10.1f} {:>7.2f} {:>9.0e}   {}\n", robot, name_of(quantity),
               row.library->name(), row.nanoseconds.front(), row.nanoseconds[kBlocks / 2],
               row.nanoseconds.front() / rows.front().nanoseconds.front(), row.apart,
               row.library->calls(quantity));
}

template <class Model>
void compare_robot(const std::string& name, const std::string& path, bool free_root,
                   const std::vector<std::string>& locked) {
  const Robot robot = read_robot(path, free_root, locked);
  const std::vector<Sample> samples = draw(robot);
  std::vector<std::unique_ptr<Library>> libraries;
  libraries.push_back(std::make_unique<Emitted<Model>>(samples));
  libraries.push_back(make_ensemble(name, samples));
  for (const auto make : {make_kdl, make_mujoco, make_simbody, make_bullet}) try {
      if (std::unique_ptr<Library> library = make(robot, samples)) libraries.push_back(std::move(library));
    } catch (const std::exception& error) {
      fmt::print("{:<16} a library does not take it: {}\n", name, error.what());
    }
  for (const Quantity quantity : kQuantities) compare(name, quantity, samples, libraries);
}

}  // namespace
}  // namespace jourdain::compare

int main() {
  using namespace jourdain::compare;
  fmt::print("emitted code by {}; libraries as Debian built them; one thread, ratios of the least times\n",
             kEmittedBy);
  fmt::print("{}", kLeftOut);
  fmt::print("{:<16} {:<17} {:<20} {:>10} {:>10} {:>7} {:>9}   {}\n", "robot", "", "", "ns, least",
             "ns, median", "ratio", "differs", "calls");
#define JOURDAIN_COMPARE(name, path, is_free, ...) \
  compare_robot<bench_##name::Model<double>>(#name, path, is_free, {__VA_ARGS__});
  JOURDAIN_ROBOTS(JOURDAIN_COMPARE)
}
