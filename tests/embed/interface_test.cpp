// The C interface of every model: its table against what the description says, its calls against the emitted C++.
#include <dlfcn.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "embed/emitted_models.hpp"
#include "jourdain/jourdain_interface.h"
#include "properties/effort.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kRoles[] = {"time",  "position", "velocity",  "position_rate", "acceleration",
                                  "input", "output",   "parameter", "constant"};
constexpr const char* kQuantities[] = {"time",
                                       "angle",
                                       "length",
                                       "quaternion_part",
                                       "quaternion_rate",
                                       "angular_velocity",
                                       "velocity",
                                       "angular_acceleration",
                                       "acceleration",
                                       "force",
                                       "moment",
                                       "mass",
                                       "inertia",
                                       "energy",
                                       "rotation_matrix",
                                       "other"};

std::vector<std::string> model_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(JOURDAIN_SOURCE_DIR "/models"))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// A model, compiled to C with its interface and loaded.
class Loaded {
 public:
  Loaded(const std::string& model, bool is_float) {
    const std::string name = is_float ? model + "_f" : model, path = folder_.path();
    const support::ProcessResult emitted = support::run_process(
        {JOURDAIN_BINARY, "compile", JOURDAIN_SOURCE_DIR "/models/" + model + ".toml", "--language", "c",
         "--interface", "--real", is_float ? "float" : "double", "-o", path});
    EXPECT_EQ(emitted.status, 0) << emitted.output;
    const support::ProcessResult built = support::run_process(
        {"gcc", "-std=c99", "-pedantic", "-Wall", "-Wextra", "-Wconversion", "-Wdouble-promotion", "-Wshadow",
         "-Werror", "-O1", "-ffp-contract=off", "-fno-builtin", "-fPIC", "-shared", "-o", path + "/model.so",
         fmt::format("{}/{}.c", path, name), fmt::format("{}/{}_interface.c", path, name), "-lm"});
    EXPECT_EQ(built.status, 0) << model << "\n" << built.output;
    library_ = dlopen((path + "/model.so").c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library_) {
      ADD_FAILURE() << dlerror();
      return;
    }
    manifest = json::parse(support::read_file(fmt::format("{}/{}.json", path, model)));
    const auto entry =
        reinterpret_cast<const jourdain_interface* (*)()>(dlsym(library_, (name + "_interface").c_str()));
    EXPECT_TRUE(entry);
    table = entry ? entry() : nullptr;
  }
  ~Loaded() {
    if (library_) dlclose(library_);
  }
  Loaded(const Loaded&) = delete;
  Loaded& operator=(const Loaded&) = delete;

  json manifest;
  const jourdain_interface* table = nullptr;

 private:
  support::TemporaryFolder folder_;
  void* library_ = nullptr;
};

class Instance {
 public:
  explicit Instance(const jourdain_interface& table)
      : memory_((table.size + sizeof(std::max_align_t) - 1) / sizeof(std::max_align_t)),
        self(table.create(memory_.data(), memory_.size() * sizeof(std::max_align_t))) {}

 private:
  std::vector<std::max_align_t> memory_;

 public:
  void* self;
};

std::size_t size(int count) { return static_cast<std::size_t>(count); }

struct Values {
  explicit Values(const jourdain_interface& table)
      : y(size(table.position_count) + 1),
        z(size(table.velocity_count) + 1),
        u(size(table.input_count) + 1),
        p(size(table.parameter_count) + 1) {}
  double t = 0;
  std::vector<double> y, z, u, p;
};

Values values_of(const jourdain_interface& table, const void* self) {
  Values values(table);
  EXPECT_EQ(table.get_state(self, &values.t, values.y.data(), values.z.data()), JOURDAIN_OK);
  EXPECT_EQ(table.get_inputs(self, values.u.data()), JOURDAIN_OK);
  EXPECT_EQ(table.get_parameters(self, values.p.data()), JOURDAIN_OK);
  return values;
}

