// Emitted models in ensembles: the rollouts that sampling controllers run, one thread.
#include "jourdain/ensemble.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/compare/library.hpp"
#include "bench/compare/packs.hpp"
#include "bench/compare/robots.hpp"

namespace jourdain::compare {

namespace {

template <template <class> class Model>
class Lanes : public Library {
 public:
  explicit Lanes(const std::vector<Sample>& samples) : ensemble_(samples.size()), samples_(samples) {}

  std::string name() const override { return fmt::format("Jourdain, {} at once", Many::Number::size); }
  std::string calls(Quantity quantity) const override {
    return quantity == Quantity::kStep ? "Ensemble::run, rk4" : "";
  }

  std::vector<double> result(Quantity, std::size_t sample) override {
    start();
    ensemble_.run(rk4, kStepLength, 1);
    const typename Many::State state = ensemble_.state(sample);
    std::vector<double> values(std::begin(state.y), std::end(state.y));
    values.insert(values.end(), std::begin(state.z), std::end(state.z));
    return values;
  }

  void run(Quantity, int times) override {
    start();
    ensemble_.run(rk4, kStepLength, static_cast<std::size_t>(times));
  }

 private:
  using Many = Ensemble<Model>;

  void start() {
    typename Many::State state{};
    for (std::size_t k = 0; k < samples_.size(); ++k) {
      std::copy(samples_[k].y.begin(), samples_[k].y.end(), state.y);
      std::copy(samples_[k].z.begin(), samples_[k].z.end(), state.z);
      ensemble_.set_state(k, state);
    }
  }

  Many ensemble_;
  std::vector<Sample> samples_;
};

}  // namespace

std::unique_ptr<Library> make_ensemble(const std::string& robot, const std::vector<Sample>& samples) {
#define JOURDAIN_LANES(name, ...) \
  if (robot == #name) return std::make_unique<Lanes<bench_##name##_packs::Model>>(samples);
  JOURDAIN_ROBOTS(JOURDAIN_LANES)
  return nullptr;
}

}  // namespace jourdain::compare
