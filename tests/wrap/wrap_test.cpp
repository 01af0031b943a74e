// `jourdain wrap`: files for other tools, run through headers of the tests.
#include <dlfcn.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <vector>

#include "jourdain/jourdain_interface.h"
#include "package/project.hpp"
#include "support/files.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

using support::ProcessResult;
using testing::HasSubstr;
using Numbers = std::vector<double>;

const std::string kSource = JOURDAIN_SOURCE_DIR;
const std::vector<std::string> kStrict = {"-std=c99",     "-Wall",    "-Wextra", "-Wpedantic",
                                          "-Wconversion", "-Wshadow", "-Werror"};

ProcessResult wrap(const std::string& model, const std::string& tool, const std::string& folder,
                   const std::vector<std::string>& options = {}) {
  std::vector<std::string> command = {JOURDAIN_BINARY, "wrap", model, "--for", tool, "-o", folder};
  command.insert(command.end(), options.begin(), options.end());
  return support::run_process(command);
}

std::string model_file(const std::string& name) { return fmt::format("{}/models/{}.toml", kSource, name); }

void compile(const std::string& compiler, const std::vector<std::string>& arguments) {
  std::vector<std::string> command = {compiler};
  command.insert(command.end(), kStrict.begin(), kStrict.end());
  command.insert(command.end(), arguments.begin(), arguments.end());
  const ProcessResult result = support::run_process(command);
  ASSERT_EQ(result.status, 0) << compiler << "\n" << result.output;
}

/// Files of a model for CasADi as a library, with a type for its whole numbers.
template <class Integer>
class Library {
 public:
  Library(const std::string& model, const std::string& compiler, const std::vector<std::string>& flags)
      : Library(model, model_file(model), compiler, flags) {}
  Library(const std::string& model, const std::string& file, const std::string& compiler,
          const std::vector<std::string>& flags)
      : name_(model) {
    const std::string path = folder_.path() + "/" + model;
    const ProcessResult made = wrap(file, "casadi", folder_.path());
    EXPECT_EQ(made.status, 0) << made.output;
    std::vector<std::string> arguments = {
        "-O1", "-fPIC",      "-shared", path + ".c", path + "_interface.c", path + "_casadi.c",
        "-o",  path + ".so", "-lm"};
    arguments.insert(arguments.begin(), flags.begin(), flags.end());
    compile(compiler, arguments);
    handle_ = dlopen((path + ".so").c_str(), RTLD_NOW | RTLD_LOCAL);
    EXPECT_TRUE(handle_) << dlerror();
  }
  ~Library() {
    if (handle_) dlclose(handle_);
  }

  template <class Function>
  Function* symbol(const std::string& suffix, const std::string& prefix = "") const {
    void* const found = dlsym(handle_, (prefix + name_ + suffix).c_str());
    EXPECT_TRUE(found) << suffix;
    return reinterpret_cast<Function*>(found);
  }

  /// Size of an argument or a result by its sparsity; none where all is zero by structure.
  std::size_t size(const std::string& function, const std::string& side, Integer k,
                   const std::string& prefix) const {
    const Integer* shape = symbol<const Integer*(Integer)>(function + "_sparsity_" + side, prefix)(k);
    return shape[2] == 1 ? static_cast<std::size_t>(shape[0] * shape[1]) : 0;
  }

  /// All results, columns after columns. Null stands for arguments without entries.
  std::vector<Numbers> call(const std::string& function, const std::vector<Numbers>& arguments,
                            const std::string& prefix = "") const {
    const auto count = [&](const std::string& what) { return symbol<Integer()>(function + what, prefix)(); };
    EXPECT_EQ(static_cast<std::size_t>(count("_n_in")), arguments.size());
    std::vector<const double*> given;
    for (std::size_t k = 0; k < arguments.size(); ++k) {
      EXPECT_TRUE(arguments[k].empty() ||
                  arguments[k].size() == size(function, "in", static_cast<Integer>(k), prefix));
      given.push_back(arguments[k].empty() ? nullptr : arguments[k].data());
    }
    std::vector<Numbers> results;
    std::vector<double*> places;
    for (Integer k = 0; k < count("_n_out"); ++k) {
      results.emplace_back(size(function, "out", k, prefix), 12345.0);
      places.push_back(results.back().data());
    }
    Integer sizes[4];
    EXPECT_EQ((symbol<int(Integer*, Integer*, Integer*, Integer*)>(function + "_work", prefix)(
                  sizes, sizes + 1, sizes + 2, sizes + 3)),
              0);
    EXPECT_EQ(sizes[0], count("_n_in"));
    EXPECT_EQ(sizes[1], count("_n_out"));
    const int status = symbol<int(const double**, double**, Integer*, double*, int)>(function, prefix)(
        given.data(), places.data(), nullptr, nullptr, 0);
    return status == 0 ? results : std::vector<Numbers>();
  }