/// All results of a function, one after another; none where the call fails.
std::vector<double> results_of(const jourdain_function& function, void* self,
                               const std::vector<double>& given) {
  std::vector<std::vector<double>> results;
  std::vector<double*> places;
  for (int k = 0; k < function.result_count; ++k) {
    results.emplace_back(size(function.results[k].rows) * size(function.results[k].columns), 12345.0);
    places.push_back(results.back().data());
  }
  const double* const first = given.data();
  if (function.call(self, &first, places.data()) != JOURDAIN_OK) return {};
  std::vector<double> all;
  for (const std::vector<double>& result : results) all.insert(all.end(), result.begin(), result.end());
  return all;
}

const jourdain_function* function_named(const jourdain_interface& table, const std::string& name) {
  for (int k = 0; k < table.function_count; ++k)
    if (name == table.functions[k].name) return &table.functions[k];
  return nullptr;
}

/// The row of the manifest that says the same.
json row_of(const jourdain_interface& table, const jourdain_variable& variable) {
  const std::size_t count = size(variable.rows) * size(variable.columns);
  const auto texts = [count](const char* const* list) {
    return std::vector<std::string>(list, list + count);
  };
  json row = {{"name", variable.name},   {"role", kRoles[variable.role]},
              {"index", variable.index}, {"quantity", kQuantities[variable.quantity]},
              {"unit", variable.unit},   {"description", variable.description}};
  const std::vector<std::string> numbers = texts(variable.numbers);
  if (numbers != std::vector<std::string>{variable.name}) {
    row["rows"] = variable.rows;
    row["columns"] = variable.columns;
    row["numbers"] = numbers;
  }
  if (variable.start) row["start"] = std::vector<double>(variable.start, variable.start + count);
  if (variable.has_range) row["range"] = {variable.minimum, variable.maximum};
  if (variable.derivative_of >= 0) row["derivative_of"] = table.variables[variable.derivative_of].name;
  if (variable.depends_on) row["depends_on"] = texts(variable.depends_on);
  return row;
}

json info_of(const std::string& model) {
  const support::ProcessResult result =
      support::run_process({"sh", "-c",
                            fmt::format("'{}' info --json '{}/models/{}.toml' 2>/dev/null", JOURDAIN_BINARY,
                                        JOURDAIN_SOURCE_DIR, model)});
  EXPECT_EQ(result.status, 0);
  return json::parse(result.output);
}

std::vector<const jourdain_variable*> of_role(const jourdain_interface& table, jourdain_role role) {
  std::vector<const jourdain_variable*> list;
  for (int k = 0; k < table.variable_count; ++k)
    if (table.variables[k].role == role) list.push_back(&table.variables[k]);
  return list;
}

void expect_as_in_info(const jourdain_interface& table, const json& info) {
  const std::pair<jourdain_role, const char*> scalars[] = {
      {JOURDAIN_POSITION, "positions"}, {JOURDAIN_VELOCITY, "velocities"}, {JOURDAIN_INPUT, "inputs"}};
  for (const auto& [role, key] : scalars) {
    const std::vector<const jourdain_variable*> list = of_role(table, role);
    ASSERT_EQ(list.size(), info[key].size());
    for (std::size_t k = 0; k < list.size(); ++k) {
      const json& fact = info[key][k];
      EXPECT_TRUE(std::string(list[k]->name).starts_with(fact["name"].get<std::string>()));
      EXPECT_EQ(list[k]->unit, fact["unit"].get<std::string>());
      EXPECT_EQ(list[k]->index, static_cast<int>(k));
      ASSERT_TRUE(list[k]->start);
      EXPECT_EQ(*list[k]->start, fact.value("initial", 0.0));
      EXPECT_EQ(list[k]->has_range, fact.contains("range") ? 1 : 0);
      if (fact.contains("range")) {
        EXPECT_EQ(list[k]->minimum, fact["range"][0].get<double>());
        EXPECT_EQ(list[k]->maximum, fact["range"][1].get<double>());
      }
    }
  }
  std::vector<std::pair<std::string, std::string>> found, expected;
  for (const jourdain_variable* output : of_role(table, JOURDAIN_OUTPUT)) {
    EXPECT_EQ(output->index, static_cast<int>(found.size()));
    for (int k = 0; k < output->rows * output->columns; ++k)
      found.emplace_back(output->numbers[k], output->unit);
  }
  for (const json& output : info["outputs"])
    for (const json& number : output["numbers"]) expected.emplace_back(number["name"], number["unit"]);
  EXPECT_EQ(found, expected);
  EXPECT_EQ(static_cast<int>(found.size()), table.output_count);
  const std::vector<const jourdain_variable*> parameters = of_role(table, JOURDAIN_PARAMETER);
  ASSERT_EQ(parameters.size(), info["parameters"].size());
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const json& fact = info["parameters"][k];
    EXPECT_EQ(parameters[k]->name, fact["name"].get<std::string>());
    EXPECT_EQ(parameters[k]->unit, fact["unit"].get<std::string>());
    EXPECT_EQ(parameters[k]->description, fact["description"].get<std::string>());
    EXPECT_EQ(*parameters[k]->start, fact["value"].get<double>());
  }
  const json& gravity = info["gravity"];
  for (const jourdain_variable* constant : of_role(table, JOURDAIN_CONSTANT))
    if (constant->quantity == JOURDAIN_QUANTITY_ACCELERATION) {
      for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(constant->start[k], gravity[k].get<double>());
    }
}

