#include "firmware/firmware.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "commands/tool.hpp"
#include "support/check.hpp"
#include "support/files.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {

namespace {

namespace fs = std::filesystem;
using commands::Target;
using Command = std::vector<std::string>;

const std::string kPrograms = JOURDAIN_SOURCE_DIR "/tests/firmware/programs/";
const std::string kBoard = JOURDAIN_SOURCE_DIR "/templates/firmware";

/// Of emitted code and of the tests' programs.
const Command kStrict = {"-Wall",    "-Wextra", "-Wpedantic",         "-Wconversion",
                         "-Wshadow", "-Werror", "-Wdouble-promotion", "-I" + kBoard};

/// Functions that a compiler knows are computed, folded and paired by it: these shall be called.
const Command kCalled = {"-fno-builtin-sin",  "-fno-builtin-cos",  "-fno-builtin-atan2",
                         "-fno-builtin-sinf", "-fno-builtin-cosf", "-fno-builtin-atan2f"};

Command joined(std::initializer_list<Command> lists) {
  Command all;
  for (const Command& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

/// Runs a command that makes `file`, unless it is there.
void make(const std::string& file, const Command& command) {
  if (!fs::exists(file)) commands::run_tool(joined({command, {"-o", file}}));
}

Command model_options(const Motion& motion) {
  return {"-DMODEL=" + motion.model, "-DREAL=" + motion.real, "-DSTEP=" + motion.step,
          fmt::format("-DKERNELS=\"{0}_kernels.hpp\"", motion.model),
          fmt::format("-I{}/{}", JOURDAIN_EMITTED, motion.model)};
}

/// What the names and files of a model's C text begin with.
std::string prefix_of(const Motion& motion) {
  return motion.real == "float" ? motion.model + "_f" : motion.model;
}

/// A folder with the C text of a model.
std::string c_folder(const Motion& motion) {
  const std::string folder = firmware_folder() + "/c_" + motion.model;
  if (!fs::exists(folder))
    commands::run_tool({"env", "-C", JOURDAIN_SOURCE_DIR, JOURDAIN_BINARY, "compile",
                        fmt::format("models/{}.toml", motion.model), "--language", "c", "-o", folder});
  return folder;
}

Command c_model_options(const Motion& motion) {
  const std::string folder = c_folder(motion), prefix = prefix_of(motion);
  const auto manifest = nlohmann::json::parse(support::read_file(folder + "/" + motion.model + ".json"));
  Command options = {"-DPREFIX=" + prefix, "-DREAL=" + motion.real, "-DSTEP=" + motion.step,
                     fmt::format("-DHEADER=\"{}.h\"", prefix), "-I" + folder};
  if (manifest["input_count"] > 0) options.push_back("-DINPUTS");
  if (manifest["output_count"] > 0) options.push_back("-DOUTPUTS");
  if (support::read_file(folder + "/" + prefix + ".h").find("_time t;") != std::string::npos)
    options.push_back("-DCLOCK");
  return options;
}

std::string file_of(const std::string& machine, const Motion& motion, const std::string& rest) {
  return fmt::format("{}/{}_{}_{}{}", firmware_folder(), machine, motion.model, motion.real, rest);
}

/// Of the program and the model.
Command model_objects(const std::string& machine, const Command& cxx, const Command& c, const Motion& motion,
                      bool own_sines) {
  const std::string kind = own_sines ? "_own" : "";
  const Command sines = own_sines ? Command{} : Command{"-DJOURDAIN_LIBRARY_SINES"};
  if (motion.is_c) {
    const std::string program = file_of(machine, motion, "_c.o"),
                      model = file_of(machine, motion, kind + "_text.o");
    make(program, joined({c, kStrict, kCalled, c_model_options(motion), {"-c", kPrograms + "motion.c"}}));
    make(model,
         joined({c, kStrict, kCalled, sines, {"-c", c_folder(motion) + "/" + prefix_of(motion) + ".c"}}));
    return {program, model};
  }
  const std::string program = file_of(machine, motion, kind + ".o");
  make(program,
       joined({cxx, kStrict, kCalled, sines, model_options(motion), {"-c", kPrograms + "motion.cpp"}}));
  return {program};
}

/// The model's objects and that of disturbed sines.
Command objects(const std::string& machine, const Command& cxx, const Command& c, const Motion& motion,
                Sines sines, unsigned pattern = 0) {
  Command linked = model_objects(machine, cxx, c, motion, sines == Sines::kOwn);
  if (sines != Sines::kWobbling) return linked;
  linked.push_back(fmt::format("{}/{}_wobble_{}.o", firmware_folder(), machine, pattern));
  make(linked.back(),
       joined({c, kStrict, kCalled, {fmt::format("-DPATTERN={}u", pattern), "-c", kPrograms + "wobble.c"}}));
  return linked;
}

std::vector<Line> read_lines(const std::string& output) {
  std::vector<Line> lines;
  std::istringstream text(output);
  for (std::string row; std::getline(text, row);) {
    std::istringstream fields(row);
    Line line;
    fields >> line.what;
    for (std::string bits; fields >> bits;) {
      const std::uint64_t number = std::stoull(bits, nullptr, 16);
      line.bits.push_back(bits);
      line.values.push_back(
          bits.size() == 8 ? static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(number)))
                           : std::bit_cast<double>(number));
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

/// Names the firmware of a motion in its folder.
std::string firmware_name(const Target& target, const Motion& motion, Sines sines) {
  return fmt::format("{}_{}_{}_{}_{}", target.name, motion.model, motion.real, motion.is_c ? "c" : "cpp",
                     sines == Sines::kOwn ? "own" : "library");
}

void build_firmware(const Target& target, const Motion& motion, Sines sines) {
  const std::string name = firmware_name(target, motion, sines);
  if (fs::exists(firmware_folder() + "/" + name + ".elf")) return;
  const Command linked = objects(target.name, commands::target_compiler(target),
                                 commands::target_c_compiler(target), motion, sines);
  commands::write_board(target, firmware_folder());
  commands::link_firmware(target, firmware_folder(), name, linked);
}

}  // namespace

Motion motion_of(const std::string& model, const std::string& real) {
  return {model, real, model == "squeezer" ? "1e-4" : "1e-3"};
}

Motion motion_of(const std::string& model, const Target& target) {
  return motion_of(model, target.usually_float ? "float" : "double");
}

std::map<std::string, double> differences(const std::vector<Line>& a, const std::vector<Line>& b) {
  std::map<std::string, double> largest, difference, unit;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
    for (std::size_t k = 0; k < a[i].values.size(); ++k) {
      double& most = difference[a[i].what];
      most = std::max(most, std::fabs(a[i].values[k] - b[i].values.at(k)));
      largest[a[i].what] = std::max(largest[a[i].what], std::fabs(a[i].values[k]));
      unit[a[i].what] = a[i].bits[k].size() == 8 ? 0x1p-23 : 0x1p-52;
    }
  for (auto& [what, most] : difference)
    if (largest[what] > 0) most /= std::exp2(std::floor(std::log2(largest[what]))) * unit[what];
  return difference;
}

void require_tools(const Target& target) {
  try {
    commands::check_tools(target);
  } catch (const support::EnvironmentError& error) {
    FAIL() << error.what() << "; ./dev installs it";
  }
}

const std::string& firmware_folder() {
  static const support::TemporaryFolder folder;
  return folder.path();
}

std::vector<Line> host_motion(const Motion& motion, Sines sines, unsigned pattern) {
  const Command options = {"-O2", "-ffp-contract=off", "-fno-math-errno"};
  const Command c = joined({{"gcc", "-std=c99"}, options});
  Command link =
      joined({{"gcc"}, objects("host", joined({{"g++", "-std=c++17"}, options}), c, motion, sines, pattern)});
  if (sines == Sines::kWobbling)
    for (const char* name : {"sin", "cos", "atan2", "sinf", "cosf", "atan2f"})
      link.push_back(fmt::format("-Wl,--wrap={}", name));
  const std::string board = firmware_folder() + "/host_board.o";
  make(board, joined({c, kStrict, {"-c", kPrograms + "host_board.c"}}));
  const std::string program =
      file_of("host", motion, fmt::format("_{}_{}", static_cast<int>(sines), pattern));
  make(program, joined({link, {board, "-lm"}}));
  return read_lines(commands::run_tool({program}));
}

std::vector<Line> target_motion(const Target& target, const Motion& motion, Sines sines) {
  build_firmware(target, motion, sines);
  return read_lines(commands::run_firmware(target, firmware_folder(), firmware_name(target, motion, sines)));
}

std::string firmware_symbols(const Target& target, const Motion& motion, Sines sines) {
  build_firmware(target, motion, sines);
  return commands::run_tool(
      {target.tools + "nm", firmware_folder() + "/" + firmware_name(target, motion, sines) + ".elf"});
}

std::string run_program(const Target& target, const std::string& name) {
  const std::string object = fmt::format("{}/{}_{}", firmware_folder(), target.name, name);
  const Command c = commands::target_c_compiler(target);
  commands::write_board(target, firmware_folder());
  // Semihosting and counters are written in the compiler's own assembler.
  make(object + ".o", joined({c, kStrict, {"-c", kPrograms + name + ".c"}}));
  commands::link_firmware(target, firmware_folder(), target.name + "_" + name, {object + ".o"});
  return commands::run_firmware(target, firmware_folder(), target.name + "_" + name);
}

nlohmann::json target_cost(const std::string& model, const Target& target,
                           const std::vector<std::string>& more, bool fresh) {
  const std::string file =
      fmt::format("{}/cost_{}_{}_{}.json", firmware_folder(), model, target.name, fmt::join(more, "_"));
  if (fresh || !fs::exists(file))
    commands::run_tool(joined({{"env", "-C", JOURDAIN_SOURCE_DIR, JOURDAIN_BINARY, "cost",
                                fmt::format("models/{}.toml", model), "--target", target.name, "-o", file},
                               more}));
  return nlohmann::json::parse(support::read_file(file));
}

}  // namespace jourdain::tests
