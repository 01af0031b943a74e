// SPDX-License-Identifier: MIT
// Many states of one emitted model, stepped side by side in vectors and by several threads:
//
//     #include "panda_kernels.hpp"           // of: jourdain compile panda.toml --packs
//     #include <jourdain/ensemble.hpp>
//
//     jourdain::Ensemble<panda::Model> ensemble(10000);
//     ensemble.run(jourdain::rk4, 1e-3, 500, 4);      // 500 steps of 1 ms, by 4 threads
//     const panda::State<> last = ensemble.state(9999);
//
// What a state ends in depends neither on the number of threads nor on what lies beside it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <future>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "pack.hpp"
#include "stepping.hpp"

namespace jourdain {

/// States of NAME::Model in double or float. `lanes` of them are a block, whose numbers are packs. Sines are computed,
/// or turned.
template <template <class> class ModelOf, class Real = double, std::size_t lanes = natural_lanes<Real>,
          class Sines = ComputedSines>
class Ensemble {
 public:
  using Number = Pack<Real, lanes, Sines>;
  using Model = ModelOf<Real>;
  using BlockModel = ModelOf<Number>;
  using State = typename Model::State;
  using Input = typename Model::Input;
  using Parameters = typename Model::Parameters;

  /// Of the states first to first + lanes - 1; after the ensemble's last one there are copies of it.
  struct Block {
    const BlockModel& model;
    const typename BlockModel::State& state;
    typename BlockModel::Input& input;
    std::size_t index, first;
  };

  /// `count` states, all as the description starts, with inputs of zero. Throws std::invalid_argument without any.
  explicit Ensemble(std::size_t count, const Parameters& parameters = Parameters())
      : count_(count), blocks_((count + lanes - 1) / lanes), parameters_(1), failed_(count, 0) {
    if (count == 0) throw std::invalid_argument("an ensemble of no states");
    for (std::size_t lane = 0; lane < lanes; ++lane) put(parameters_[0], lane, parameters);
    models_.assign(1, BlockModel(parameters_[0]));
    const State start = initial_state(Model(parameters));
    for (std::size_t k = 0; k < count; ++k) {
      set_state(k, start);
      set_input(k, Input{});
    }
  }

  std::size_t count() const noexcept { return count_; }
  std::size_t block_count() const noexcept { return blocks_.size(); }

  State state(std::size_t k) const { return get<State>(blocks_[k / lanes].state, k); }
  /// The state is trusted again.
  void set_state(std::size_t k, const State& state) {
    for (std::size_t to : Places(*this, k)) put(blocks_[to / lanes].state, to, state);
    failed_[k] = 0;
  }
  Input input(std::size_t k) const { return get<Input>(blocks_[k / lanes].input, k); }
  void set_input(std::size_t k, const Input& input) {
    for (std::size_t to : Places(*this, k)) put(blocks_[to / lanes].input, to, input);
  }
  Parameters parameters(std::size_t k) const { return get<Parameters>(parameters_[model_of(k / lanes)], k); }
  /// Of state k alone, which stays as it is: what depends on parameters, as loops do, may have to be set anew.
  void set_parameters(std::size_t k, const Parameters& parameters) {
    if (models_.size() < blocks_.size()) {
      parameters_.resize(blocks_.size(), parameters_[0]);
      models_.resize(blocks_.size(), models_[0]);
    }
    for (std::size_t to : Places(*this, k)) put(parameters_[to / lanes], to, parameters);
    blocks_[k / lanes].has_new_parameters = true;
  }

  /// The data of the functions that the user of emitted code defines, BlockModel::Functions, of all states.
  template <class Functions>
  void set_functions(const Functions& functions) {
    for (BlockModel& model : models_) model.functions = functions;
  }

  /// `steps` steps of length h (s). Before each of a block `before(block, step)` may set the block's inputs by its
  /// state. Blocks are shared evenly among the threads (0: as many as the machine runs at once), which call `before`
  /// and `stepper` at the same time for different ones. A stepper is called with model, state, input and h, and where
  /// it takes that, the block's index, for what methods remember from step to step.
  template <class Stepper, class Before>
  void run(const Stepper& stepper, Real h, std::size_t steps, std::size_t threads, const Before& before) {
    const std::size_t most = threads > 0 ? threads : std::thread::hardware_concurrency();
    const std::size_t parts = std::min(std::max<std::size_t>(1, most), blocks_.size());
    const std::size_t size = (blocks_.size() + parts - 1) / parts;
    const auto run_part = [&](std::size_t begin) {
      for (std::size_t b = begin; b < begin + size && b < blocks_.size(); ++b)
        run_block(b, stepper, h, steps, before);
    };
    std::vector<std::future<void>> others;
    others.reserve(parts);
    for (std::size_t begin = size; begin < blocks_.size(); begin += size) {
      try {
        others.push_back(std::async(std::launch::async, run_part, begin));
      } catch (const std::system_error&) {  // the system has no more threads
        run_part(begin);
      }
    }
    run_part(0);
    for (std::future<void>& other : others) other.get();
  }
  template <class Stepper>
  void run(const Stepper& stepper, Real h, std::size_t steps, std::size_t threads = 1) {
    run(stepper, h, steps, threads, [](const Block&, std::size_t) {});
  }