 private:
  support::TemporaryFolder folder_;
  std::string name_;
  void* handle_ = nullptr;
};

/// Numbers that look like none in particular.
Numbers drawn(std::size_t count, double seed) {
  Numbers numbers;
  for (std::size_t k = 0; k < count; ++k) numbers.push_back(std::sin(seed + 1.7 * static_cast<double>(k)));
  return numbers;
}

template <class Integer>
void expect_consistent(const Library<Integer>& library, std::size_t nx, std::size_t nu, std::size_t ny) {
  const Numbers x = drawn(nx, 0.3), u = drawn(nu, 2), sx = drawn(nx * nx, 3), su = drawn(nx * nu, 4),
                lambda = drawn(nx, 5);
  const Numbers xdot = library.call("_ode", {x, u, {}}).at(0);
  ASSERT_EQ(xdot.size(), nx);
  for (std::size_t k = 0; k < ny; ++k) EXPECT_EQ(xdot[k], x[ny + k]);
  const std::vector<Numbers> jacobian = library.call("_ode", {x, u, {}, {}}, "jac_");
  const Numbers &A = jacobian.at(0), &B = jacobian.at(1);
  ASSERT_EQ(A.size(), nx * nx);
  ASSERT_EQ(B.size(), nx * nu);
  for (const double by_parameter : jacobian.at(2)) EXPECT_TRUE(std::isnan(by_parameter));
  constexpr double kStep = 1e-6;
  for (std::size_t j = 0; j < nx + nu; ++j) {
    Numbers up = x, down = x, more = u, less = u;
    (j < nx ? up[j] : more[j - nx]) += kStep;
    (j < nx ? down[j] : less[j - nx]) -= kStep;
    const Numbers above = library.call("_ode", {up, more, {}}).at(0),
                  below = library.call("_ode", {down, less, {}}).at(0);
    for (std::size_t i = 0; i < nx; ++i) {
      const double slope = j < nx ? A[j * nx + i] : B[(j - nx) * nx + i];
      EXPECT_NEAR(slope, (above[i] - below[i]) / (2 * kStep), 1e-6 * std::max(1.0, std::fabs(slope)))
          << i << " by " << j;
    }
  }
  EXPECT_EQ(library.call("_expl_ode_fun", {x, u, {}}).at(0), xdot);
  const std::vector<Numbers> forward = library.call("_expl_vde_forw", {x, sx, su, u, {}});
  EXPECT_EQ(forward.at(0), xdot);
  const Numbers adjoint = library.call("_expl_vde_adj", {x, lambda, u, {}}).at(0);
  for (std::size_t j = 0; j < nx + nu; ++j) {
    double transposed = 0;
    for (std::size_t i = 0; i < nx; ++i) {
      double expected = j < nx ? 0 : B[(j - nx) * nx + i];
      for (std::size_t k = 0; k < nx; ++k)
        expected += A[k * nx + i] * (j < nx ? sx[j * nx + k] : su[(j - nx) * nx + k]);
      EXPECT_NEAR(j < nx ? forward.at(1)[j * nx + i] : forward.at(2)[(j - nx) * nx + i], expected,
                  1e-11 * std::max(1.0, std::fabs(expected)));
      transposed += lambda[i] * (j < nx ? A[j * nx + i] : B[(j - nx) * nx + i]);
    }
    EXPECT_NEAR(adjoint[j], transposed, 1e-11 * std::max(1.0, std::fabs(transposed)));
  }
  EXPECT_TRUE(library.call("_ode", {Numbers(nx, std::nan("")), u, {}}).empty());
}