void expect_starts(const jourdain_interface& table, const void* self) {
  const Values values = values_of(table, self);
  const auto expect_role = [&](jourdain_role role, const std::vector<double>& numbers) {
    for (const jourdain_variable* variable : of_role(table, role)) {
      const double wanted = *variable->start, rounding = table.real_bytes == 4 ? 1e-7 : 1e-15;
      EXPECT_NEAR(numbers[size(variable->index)], wanted, rounding * (1 + std::fabs(wanted)))
          << variable->name;
    }
  };
  expect_role(JOURDAIN_POSITION, values.y);
  expect_role(JOURDAIN_VELOCITY, values.z);
  expect_role(JOURDAIN_INPUT, values.u);
  expect_role(JOURDAIN_PARAMETER, values.p);
  EXPECT_EQ(values.t, 0);
}

/// What a number is said not to depend on does not change a bit of it.
void expect_independence(const jourdain_interface& table, void* self) {
  const Values start = values_of(table, self);
  const auto numbers = [&](jourdain_role role) {
    std::vector<double> list(
        size(role == JOURDAIN_OUTPUT ? table.output_count : table.position_count + table.velocity_count) + 1);
    if (role == JOURDAIN_OUTPUT) {
      if (const jourdain_function* outputs = function_named(table, "outputs"))
        list = results_of(*outputs, self, {});
    } else if (table.rates) {
      std::vector<double> ydot(size(table.position_count) + 1), zdot(size(table.velocity_count) + 1);
      table.rates(self, ydot.data(), zdot.data());
      list = role == JOURDAIN_POSITION_RATE ? ydot : zdot;
    }
    return list;
  };
  const int ny = table.position_count, nz = table.velocity_count, arguments = 1 + ny + nz + table.input_count;
  const auto set = [&](const Values& values) {
    EXPECT_EQ(table.set_inputs(self, values.u.data()), JOURDAIN_OK);
    EXPECT_EQ(table.set_state(self, values.t, values.y.data(), values.z.data()), JOURDAIN_OK);
  };
  Values base = start;
  for (std::size_t k = 0; k < size(nz); ++k) base.z[k] += 0.1 + 0.01 * static_cast<double>(k);
  for (std::size_t k = 0; k < size(table.input_count); ++k) base.u[k] = 0.3;
  int changed = 0, named = 0;
  for (const jourdain_role role : {JOURDAIN_POSITION_RATE, JOURDAIN_ACCELERATION, JOURDAIN_OUTPUT}) {
    set(base);
    const std::vector<double> before = numbers(role);
    for (int argument = 0; argument < arguments; ++argument) {
      Values moved = base;
      double& value = argument == 0         ? moved.t
                      : argument <= ny      ? moved.y[size(argument - 1)]
                      : argument <= ny + nz ? moved.z[size(argument - 1 - ny)]
                                            : moved.u[size(argument - 1 - ny - nz)];
      value += 0.0625;
      set(moved);
      const std::vector<double> after = numbers(role);
      for (const jourdain_variable* variable : of_role(table, role))
        for (int k = 0; k < variable->rows * variable->columns && variable->depends_on; ++k) {
          ASSERT_EQ(std::strlen(variable->depends_on[k]), size(arguments));
          const std::size_t place = size(variable->index + k);
          if (place >= before.size() || place >= after.size()) continue;
          if (variable->depends_on[k][argument] == '0') {
            EXPECT_EQ(before[place], after[place]) << variable->numbers[k] << ", argument " << argument;
          } else {
            ++named;
            changed += before[place] != after[place] ? 1 : 0;
          }
        }
    }
  }
  constexpr int kShare = 4;  // a box in the air does not feel the ground
  EXPECT_GE(changed * kShare, named) << "of " << named << " dependences";
  set(start);
}

