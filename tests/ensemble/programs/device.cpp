// States of an ensemble of a device, in all their digits.
#include <jourdain/device_ensemble.hpp>
// Behind what marks emitted functions for the device.
#include KERNELS
#if defined(FUNCTIONS)
#include FUNCTIONS
#endif

#include <cstdio>

using Many = jourdain::DeviceEnsemble<MODEL, REAL>;

struct Turning {
  JOURDAIN_FUNCTION void operator()(std::size_t k, std::size_t step, Many::State& state, Many::Input&) const {
    if (step == 0) state.z[0] += static_cast<REAL>(k) * static_cast<REAL>(0.001);
  }
};

#if defined(STEP)
using Memory = NAME::Accelerations<REAL>;

struct Stepper {
  Memory* memories;
  JOURDAIN_FUNCTION void operator()(const NAME::Model<REAL>& model, Many::State& state,
                                    const Many::Input& input, REAL h, std::size_t k) const {
    NAME::STEP(model, state, input, h, memories[k]);
  }
};
#endif

int main() {
  Many ensemble(300);
  ensemble.set_parameters(7, Many::Parameters());
#if defined(STEP)
  jourdain::OnDevice<Memory> memories(ensemble.count());
  ensemble.run(Stepper{memories.write_on_device()}, static_cast<REAL>(0.001), 20, Turning());
#else
  ensemble.run(jourdain::rk4, static_cast<REAL>(0.001), 20, Turning());
#endif
  for (std::size_t k = 0; k < ensemble.count(); k += 13) {
    for (const REAL y : ensemble.state(k).y) std::printf("%a ", static_cast<double>(y));
    for (const REAL z : ensemble.state(k).z) std::printf("%a ", static_cast<double>(z));
    std::printf("%d\n", ensemble.trusted(k));
  }
}