TEST(Wrap, CasadiGetsRatesAndTheirJacobians) {
  for (const char* compiler : {"gcc", "clang"}) {
    const Library<long long> library("cart_pole", compiler, {});
    expect_consistent(library, 4, 1, 2);
    const std::vector<Numbers> light = library.call("_ode", {drawn(4, 1), {1.0}, {1.0, 0.1, 0.5}}),
                               heavy = library.call("_ode", {drawn(4, 1), {1.0}, {2.0, 0.1, 0.5}});
    EXPECT_EQ(light, library.call("_ode", {drawn(4, 1), {1.0}, {}}));
    EXPECT_NE(light, heavy);
    EXPECT_STREQ(library.symbol<const char*(long long)>("_ode_name_in")(0), "x");
    EXPECT_EQ(library.symbol<const char*(long long)>("_ode_name_in")(3), nullptr);
    EXPECT_EQ(library.symbol<const long long*(long long)>("_ode_sparsity_out")(-1), nullptr);
  }
}

TEST(Wrap, AcadosGetsSensitivities) {
  expect_consistent(Library<int>("panda", "gcc", {"-Dcasadi_int=int"}), 14, 7, 7);
}

/// States of their own stand behind the velocities.
TEST(Wrap, CasadiGetsRatesOfStates) {
  expect_consistent(Library<long long>("servo_arm", "gcc", {}), 5, 1, 1);
}

/// Their derivatives by time are one more result, which casadi has no use for.
TEST(Wrap, CasadiTakesOutputsOfTime) {
  const support::TemporaryFolder folder;
  const std::string file = folder.path() + "/follower.toml", model = R"toml([model]
name = "follower"
[[body]]
name = "cart"
mass = 2
[[joint]]
name = "slide"
type = "prismatic"
parent = "world"
child = "cart"
axis = [1, 0, 0]
INPUT[[force]]
joint = "slide"
value = "-3*slide^3"
[[output]]
name = "error"
kind = "expression"
value = "slide - sin(2*t)"
)toml",
                    input = "[[actuator]]\nname = \"push\"\njoint = \"slide\"\n";
  for (const bool has_input : {true, false}) {
    std::string text = model;
    support::write_file(file, text.replace(text.find("INPUT"), 5, has_input ? input : ""));
    expect_consistent(Library<long long>("follower", file, "gcc",
                                         {"-g", "-fsanitize=undefined", "-fno-sanitize-recover=all",
                                          "-fstack-protector-all"}),
                      2, has_input ? 1 : 0, 1);
  }
}

TEST(Wrap, NoModelHidesTheToolsHeader) {
  const support::TemporaryFolder folder;
  const ProcessResult made =
      wrap(model_file("pendulum"), "simulink", folder.path() + "/none", {"--name", "simstruc"});
  EXPECT_EQ(made.status, 2);
  EXPECT_THAT(made.output, HasSubstr("simstruc.h is the header of simulink"));
}

TEST(Wrap, CasadiIsRefusedWhatItCannotHave) {
  const support::TemporaryFolder folder;
  for (const auto& [model, words] : {std::pair("squeezer", "closed loops"),
                                     {"quadrotor", "quaternions"},
                                     {"shaking_cart", "depend on time"}}) {
    const ProcessResult made = wrap(model_file(model), "casadi", folder.path() + "/none");
    EXPECT_EQ(made.status, 2) << made.output;
    EXPECT_THAT(made.output, HasSubstr("error: casadi is not given rates"));
    EXPECT_THAT(made.output, HasSubstr(words));
  }
  EXPECT_EQ(wrap(model_file("pendulum"), "modelica", folder.path()).status, 2);
}

/// Runs a block and gives what its ports hold, or its sentence.
ProcessResult run_block(const std::string& model, const std::string& method,
                        const std::vector<std::string>& words) {
  const support::TemporaryFolder folder;
  const std::string path = folder.path() + "/" + model;
  const ProcessResult made = wrap(model_file(model), "simulink", folder.path(), {"--method", method});
  EXPECT_EQ(made.status, 0) << made.output;
  compile("gcc", {"-O1", "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all",
                  "-I" + kSource + "/tests/wrap", path + "_sfunction.c", path + "_interface.c", path + ".c",
                  "-o", path, "-lm"});
  std::vector<std::string> command = {path};
  command.insert(command.end(), words.begin(), words.end());
  return support::run_process(command);
}