/// Whether its results depend on it or not.
void expect_given_is_looked_at(const jourdain_interface& table, int k, void* self, double wrong) {
  const jourdain_function& function = table.functions[k];
  std::vector<std::vector<double>> given, results;
  std::vector<const double*> from;
  std::vector<double*> to;
  const auto count = [](const jourdain_argument& array) { return size(array.rows * array.columns); };
  for (int i = 0; i < function.given_count; ++i) given.emplace_back(count(function.given[i]), wrong);
  for (int i = 0; i < function.result_count; ++i) results.emplace_back(count(function.results[i]), 0.0);
  for (const std::vector<double>& numbers : given) from.push_back(numbers.data());
  for (std::vector<double>& numbers : results) to.push_back(numbers.data());
  EXPECT_EQ(function.call(self, from.data(), to.data()), JOURDAIN_NOT_FINITE) << function.name;
}

void expect_misuse_is_refused(const jourdain_interface& table, void* self) {
  std::vector<std::max_align_t> memory(table.size / sizeof(std::max_align_t) + 2);
  EXPECT_FALSE(table.create(nullptr, table.size));
  EXPECT_FALSE(table.create(memory.data(), table.size - 1));
  if (table.alignment > 1) {
    EXPECT_FALSE(table.create(reinterpret_cast<char*>(memory.data()) + 1, table.size));
  }
  Values values = values_of(table, self);
  EXPECT_EQ(table.get_state(nullptr, &values.t, values.y.data(), values.z.data()), JOURDAIN_WRONG_CALL);
  EXPECT_EQ(table.get_state(self, nullptr, values.y.data(), values.z.data()), JOURDAIN_WRONG_CALL);
  EXPECT_EQ(table.set_parameters(nullptr, values.p.data()), JOURDAIN_WRONG_CALL);
  EXPECT_EQ(table.reset(nullptr), JOURDAIN_WRONG_CALL);
  EXPECT_EQ(table.loops_closed(nullptr), 0);
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               too_large = table.real_bytes == 4 ? 1e300 : std::numeric_limits<double>::infinity();
  for (const auto& [count, numbers, setter] :
       {std::tuple(table.parameter_count, &values.p, table.set_parameters),
        {table.input_count, &values.u, table.set_inputs}}) {
    if (count == 0) continue;
    EXPECT_EQ(setter(self, nullptr), JOURDAIN_WRONG_CALL);
    const double kept = (*numbers)[0];
    for (const double wrong : {nan, too_large}) {
      (*numbers)[0] = wrong;
      EXPECT_EQ(setter(self, numbers->data()), JOURDAIN_NOT_FINITE) << wrong;
    }
    (*numbers)[0] = kept;
  }
  EXPECT_EQ(values_of(table, self).p, values.p);
  const double start = values.t;
  EXPECT_EQ(table.set_state(self, 5, values.y.data(), values.z.data()), JOURDAIN_OK);
  const bool has_time = values_of(table, self).t > 0;
  for (const double wrong : {nan, too_large})
    EXPECT_EQ(table.set_state(self, wrong, values.y.data(), values.z.data()),
              has_time ? JOURDAIN_NOT_FINITE : JOURDAIN_OK);
  EXPECT_EQ(table.set_state(self, start, values.y.data(), values.z.data()), JOURDAIN_OK);
  if (table.position_count > 0) {
    EXPECT_EQ(table.set_state(self, 0, nullptr, values.z.data()), JOURDAIN_WRONG_CALL);
    const double kept = values.y[0];
    for (const double wrong : {nan, too_large}) {
      values.y[0] = wrong;
      EXPECT_EQ(table.set_state(self, 0, values.y.data(), values.z.data()), JOURDAIN_NOT_FINITE) << wrong;
    }
    values.y[0] = kept;
    EXPECT_EQ(values_of(table, self).y, values.y);
  }
  for (int k = 0; k < table.function_count; ++k) {
    EXPECT_EQ(table.functions[k].call(nullptr, nullptr, nullptr), JOURDAIN_WRONG_CALL);
    if (table.functions[k].result_count > 0) {
      EXPECT_EQ(table.functions[k].call(self, nullptr, nullptr), JOURDAIN_WRONG_CALL)
          << table.functions[k].name;
    }
    if (table.functions[k].given_count > 0) expect_given_is_looked_at(table, k, self, too_large);
  }
  for (int k = 0; k < table.stepper_count; ++k) {
    EXPECT_EQ(table.steppers[k].step(nullptr, 1e-3, 1), JOURDAIN_WRONG_CALL);
    EXPECT_EQ(table.steppers[k].step(self, 1e-3, -1), JOURDAIN_WRONG_CALL);
    EXPECT_EQ(table.steppers[k].step(self, nan, 1), JOURDAIN_NOT_FINITE);
    if (has_time) {
      EXPECT_NE(table.steppers[k].step(self, 1e308, 5), JOURDAIN_OK) << table.steppers[k].name;
      EXPECT_EQ(table.set_state(self, start, values.y.data(), values.z.data()), JOURDAIN_OK);
    }
  }
}

