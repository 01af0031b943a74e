// A step of the text over numbers of many digits.
#include <fmt/format.h>

#include "readback/step_data.hpp"
#include "readback/tokens.hpp"

namespace jourdain::readback {

namespace {

class TextStep {
 public:
  TextStep(const Unit& unit, const Expected& expected, OpaqueSystem& system)
      : expected_(expected), system_(system), run_(unit, numbers_), in_c_(unit.is_c) {
    replace_functions();
  }

  StepExecution take(const FunctionApi& api, StepData& data) {
    const Value model = run_.make(of_number("Model")), state = run_.make(of_number("State"));
    write_motion(state, data.motion);
    std::vector<Value> arguments = {Interpreter::as_const(model), state, Interpreter::as_const(input(data))};
    const Value h = run_.make(run_.types().number());
    run_.set(h, numbers_.number(data.h));
    arguments.push_back(h);
    const Value memory = remembered(api, data);
    if (memory.kind == Value::Kind::kPlace) arguments.push_back(memory);
    numbers_.clear_count();
    run_.call("", in_c_ && data.is_sampled ? api.name + "_sampled" : api.name, arguments);
    const std::size_t operations = numbers_.count().arithmetic();
    data.motion = read_motion(state);
    if (memory.kind == Value::Kind::kPlace) remember(api, memory, data);
    return {operations, numbers_.largest()};
  }

 private:
  const Type* of_number(const std::string& name) {
    return run_.types().instance(name, {{0, run_.types().number(), 0}});
  }

  void write(const Value& place, const ExactVector& values) {
    for (std::size_t i = 0; i < values.size(); ++i)
      run_.cell(place, i) = number_cell(numbers_.number(values[i]));
  }

  ExactVector read(const Value& place) {
    ExactVector values;
    for (std::size_t i = 0; i < place.type->cells; ++i) {
      const Cell& held = run_.cell(place, i);
      if (held.kind != Cell::Kind::kNumber) throw Refusal("a step leaves or passes on what has no value");
      values.push_back(numbers_[held.number]);
    }
    return values;
  }

  void write(const Value& place, const ExactMatrix& values) {
    for (std::size_t i = 0; i < values.size(); ++i) write(run_.entry(place, i), values[i]);
  }

  void write_motion(const Value& state, const Motion& motion) {
    ExactVector all;
    if (expected_.clock) all.push_back(motion.t);
    for (const ExactVector* part : {&motion.y, &motion.z, &motion.guards})
      all.insert(all.end(), part->begin(), part->end());
    if (all.size() != state.type->cells) throw Refusal("a State of another size");
    write(state, all);
  }

  Motion read_motion(const Value& state) {
    const ExactVector all = read(state);
    const auto begin = all.begin() + expected_.clock,
               z = begin + static_cast<long>(expected_.positions.size()),
               guards = z + static_cast<long>(expected_.velocities.size());
    return {expected_.clock ? all[0] : exact(0.0), ExactVector(begin, z), ExactVector(z, guards),
            ExactVector(guards, all.end())};
  }

  Value input(const StepData& data) {
    const Type* type = of_number("Input");
    if (data.is_sampled)
      return run_.make_function(
          [this](const Value& state, const Value& result) {
            write(result, system_.sample(read_motion(state)));
          },
          type);
    const Value place = run_.make(type);
    write(place, data.input);
    return place;
  }

  Value remembered(const FunctionApi& api, const StepData& data) {
    if (api.history == 0 && !api.implicit) return {};
    const Type* number = run_.types().number();
    const Value memory = run_.make(
        api.implicit ? of_number("Accelerations")
        : in_c_      ? of_number(fmt::format("RateHistory{}", api.history))
                     : run_.types().instance("RateHistory", {{0, nullptr, api.history}, {0, number, 0}}));
    run_.cell(run_.field(memory, "count")) = integer_cell(data.count);
    if (expected_.velocities.empty()) return memory;
    if (api.implicit) {
      write(run_.field(memory, "zdot"), data.accelerations);
    } else {
      write(run_.field(memory, "ydot"), data.ydot);
      write(run_.field(memory, "zdot"), data.zdot);
    }
    return memory;
  }

  void remember(const FunctionApi& api, const Value& memory, StepData& data) {
    data.count = static_cast<int>(run_.cell(run_.field(memory, "count")).integer);
    if (expected_.velocities.empty()) return;
    const Value zdot = run_.field(memory, "zdot");
    if (api.implicit) {
      data.accelerations = read(zdot);
      return;
    }
    for (std::size_t i = 0; i < data.ydot.size(); ++i) {
      data.ydot[i] = read(run_.entry(run_.field(memory, "ydot"), i));
      data.zdot[i] = read(run_.entry(zdot, i));
    }
  }

  void replace_functions() {
    run_.replace("position_rate", [this](const std::vector<Value>& arguments) {
      write(arguments[2], system_.position_rate(read_motion(arguments[1])));
    });
    run_.replace("forward_dynamics", [this](const std::vector<Value>& arguments) {
      write(arguments[3], system_.forward_dynamics(read_motion(arguments[1]), read(arguments[2])));
    });
    run_.replace("sample", [this](const std::vector<Value>& arguments) {
      Motion motion = read_motion(arguments[1]);
      system_.take_samples(motion, read(arguments[2]), read(arguments[3])[0]);
      write_motion(arguments[1], motion);
    });
    run_.replace("residual", [this](const std::vector<Value>& arguments) {
      write(arguments[4],
            system_.residual(read_motion(arguments[1]), read(arguments[2]), read(arguments[3])));
    });
    run_.replace("residual_derivatives", [this](const std::vector<Value>& a) { derivatives(a); });
    for (const char* name : {"close_loops", "project"})
      run_.replace(name, [this](const std::vector<Value>& arguments) {
        Motion motion = read_motion(arguments[1]);
        system_.correct(motion);
        write_motion(arguments[1], motion);
      });
  }

  void derivatives(const std::vector<Value>& arguments) {
    const Derivatives d =
        system_.residual_derivatives(read_motion(arguments[1]), read(arguments[2]), read(arguments[3]));
    std::size_t next = 4;
    for (const ExactMatrix* matrix : {&d.M, &d.r_y, &d.r_z}) write(arguments[next++], *matrix);
    if (!expected_.inputs.empty()) write(arguments[next++], d.r_u);
    if (expected_.dynamics_depend_on_time) write(arguments[next++], d.r_t);
  }

  const Expected& expected_;
  OpaqueSystem& system_;
  Reals numbers_;
  Interpreter run_;
  bool in_c_;
};

}  // namespace

StepExecution step_by_text(const Unit& unit, const Expected& expected, const FunctionApi& api,
                           OpaqueSystem& system, StepData& data) {
  return TextStep(unit, expected, system).take(api, data);
}

}  // namespace jourdain::readback
