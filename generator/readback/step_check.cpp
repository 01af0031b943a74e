#include "readback/step_check.hpp"

#include <algorithm>

#include "readback/step_data.hpp"
#include "readback/tokens.hpp"

namespace jourdain::readback {

namespace {

/// Beyond that many velocities dense elimination in 70 digits takes its time, and one point has to do.
constexpr std::size_t kManyVelocities = 16;

class StepCheck {
 public:
  StepCheck(const Unit& unit, const Expected& expected, const FunctionApi& api, Findings& findings)
      : unit_(unit), expected_(expected), api_(api), findings_(findings) {}

  void check() {
    const bool can_sample = !expected_.inputs.empty() && !expected_.velocities.empty();
    const int full = api_.implicit ? 1 : api_.history;
    for (int count = full; count >= 0; --count)
      for (const bool sampled : {false, true}) {
        if (sampled && !can_sample) continue;
        const bool often = expected_.velocities.size() <= kManyVelocities;
        for (int repeat = 0; repeat < (often ? 2 : 1); ++repeat)
          point(count, sampled, count == full && !sampled);
      }
  }

 private:
  StepData start(OpaqueSystem& system, int count, bool sampled) const {
    const std::size_t ny = expected_.positions.size(), nz = expected_.velocities.size();
    Random& random = system.random();
    StepData data;
    data.motion = {random.number(), random.vector(ny), random.vector(nz),
                   random.vector(expected_.constraints.empty() ? 0 : 2 + expected_.proven_positions.size())};
    data.h = random.number();
    data.input = random.vector(expected_.inputs.size());
    data.is_sampled = sampled;
    data.count = count;
    for (int i = 0; i < api_.history; ++i) {
      data.ydot.push_back(random.vector(ny));
      data.zdot.push_back(random.vector(nz));
    }
    data.accelerations = random.vector(nz);
    return data;
  }

  void point(int count, bool sampled, bool is_usual) {
    OpaqueSystem system(expected_, ++seed_);
    StepData text = start(system, count, sampled), definition = text;
    const StepExecution execution = step_by_text(unit_, expected_, api_, system, text);
    if (is_usual) record(system, execution);
    system.freeze();
    const std::string method = api_.name.substr(0, api_.name.size() - std::string("_step").size());
    step_by_definition(expected_, method, system, definition);
    if (const std::string unused = system.unused(); !unused.empty())
      throw Refusal("the text evaluates " + unused + " where the method does not");
    ++findings_.points;
    compare(text, definition, execution.largest);
  }

  void record(const OpaqueSystem& system, const StepExecution& execution) {
    StepCost& cost = findings_.steps[api_.name];
    cost.operations = execution.operations + system.operations_of_calls();
    cost.evaluations = system.calls(api_.implicit ? "residual" : "forward_dynamics");
    if (!expected_.velocities.empty()) return;
    const std::string method = api_.name.substr(0, api_.name.size() - std::string("_step").size());
    const Tableau* tableau = find_tableau(method);
    const RosenbrockTable* rosenbrock = find_rosenbrock_table(method);
    cost.evaluations = static_cast<int>(tableau ? tableau->b.size() : rosenbrock ? rosenbrock->m.size() : 1);
  }

  void compare(const char* what, const ExactVector& found, const ExactVector& wanted, double scale) {
    for (std::size_t i = 0; i < std::max(found.size(), wanted.size()); ++i) {
      ++findings_.numbers;
      if (i >= found.size() || i >= wanted.size() || !is_close(found[i], wanted[i], scale))
        return findings_.add("{}: entry {} of {} is not that of the method", api_.name, i, what);
    }
  }

  void compare(const StepData& found, const StepData& wanted, double scale) {
    if (expected_.clock) compare("state.t", {found.motion.t}, {wanted.motion.t}, scale);
    compare("state.y", found.motion.y, wanted.motion.y, scale);
    compare("state.z", found.motion.z, wanted.motion.z, scale);
    compare("what a closing leaves in state", found.motion.guards, wanted.motion.guards, scale);
    if (found.count != wanted.count)
      findings_.add("{}: count is {}, must be {}", api_.name, found.count, wanted.count);
    if (api_.implicit) compare("accelerations.zdot", found.accelerations, wanted.accelerations, scale);
    for (std::size_t i = 0; i < found.ydot.size(); ++i) {
      compare("history.ydot", found.ydot[i], wanted.ydot[i], scale);
      compare("history.zdot", found.zdot[i], wanted.zdot[i], scale);
    }
  }

  const Unit& unit_;
  const Expected& expected_;
  const FunctionApi& api_;
  Findings& findings_;
  std::uint64_t seed_ = 0;
};

}  // namespace

void check_steps(const Unit& unit, const Expected& expected, Findings& findings) {
  for (const std::string& name : expected.functions) {
    const std::optional<FunctionApi> api = api_of(name, expected);
    if (!api || api->result != Result::kStep) continue;
    findings.guarded(name, [&] { StepCheck(unit, expected, *api, findings).check(); });
  }
}

}  // namespace jourdain::readback