/// The last row of what the command simulates with inputs as cg_sfun.h has them, one at most; without time.
Numbers simulated(const std::string& model, const std::string& method, const std::string& duration,
                  const std::string& step, std::size_t count) {
  const ProcessResult result = run_script(
      kSource, fmt::format("'{}' simulate models/{}.toml {} --duration {} --step {} --every 1 --method {} "
                           "--output - 2>/dev/null",
                           JOURDAIN_BINARY, model, model == "cart_pole" ? "--constant-input 0.1" : "",
                           duration, step, method));
  std::istringstream rows(result.output);
  std::string row, last;
  while (std::getline(rows, row)) last = row;
  std::istringstream entries(last);
  Numbers numbers;
  std::getline(entries, row, ',');
  while (numbers.size() < count && std::getline(entries, row, ',')) numbers.push_back(std::stod(row));
  return numbers;
}

TEST(Wrap, SimulinkStepsAsTheCommandDoes) {
  for (const auto& [model, method, step, duration, size] :
       {std::tuple("squeezer", "rk4", "1e-5", "1e-3", 8u),
        {"shaking_cart", "adams_bashforth2", "1e-3", "0.1", 2u},
        {"cart_pole", "adams_bashforth2", "1e-3", "0.1", 4u},
        {"cart_pole", "linearly_implicit_euler", "1e-3", "0.1", 4u}}) {
    const ProcessResult ran = run_block(model, method, {"100", step});
    ASSERT_EQ(ran.status, 0) << ran.output;
    std::istringstream ports(ran.output);
    const Numbers expected = simulated(model, method, duration, step, size);
    ASSERT_EQ(expected.size(), size);
    for (const double number : expected) {
      double got = 0;
      ASSERT_TRUE(ports >> got) << ran.output;
      EXPECT_NEAR(got, number, 1e-10 * (1 + std::fabs(number))) << model;
    }
  }
}

TEST(Wrap, SimulinkIsToldWhatGoesWrong) {
  EXPECT_EQ(run_block("quadrotor", "rk4", {"10", "1e-3"}).status, 0);
  EXPECT_EQ(run_block("quadrotor", "rk4", {"10", "1e-3", "0.1"}).status, 0);
  const ProcessResult no_step = run_block("quadrotor", "rk4", {"10", "0"});
  EXPECT_THAT(no_step.output, HasSubstr("the length of a step has to be one positive number"));
  EXPECT_EQ(no_step.status, 3);
  for (const char* length : {"inf", "nan", "-1", "[]"})
    EXPECT_EQ(run_block("quadrotor", "rk4", {"10", length}).status, 3) << length;
  EXPECT_THAT(run_block("quadrotor", "rk4", {"10", "1e-3", "1", "2"}).output,
              HasSubstr("the model has 1 parameters"));
  EXPECT_THAT(run_block("quadrotor", "rk4", {"10", "1e-3", "nan"}).output, HasSubstr("is not finite"));
  EXPECT_THAT(run_block("quadrotor", "rk4", {"100000", "1e3"}).output, HasSubstr("the step may be too long"));
  EXPECT_THAT(run_block("squeezer", "rk4", {"1000", "1e-2"}).output, HasSubstr("squeezer: "));
}

TEST(WrapPage, ItsCommandsWriteAndCompile) {
  const support::TemporaryFolder folder;
  const std::string page = support::read_file(kSource + "/runtime/tools.md"), fence = "```sh\n";
  const std::size_t begin = page.find(fence) + fence.size();
  const ProcessResult result =
      run_script(kSource, page.substr(begin, page.find("```", begin) - begin),
                 {"BUILD=" + command_folder(), "PROJECT=" + folder.path() + "/wrapped"});
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("quadrotor_sfunction.c"));
}

}  // namespace
}  // namespace jourdain::tests
