#include "studies/step_cost.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>

#if defined(__SSE2__)
#include <pmmintrin.h>
#endif

namespace jourdain::studies {

namespace {

using Clock = std::chrono::steady_clock;

constexpr long kBlock = 500;  ///< steps of one method before the next one's turn
constexpr long kRun = 1000;   ///< steps from one start
constexpr int kRounds = 15;   ///< of blocks of single steps from one state
constexpr long kOfRound = 100;
constexpr long kClockReadings = 2000;
constexpr double kTurn = 6.283185307179586;  ///< rad
constexpr std::size_t kLine = 64;            ///< bytes, of a cache

/// Subnormal operands and results are zeros while it lives.
class FlushToZero {
 public:
#if defined(__SSE2__)
  static constexpr bool kKnown = true;
  FlushToZero() : before_(_mm_getcsr()) { _mm_setcsr(before_ | _MM_FLUSH_ZERO_ON | _MM_DENORMALS_ZERO_ON); }
  ~FlushToZero() { _mm_setcsr(before_); }
#else
  static constexpr bool kKnown = false;
  FlushToZero() = default;
  ~FlushToZero() = default;
#endif
  FlushToZero(const FlushToZero&) = delete;
  FlushToZero& operator=(const FlushToZero&) = delete;

 private:
  [[maybe_unused]] unsigned before_ = 0;
};

/// Reads and writes so many bytes that nothing else stays in a data cache, nor in one that holds code as well.
class Evictor {
 public:
  Evictor() : bytes_(evicting_bytes()) {}

  void evict() {
    for (std::size_t i = 0; i < bytes_.size(); i += kLine) {
      volatile char& byte = bytes_[i];
      byte = static_cast<char>(byte + 1);
    }
  }

 private:
  std::vector<char> bytes_;
};

/// Single steps of one method from a point.
class Stepping {
 public:
  Stepping(const Flow<double>& flow, std::size_t method, double h)
      : flow_(flow), method_(flow.table().methods[method]), h_(h), u_(flow.inputs().at(0.0)) {
    start_ = flow.start();
    memory_ = flow.fresh_memory(method_);
    for (int i = 0; i < std::max(1, method_.history); ++i) take_steps(start_, memory_, 1);
    rewind();
  }

  const Point<double>& start() const { return start_; }
  /// From now on from these positions and velocities.
  void set_start(const std::vector<double>& x) { start_.x = x; }
  /// From now on from where it has come to, unless that is not finite.
  void start_here() {
    if (!finite()) return;
    start_ = now_;
    memory_ = now_memory_;
  }
  void rewind() {
    now_ = start_;
    now_memory_ = memory_;
  }
  /// Time of one step from where it is, s, with that of the call and the clock.
  double step(long count = 1) {
    const auto begin = Clock::now();
    advance(count);
    return std::chrono::duration<double>(Clock::now() - begin).count();
  }
  void advance(long count) { take_steps(now_, now_memory_, count); }
  bool finite() const {
    return std::all_of(now_.x.begin(), now_.x.end(), [](double entry) { return std::isfinite(entry); });
  }

 private:
  void take_steps(Point<double>& point, Memory& memory, long count) {
    const jourdain_inputs inputs{u_.data(), nullptr, nullptr};
    method_.steps(&point.t, point.x.data(), point.x.data() + flow_.position_count(), &inputs, &h_, count,
                  memory.data());
  }