/// A copy of the bytes goes on as the instance does, and steps taken together are steps taken one by one.
void expect_copies_go_on(const jourdain_interface& table, void* self) {
  if (table.stepper_count == 0 || table.velocity_count == 0) return;
  const jourdain_stepper& stepper = table.steppers[0];
  EXPECT_EQ(stepper.step(self, 1e-4, 3), JOURDAIN_OK);
  Instance other(table);
  std::memcpy(other.self, self, table.size);
  EXPECT_EQ(stepper.step(self, 1e-4, 10), JOURDAIN_OK);
  for (int k = 0; k < 10; ++k) EXPECT_EQ(stepper.step(other.self, 1e-4, 1), JOURDAIN_OK);
  const Values a = values_of(table, self), b = values_of(table, other.self);
  EXPECT_EQ(a.y, b.y);
  EXPECT_EQ(a.z, b.z);
  EXPECT_EQ(a.t, b.t);
  EXPECT_EQ(table.reset(self), JOURDAIN_OK);
  expect_starts(table, self);
}

/// What memories take of inputs is seen after some samples.
bool inputs_matter_in_steps(const jourdain_interface& table) {
  Instance still(table), driven(table);
  const std::vector<double> ones(size(table.input_count), 1.0);
  EXPECT_EQ(table.set_inputs(driven.self, ones.data()), JOURDAIN_OK);
  for (const Instance* instance : {&still, &driven})
    EXPECT_EQ(table.steppers[0].step(instance->self, 1e-3, 100), JOURDAIN_OK);
  return values_of(table, still.self).z != values_of(table, driven.self).z;
}