  /// Whether all of state k was finite after every step since it was set, and its loops closed, as the model judges
  /// (loops_closed), with parameters for which that is proven (loops_proven).
  bool trusted(std::size_t k) const { return !failed_[k] && detail::is_proven<Model>(parameters(k), 0); }
  std::size_t untrusted_count() const {
    std::size_t found = 0;
    for (std::size_t k = 0; k < count_; ++k) found += !trusted(k);
    return found;
  }

 private:
  struct Stored {
    typename BlockModel::State state;
    typename BlockModel::Input input;
    bool has_new_parameters = false;
  };

  /// Where state k lies, and behind the last one the copies of it.
  struct Places {
    struct Place {
      std::size_t k;
      std::size_t operator*() const { return k; }
      Place& operator++() {
        ++k;
        return *this;
      }
      bool operator!=(const Place& other) const { return k != other.k; }
    };
    std::size_t first, last;
    Places(const Ensemble& all, std::size_t k)
        : first(k), last(k + 1 == all.count_ ? all.blocks_.size() * lanes : k + 1) {}
    Place begin() const { return {first}; }
    Place end() const { return {last}; }
  };

  // Emitted structs of packs have a pack for each number of the same struct of scalars.
  template <class Part, class Whole>
  static constexpr std::size_t numbers_of() {
    static_assert(std::is_trivially_copyable_v<Part> && std::is_trivially_copyable_v<Whole>, "numbers alone");
    if constexpr (std::is_empty_v<Part>) {
      return 0;
    } else {
      static_assert(sizeof(Whole) == lanes * sizeof(Part), "numbers alone");
      return sizeof(Part) / sizeof(Real);
    }
  }
  static std::size_t offset(std::size_t number, std::size_t k) {
    return (number * lanes + k % lanes) * sizeof(Real);
  }
  template <class Part, class Whole>
  static Part get(const Whole& whole, std::size_t k) {
    Part part{};
    for (std::size_t i = 0; i < numbers_of<Part, Whole>(); ++i)
      std::memcpy(reinterpret_cast<char*>(&part) + i * sizeof(Real),
                  reinterpret_cast<const char*>(&whole) + offset(i, k), sizeof(Real));
    return part;
  }
  template <class Part, class Whole>
  static void put(Whole& whole, std::size_t k, const Part& part) {
    for (std::size_t i = 0; i < numbers_of<Part, Whole>(); ++i)
      std::memcpy(reinterpret_cast<char*>(&whole) + offset(i, k),
                  reinterpret_cast<const char*>(&part) + i * sizeof(Real), sizeof(Real));
  }

  template <class Stepper, class Before>
  void run_block(std::size_t index, const Stepper& stepper, Real h, std::size_t steps, const Before& before) {
    Stored& stored = blocks_[index];
    if (stored.has_new_parameters)
      models_[index] = detail::with_parameters(models_[index], parameters_[index], 0);
    stored.has_new_parameters = false;
    const BlockModel& model = models_[model_of(index)];
    auto state = stored.state;
    auto input = stored.input;
    const Number length(static_cast<double>(h));
    const std::size_t first = index * lanes;
    Number nothing{};  // stays zero where all are numbers
    for (std::size_t step = 0; step < steps; ++step) {
      before(Block{model, state, input, index, first}, step);
      if constexpr (std::is_invocable_v<const Stepper&, const BlockModel&, decltype(state)&, decltype(input)&,
                                        const Number&, std::size_t>)
        stepper(model, state, input, length, index);
      else
        stepper(model, state, input, length);
      detail::add_nothing(state, nothing);
      if constexpr (detail::HasLoops<Model>::value)
        for (std::size_t k = 0; k < lanes && first + k < count_; ++k)
          if (!Model::loops_closed(get<State>(state, k))) failed_[first + k] = 1;
    }
    for (std::size_t k = 0; k < lanes && first + k < count_; ++k)
      if (!(nothing[k] == 0)) failed_[first + k] = 1;
    stored.state = state;
    stored.input = input;
  }

  std::size_t model_of(std::size_t block) const { return models_.size() == 1 ? 0 : block; }

  std::size_t count_;
  std::vector<Stored> blocks_;
  std::vector<typename BlockModel::Parameters> parameters_;  // one for all, or one for each block
  std::vector<BlockModel> models_;                           // likewise
  std::vector<char> failed_;                                 // of each state
};

}  // namespace jourdain