  const Flow<double>& flow_;
  const jourdain_method& method_;
  double h_;
  std::vector<double> u_;
  Point<double> start_, now_;
  Memory memory_, now_memory_;
};

double median(std::vector<double> samples) {
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  std::nth_element(samples.begin(), middle, samples.end());
  return *middle;
}

/// Of a call that makes no step, s.
double call_time(Stepping& stepping) {
  std::vector<double> samples;
  for (long i = 0; i < kClockReadings; ++i) samples.push_back(stepping.step(0));
  return median(std::move(samples));
}

/// Nothing takes less than a picosecond, whatever the clock says.
double net(double time, double overhead) { return std::max(time - overhead, 1e-12); }

/// Some methods and what calling them takes.
struct Measured {
  Stepping stepping;
  double overhead = 0;
  std::vector<double> warm, cold;
  long restarts = 0;
};

void step_warm(Measured& m, long count) {
  for (long i = 0; i < count; ++i) {
    const bool diverged = !m.stepping.finite();
    if (diverged) ++m.restarts;
    if (diverged || m.warm.size() % kRun == 0) m.stepping.rewind();
    m.warm.push_back(net(m.stepping.step(), m.overhead));
  }
}

void step_cold(Measured& m, Evictor& evictor) {
  m.stepping.rewind();
  evictor.evict();
  m.cold.push_back(net(m.stepping.step(), m.overhead));
}

/// A state to step from, with or without flushing.
struct Variant {
  Stepping stepping;
  bool flushes = false;
  std::vector<double> samples = {};
};

/// Of steps from the same state, or of calls that make none, with what it takes to go back there; s for each.
double repeated(Stepping& stepping, long count) {
  const auto begin = Clock::now();
  for (long i = 0; i < kOfRound; ++i) {
    stepping.rewind();
    stepping.advance(count);
  }
  return std::chrono::duration<double>(Clock::now() - begin).count() / double(kOfRound);
}

/// One step from there, s.
double net_step(Stepping& stepping) {
  const double step = repeated(stepping, 1);
  return net(step, repeated(stepping, 0));
}

/// Medians of one step from each, blocks taken in turns, s.
std::vector<double> medians(std::vector<Variant>& variants) {
  for (int round = 0; round < kRounds; ++round)
    for (Variant& variant : variants) {
      std::optional<FlushToZero> flush;
      if (variant.flushes) flush.emplace();
      variant.samples.push_back(net_step(variant.stepping));
    }
  std::vector<double> result;
  for (Variant& variant : variants) result.push_back(median(std::move(variant.samples)));
  return result;
}

Stepping moved(Stepping stepping, const std::function<void(std::vector<double>&)>& change) {
  std::vector<double> x = stepping.start().x;
  change(x);
  stepping.set_start(x);
  return stepping;
}

/// Fills in what steps from other states cost, over steps from one on the way: at a start in rest many numbers
/// are zero.
void compare_states(Stepping plain, const Flow<double>& flow, const std::vector<bool>& angular,
                    StepCost& cost) {
  plain.rewind();
  plain.advance(kRun / 2);
  plain.start_here();
  const Stepping faint = moved(plain, [&flow](std::vector<double>& x) {
    std::fill(x.begin() + static_cast<std::ptrdiff_t>(flow.position_count()), x.end(),
              faint_velocity(flow.table().unit_roundoff));
  });
  const auto turned = [&](double angle) {
    return moved(plain, [&](std::vector<double>& x) {
      for (std::size_t i = 0; i < angular.size(); ++i)
        if (angular[i]) x[i] += kTurn * std::round(angle / kTurn);
    });
  };
  const bool turns = std::find(angular.begin(), angular.end(), true) != angular.end();
  std::vector<Variant> variants = {{plain}, {faint}, {faint, true}, {turned(1e3)}, {turned(1e6)}};
  const std::vector<double> times = medians(variants);
  cost.subnormal = times[1] / times[0];
  if (FlushToZero::kKnown) cost.flushed = times[2] / times[0];
  if (!turns) return;
  cost.thousand = times[3] / times[0];
  cost.million = times[4] / times[0];
}

}  // namespace

std::size_t last_cache() {
  std::size_t kilobytes = 0;
  std::ifstream("/sys/devices/system/cpu/cpu0/cache/index3/size") >> kilobytes;
  if (kilobytes > 0) return kilobytes * 1024;
  const long bytes = sysconf(_SC_LEVEL3_CACHE_SIZE);
  return bytes > 0 ? static_cast<std::size_t>(bytes) : 0;
}

double clock_tick() {
  double least = 1;
  for (long i = 0; i < kClockReadings; ++i) {
    const auto begin = Clock::now();
    auto end = begin;
    while (end == begin) end = Clock::now();
    least = std::min(least, std::chrono::duration<double>(end - begin).count());
  }
  return least;
}

Quantiles quantiles_of(std::vector<double> samples) {
  std::sort(samples.begin(), samples.end());
  const auto at = [&samples](double q) {
    const double rank = std::ceil(q * static_cast<double>(samples.size()) - 1e-9);
    return samples[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
  };
  return {static_cast<long>(samples.size()), at(0.5), at(0.99), at(0.999), samples.back()};
}

std::size_t evicting_bytes() {
  constexpr std::size_t kUsual = std::size_t(64) << 20, kMost = std::size_t(384) << 20;
  const std::size_t cache = last_cache();
  return cache == 0 ? kUsual : std::min(2 * cache, kMost);
}

double faint_velocity(double unit_roundoff) { return unit_roundoff < 1e-10 ? 1e-160 : 1e-20; }

std::vector<StepCost> measure_step_costs(const Flow<double>& flow, const std::vector<bool>& angular,
                                         const StepCostOptions& options, const Progress& progress) {
  std::vector<Measured> all;
  const auto count = static_cast<std::size_t>(flow.table().method_count);
  for (std::size_t m = 0; m < count; ++m) {
    all.push_back({Stepping(flow, m, options.h), 0, {}, {}, 0});
    all.back().overhead = call_time(all.back().stepping);
  }
  for (long done = 0; done < options.warm; done += kBlock) {
    progress("warm steps", double(done) / double(options.warm));
    for (Measured& m : all) step_warm(m, std::min(kBlock, options.warm - done));
  }
  Evictor evictor;
  for (long done = 0; done < options.cold; ++done) {
    progress("cold steps", double(done) / double(options.cold));
    for (Measured& m : all) step_cold(m, evictor);
  }
  std::vector<StepCost> costs;
  for (std::size_t m = 0; m < count; ++m) {
    progress("steps from other states", double(m) / double(count));
    StepCost& cost = costs.emplace_back();
    cost.method = m;
    cost.warm = quantiles_of(std::move(all[m].warm));
    cost.restarts = all[m].restarts;
    cost.cold = quantiles_of(std::move(all[m].cold));
    compare_states(all[m].stepping, flow, angular, cost);
  }
  return costs;
}

}  // namespace jourdain::studies