/// Shapes, and which functions the inputs are nothing to, as the table has them.
void expect_functions_as_declared(const jourdain_interface& table, bool has_samples) {
  Instance instance(table);
  const std::vector<double> zdot(size(table.velocity_count), 0.5), ones(size(table.input_count), 1.0);
  for (int k = 0; k < table.function_count; ++k) {
    const jourdain_function& function = table.functions[k];
    SCOPED_TRACE(function.name);
    for (int i = 0; i < function.result_count; ++i) {
      const jourdain_argument& result = function.results[i];
      EXPECT_TRUE(result.dimensions == 2 || result.columns == 1);
      EXPECT_TRUE(result.dimensions > 0 || result.rows == 1);
    }
    const std::string name = function.name;
    const std::map<std::string, int> known = {
        {"mass_matrix", 2}, {"forward_dynamics", 1}, {"kinetic_energy", 0}};
    if (const auto found = known.find(name); found != known.end()) {
      EXPECT_EQ(function.results[0].dimensions, found->second);
    }
    if (table.input_count == 0 || function.result_count == 0) continue;
    const std::vector<double> before = results_of(function, instance.self, zdot);
    EXPECT_EQ(table.set_inputs(instance.self, ones.data()), JOURDAIN_OK);
    if (!function.takes_inputs) {
      EXPECT_EQ(results_of(function, instance.self, zdot), before);
    }
    if (name == "forward_dynamics") {
      EXPECT_TRUE(function.takes_inputs);
      // What saturates may not tell one from zero.
      bool matters = results_of(function, instance.self, zdot) != before;
      for (const double input : {-1.5, 0.01}) {
        EXPECT_EQ(table.set_inputs(instance.self, std::vector<double>(ones.size(), input).data()),
                  JOURDAIN_OK);
        matters = matters || results_of(function, instance.self, zdot) != before;
      }
      matters = matters || (has_samples && inputs_matter_in_steps(table));
      EXPECT_TRUE(matters);
    }
    EXPECT_EQ(table.set_inputs(instance.self, std::vector<double>(ones.size(), 0.0).data()), JOURDAIN_OK);
  }
}

void expect_all_of(const std::string& model, bool is_float) {
  SCOPED_TRACE(model + (is_float ? " in float" : ""));
  const Loaded loaded(model, is_float);
  ASSERT_TRUE(loaded.table);
  const jourdain_interface& table = *loaded.table;
  EXPECT_EQ(table.version, JOURDAIN_INTERFACE_VERSION);
  EXPECT_EQ(table.real_bytes, is_float ? 4 : 8);
  EXPECT_EQ(table.name, is_float ? model + "_f" : model);
  for (const auto& [text, key] : {std::pair(table.title, "title"),
                                  {table.source, "model"},
                                  {table.sha256, "sha256"},
                                  {table.generator, "generator"}})
    EXPECT_EQ(text, loaded.manifest[key].get<std::string>());
  for (const auto& [count, key] : {std::pair(table.position_count, "position_count"),
                                   {table.velocity_count, "velocity_count"},
                                   {table.input_count, "input_count"},
                                   {table.parameter_count, "parameter_count"}})
    EXPECT_EQ(count, loaded.manifest[key].get<int>()) << key;
  EXPECT_EQ(size(table.constraint_count), loaded.manifest.value("constraints", json::array()).size());
  json rows = json::array();
  for (int k = 0; k < table.variable_count; ++k) rows.push_back(row_of(table, table.variables[k]));
  EXPECT_EQ(rows, loaded.manifest["variables"]);
  expect_as_in_info(table, info_of(model));
  std::vector<std::string> functions;
  for (int k = 0; k < table.function_count; ++k) {
    const jourdain_function& function = table.functions[k];
    functions.emplace_back(function.name);
    EXPECT_EQ(function.operations, loaded.manifest["operations"][function.name]["arithmetic"].get<long>());
    EXPECT_FALSE(std::string(function.description).empty());
    EXPECT_EQ(std::string(function.description).find('?'), std::string::npos) << function.description;
  }
  for (int k = 0; k < table.stepper_count; ++k) {
    const jourdain_stepper& stepper = table.steppers[k];
    functions.emplace_back(stepper.name);
    EXPECT_EQ(stepper.operations, loaded.manifest["steps"][stepper.name]["operations"].get<long>());
    EXPECT_EQ(stepper.order, loaded.manifest["steps"][stepper.name]["order"].get<int>());
  }
  functions.emplace_back("initial_state");
  std::vector<std::string> emitted = loaded.manifest["functions"];
  const bool has_samples = std::find(emitted.begin(), emitted.end(), "sample") != emitted.end();
  if (has_samples) functions.emplace_back("sample");  // a part of steps
  std::sort(functions.begin(), functions.end());
  std::sort(emitted.begin(), emitted.end());
  EXPECT_EQ(functions, emitted);

  Instance instance(table);
  ASSERT_TRUE(instance.self);
  EXPECT_EQ(table.loops_closed(instance.self), 1);
  expect_starts(table, instance.self);
  const std::vector<double> zdot(size(table.velocity_count), 0.5);
  for (int k = 0; k < table.function_count; ++k)
    if (table.functions[k].result_count > 0) {
      EXPECT_FALSE(results_of(table.functions[k], instance.self, zdot).empty()) << table.functions[k].name;
    }
  expect_functions_as_declared(table, has_samples);
  expect_misuse_is_refused(table, instance.self);
  expect_independence(table, instance.self);
  expect_copies_go_on(table, instance.self);
}

