#include "agreement/compiled_batch.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <stdexcept>

#include "compile/compile.hpp"
#include "support/diagnostics.hpp"
#include "support/files.hpp"
#include "support/process.hpp"

namespace jourdain::tests {

namespace {

using Evaluate = void (*)(double t, const double* p, const double* y, const double* z, const double* u,
                          const double* zdot, double h, double* results);

/// Generic over Model: functions are found by argument-dependent lookup, sizes are the model's, and what a
/// scene does not have is left out. Outputs are nothing but numbers.
constexpr const char* kDriver = R"(
template <class State, class Real>
auto set_time(State& state, Real t, int) -> decltype(void(state.t)) { state.t = t; }
template <class State, class Real>
void set_time(State&, Real, long) {}

// With inputs where prescribed accelerations depend on them.
template <class Model, class State, class Input, class Array>
auto inertia_terms(const Model& model, const State& state, const Input&, Array& k, int)
    -> decltype(k_bar(model, state, k)) { k_bar(model, state, k); }
template <class Model, class State, class Input, class Array>
void inertia_terms(const Model& model, const State& state, const Input& input, Array& k, long) {
  k_bar(model, state, input, k);
}
template <class Model, class State, class Input, class Array>
auto missing_forces(const Model& model, const State& state, const Input&, const Array& zdot, Array& tau, int)
    -> decltype(inverse_dynamics(model, state, zdot, tau)) { inverse_dynamics(model, state, zdot, tau); }
template <class Model, class State, class Input, class Array>
void missing_forces(const Model& model, const State& state, const Input& input, const Array& zdot, Array& tau, long) {
  inverse_dynamics(model, state, input, zdot, tau);
}

// Whether there is one.
template <class Model, class State, class Array>
auto rate_of(const Model& model, const State& state, Array& ydot, int)
    -> decltype(position_rate(model, state, ydot), bool()) { position_rate(model, state, ydot); return true; }
template <class Model, class State, class Array>
bool rate_of(const Model&, const State&, Array&, long) { return false; }

template <class Model>
void evaluate(const Model& model, double t, const double* y, const double* z, const double* u, const double* zdot,
              double h, double* out) {
  using Real = typename Model::Scalar;
  constexpr int ny = Model::position_count, nz = Model::velocity_count;
  typename Model::State state = initial_state(model);
  set_time(state, static_cast<Real>(t), 0);
  typename Model::Input input{};
  if constexpr (Model::input_count > 0)
    for (int i = 0; i < Model::input_count; ++i) input.u[i] = static_cast<Real>(u[i]);
  static_cast<void>(u);
  static_cast<void>(y);
  static_cast<void>(z);
  static_cast<void>(zdot);
  const auto write = [&out](const auto& values) {
    for (const auto& value : values) *out++ = static_cast<double>(value);
  };
  if constexpr (nz > 0) {
    for (int i = 0; i < ny; ++i) state.y[i] = static_cast<Real>(y[i]);
    for (int i = 0; i < nz; ++i) state.z[i] = static_cast<Real>(z[i]);
    Real M[nz][nz], v[nz], a[nz];
    mass_matrix(model, state, M);
    for (int i = 0; i < nz; ++i)
      for (int j = i; j < nz; ++j) *out++ = M[j][i] == M[i][j] ? static_cast<double>(M[i][j]) : 1e300;
    inertia_terms(model, state, input, v, 0);
    write(v);
    q_bar(model, state, input, v);
    write(v);
    forward_dynamics(model, state, input, v);
    write(v);
    for (int i = 0; i < nz; ++i) a[i] = static_cast<Real>(zdot[i]);
    missing_forces(model, state, input, a, v, 0);
    write(v);
  }
  *out++ = static_cast<double>(kinetic_energy(model, state));
  *out++ = static_cast<double>(potential_energy(model, state));
  if constexpr (ny > 0) {
    Real ydot[ny] = {};
    if (rate_of(model, state, ydot, 0)) write(ydot);
  }
  if constexpr (Model::output_count > 0) {
    typename Model::Outputs results;
    outputs(model, state, input, results);
    Real numbers[sizeof results / sizeof(Real)];
    memcpy(numbers, &results, sizeof results);
    write(numbers);
  }
  rk4_step(model, state, input, static_cast<Real>(h));
  if constexpr (nz > 0) {
    write(state.y);
    write(state.z);
  }
}
)";

std::string driver(const std::vector<EmittedModel>& models, const std::string& real) {
  std::string text = "#include <string.h>\n";
  for (const EmittedModel& model : models) text += fmt::format("#include \"{}_kernels.hpp\"\n", model.name);
  text += kDriver;
  for (const EmittedModel& model : models) {
    std::string assignments;
    for (std::size_t i = 0; i < model.parameters.size(); ++i)
      assignments += fmt::format("  parameters.{} = static_cast<{}>(p[{}]);\n", model.parameters[i], real, i);
    text += fmt::format(
        "extern \"C\" void evaluate_{0}(double t, const double* p, const double* y, const double* z, const "
        "double* u, "
        "const double* "
        "zdot, double h, double* out);\n"
        "void evaluate_{0}(double t, const double* p, const double* y, const double* z, const double* u, "
        "const double* "
        "zdot, double "
        "h, double* out) {{\n  {0}::Parameters<{1}> parameters;\n  static_cast<void>(p);\n{2}"
        "  evaluate({0}::Model<{1}>(parameters), t, y, z, u, zdot, h, out);\n}}\n",
        model.name, real, assignments);
  }
  return text;
}

}  // namespace