TEST(Interface, SaysWhatTheDescriptionSays) {
#ifdef JOURDAIN_SANITIZED
  GTEST_SKIP() << "the release build goes through all models";
#endif
  ASSERT_GE(model_names().size(), 20u);
  std::size_t number = 0;
  for (const std::string& model : model_names())
    if (draws(number++, 2)) expect_all_of(model, false);
}

TEST(Interface, OfFloatsSaysTheSame) {
  for (const char* model : {"pendulum", "panda", "squeezer", "quadrotor", "shaking_cart"})
    expect_all_of(model, true);
}

/// Everything that the emitted C++ computes at the start and after some steps, bit by bit.
template <class Model>
void expect_bits_of(const std::string& name, const Model& model) {
  SCOPED_TRACE(name);
  const Loaded loaded(name, false);
  ASSERT_TRUE(loaded.table);
  const jourdain_interface& table = *loaded.table;
  Instance instance(table);
  typename Model::State state = initial_state(model);
  typename Model::Input input{};
  for (int round = 0; round < 3; ++round) {
    double zdot[Model::velocity_count], M[Model::velocity_count][Model::velocity_count];
    forward_dynamics(model, state, input, zdot);
    mass_matrix(model, state, M);
    EXPECT_EQ(results_of(*function_named(table, "forward_dynamics"), instance.self, {}),
              std::vector<double>(zdot, zdot + Model::velocity_count));
    EXPECT_EQ(results_of(*function_named(table, "mass_matrix"), instance.self, {}),
              std::vector<double>(&M[0][0], &M[0][0] + Model::velocity_count * Model::velocity_count));
    EXPECT_EQ(results_of(*function_named(table, "kinetic_energy"), instance.self, {}),
              std::vector<double>{kinetic_energy(model, state)});
    for (int k = 0; k < 50; ++k) rk4_step(model, state, input, 1e-3);
    EXPECT_EQ(table.steppers[0].step(instance.self, 1e-3, 50), JOURDAIN_OK);
    const Values values = values_of(table, instance.self);
    for (std::size_t k = 0; k < size(Model::position_count); ++k) EXPECT_EQ(values.y[k], state.y[k]);
    for (std::size_t k = 0; k < size(Model::velocity_count); ++k) EXPECT_EQ(values.z[k], state.z[k]);
  }
}

TEST(Interface, ComputesTheBitsOfTheEmittedCpp) {
  expect_bits_of("pendulum", ::pendulum::Model<double>());
  expect_bits_of("panda", ::panda::Model<double>());
  expect_bits_of("squeezer", ::squeezer::Model<double>());
  expect_bits_of("quadrotor", ::quadrotor::Model<double>());
}

/// What is asked for, and what an instance cannot do without.
TEST(Interface, OfFewFunctionsBuilds) {
  for (const char* functions : {"kinetic_energy", "linearize,adams_bashforth3_step,rodas4_step"}) {
    const support::TemporaryFolder folder;
    const auto run = [&](const std::vector<std::string>& command) {
      const support::ProcessResult result = support::run_process(command);
      EXPECT_EQ(result.status, 0) << functions << "\n" << result.output;
    };
    run({JOURDAIN_BINARY, "compile", JOURDAIN_SOURCE_DIR "/models/crane.toml", "--language", "c",
         "--interface", "--functions", functions, "-o", folder.path()});
    for (const char* source : {"crane.c", "crane_interface.c", "crane_f.c", "crane_f_interface.c"})
      run({"gcc", "-std=c99", "-pedantic", "-Wall", "-Wextra", "-Wconversion", "-Wdouble-promotion",
           "-Wshadow", "-Werror", "-fsyntax-only", folder.path() + "/" + source});
  }
  const support::TemporaryFolder folder;
  const support::ProcessResult refused =
      support::run_process({JOURDAIN_BINARY, "compile", JOURDAIN_SOURCE_DIR "/models/crane.toml",
                            "--language", "c", "--interface", "--name", "jourdain", "-o", folder.path()});
  EXPECT_EQ(refused.status, 2) << refused.output;
}

TEST(Interface, ParametersAreTunable) {
  const Loaded loaded("pendulum", false);
  ASSERT_TRUE(loaded.table);
  const jourdain_interface& table = *loaded.table;
  Instance one(table), other(table);
  Values values = values_of(table, other.self);
  values.p[1] = 4;  // length of the bar, m
  EXPECT_EQ(table.set_parameters(other.self, values.p.data()), JOURDAIN_OK);
  double ydot = 0, zdot[2] = {0, 0};
  EXPECT_EQ(table.rates(one.self, &ydot, &zdot[0]), JOURDAIN_OK);
  EXPECT_EQ(table.rates(other.self, &ydot, &zdot[1]), JOURDAIN_OK);
  EXPECT_NEAR(zdot[0], 4 * zdot[1], 1e-15);
  EXPECT_NEAR(zdot[0], 9.81, 1e-14);
}

/// How the loops close beyond the range for which that is proven is not known.
TEST(Interface, ParametersAtWhichLoopsAreNotProvenToCloseAreNotTaken) {
  for (const bool is_float : {false, true}) {
    const Loaded loaded("double_wishbone", is_float);
    ASSERT_TRUE(loaded.table);
    const jourdain_interface& table = *loaded.table;
    Instance one(table);
    const Values usual = values_of(table, one.self);
    ASSERT_NEAR(usual.p[0], 0.04, 1e-8);  // steering
    for (const double steering : {0.05 + 1e-6, -1e-6}) {
      Values values = usual;
      values.p[0] = steering;
      EXPECT_EQ(table.set_parameters(one.self, values.p.data()), JOURDAIN_LOOPS_OPEN);
      EXPECT_EQ(values_of(table, one.self).p, usual.p);
    }
    Values within = usual;
    within.p[0] = 0.03;
    EXPECT_EQ(table.set_parameters(one.self, within.p.data()), JOURDAIN_OK);
    EXPECT_NEAR(values_of(table, one.self).p[0], 0.03, 1e-8);
  }
}

TEST(Interface, OfFloatsTakesNoStepThatIsZeroThere) {
  for (const bool is_float : {false, true}) {
    const Loaded loaded("pendulum", is_float);
    ASSERT_TRUE(loaded.table);
    const jourdain_interface& table = *loaded.table;
    ASSERT_GT(table.stepper_count, 0);
    Instance one(table);
    const auto step = [&](double h) { return table.steppers[0].step(one.self, h, 1); };
    EXPECT_EQ(step(1e-50), is_float ? JOURDAIN_WRONG_CALL : JOURDAIN_OK);
    EXPECT_EQ(step(0), JOURDAIN_OK);
    if (is_float) {
      EXPECT_EQ(step(1e39), JOURDAIN_NOT_FINITE);
    }
  }
}

}  // namespace
}  // namespace jourdain::tests