EmittedModel emit_model(const Derived& derived, const std::string& name) {
  CompileOptions options;
  options.name = name;
  options.path = name + ".toml";
  CompiledModel compiled;
  compiled.facts = programs::scene_facts(derived.mechanism, nullptr, options.wishes());
  compiled.functions = programs::with_needed(options.functions, compiled.facts);
  compiled.module = derived.module;
  validate_and_emit(derived.mechanism, derived.equations, options, compiled);
  if (!compiled.verdict.accepted()) throw std::runtime_error(compiled.verdict.failures.front());
  EmittedModel model{name,
                     compiled.files,
                     {},
                     derived.equations.initial_position.size(),
                     derived.equations.initial_velocity.size(),
                     compiled.facts.has_rate()};
  for (const auto& output : derived.equations.outputs)
    for (const dynamics::OutputValues& member : output) model.outputs += member.values.size();
  for (const model::Parameter& parameter : derived.mechanism.parameters)
    model.parameters.push_back(parameter.name);
  return model;
}

std::vector<std::string> strict_flags() {
  return {"-std=c++17",         "-Wall",  "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow",
          "-Wdouble-promotion", "-Werror"};
}

bool have_compiler(const std::string& compiler) {
  try {
    return support::run_process({compiler, "--version"}).status == 0;
  } catch (const support::EnvironmentError&) {
    return false;
  }
}

CompiledBatch::CompiledBatch(const std::vector<EmittedModel>& models, const std::string& compiler,
                             const std::string& real, const std::vector<std::string>& optimisation)
    : models_(models) {
  const auto in_folder = [&](const std::string& file) { return folder_.path() + "/" + file; };
  for (const EmittedModel& model : models)
    for (const emit::File& file : model.files) support::write_file(in_folder(file.name), file.text);
  support::write_file(in_folder("driver.cpp"), driver(models, real));
  std::vector<std::string> command = {compiler};
  for (const std::string& flag : strict_flags()) command.push_back(flag);
  for (const std::string& flag : optimisation) command.push_back(flag);
  for (const std::string& rest : {std::string("-fPIC"), std::string("-shared"), in_folder("driver.cpp"),
                                  std::string("-o"), in_folder("driver.so")})
    command.push_back(rest);
  const support::ProcessResult result = support::run_process(command);
  if (result.status != 0 || !result.output.empty()) throw std::runtime_error(result.output.substr(0, 4000));
  handle_ = dlopen(in_folder("driver.so").c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle_) throw std::runtime_error(dlerror());
}

CompiledBatch::~CompiledBatch() {
  if (handle_) dlclose(handle_);
}

Evaluation CompiledBatch::evaluate(std::size_t index, const Sample& sample, double h) const {
  const EmittedModel& model = models_[index];
  void* symbol = dlsym(handle_, ("evaluate_" + model.name).c_str());
  if (!symbol) throw std::runtime_error(dlerror());
  const std::size_t n = model.velocities, ny = model.positions;
  std::vector<double> results(n * (n + 1) / 2 + 5 * n + 2 * ny + model.outputs + 2);
  reinterpret_cast<Evaluate>(symbol)(sample.t, sample.parameters.data(), sample.y.data(), sample.z.data(),
                                     sample.u.data(), sample.zdot.data(), h, results.data());
  const double* at = results.data();
  const auto take = [&at](std::size_t count) {
    std::vector<double> values(at, at + count);
    at += count;
    return values;
  };
  Evaluation e;
  e.M = take(n * (n + 1) / 2);
  e.k = take(n);
  e.q = take(n);
  e.zdot = take(n);
  e.tau = take(n);
  e.kinetic = *at++;
  e.potential = *at++;
  if (model.has_rate) e.ydot = take(ny);
  e.outputs = take(model.outputs);
  e.y_next = take(ny);
  e.z_next = take(n);
  return e;
}

}  // namespace jourdain::tests
