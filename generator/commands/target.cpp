#include "commands/target.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "commands/tool.hpp"
#include "emit/templates.hpp"
#include "support/check.hpp"
#include "support/files.hpp"
#include "support/process.hpp"

namespace jourdain::commands {

namespace {

/// A row of an Arm Cortex-M.
Target cortex_m(const char* name, const char* processor, bool usually_float, const char* cpu, const char* fpu,
                const char* machine) {
  return {name,
          processor,
          usually_float,
          "arm-none-eabi-",
          {fmt::format("-mcpu={}", cpu), "-mthumb", "-mfloat-abi=hard", fmt::format("-mfpu={}", fpu)},
          "cortex_m",
          "bx lr",
          {"qemu-system-arm", "-M", machine},
          "gcc-arm-none-eabi",
          "libnewlib-arm-none-eabi",
          "qemu-system-arm"};
}

/// Of emitted code. No contraction: the same bits everywhere. Without errno a square root is one instruction.
const std::vector<std::string>& code_options() {
  static const std::vector<std::string> options = {"-O2", "-ffp-contract=off", "-fno-math-errno",
                                                   "-ffunction-sections", "-fdata-sections"};
  return options;
}

std::vector<std::string> compiler(const Target& target, const char* language,
                                  const std::vector<std::string>& options) {
  std::vector<std::string> command = {target.tools + language};
  for (const std::vector<std::string>* list : {&options, &target.options, &code_options()})
    command.insert(command.end(), list->begin(), list->end());
  return command;
}

/// What a program says; nothing where it cannot be started or fails.
std::string words_of(const std::vector<std::string>& command) {
  try {
    const support::ProcessResult result = support::run_process(command);
    return result.status == 0 ? result.output.substr(0, result.output.find('\n')) : "";
  } catch (const support::EnvironmentError&) {
    return "";
  }
}

[[noreturn]] void missing(const Target& target, const std::string& what, const std::string& package) {
  throw support::EnvironmentError(
      fmt::format("target '{}' needs {}; Debian has it in the package {}", target.name, what, package));
}

}  // namespace

const std::vector<Target>& all_targets() {
  static const std::vector<Target> targets = {
      cortex_m("cortex-m4", "Arm Cortex-M4F, single precision in hardware", true, "cortex-m4", "fpv4-sp-d16",
               "mps2-an386"),
      cortex_m("cortex-m7", "Arm Cortex-M7, double precision in hardware", false, "cortex-m7", "fpv5-d16",
               "mps2-an500"),
      {"rv64",
       "RISC-V rv64gc, double precision in hardware",
       false,
       "riscv64-unknown-elf-",
       {"-march=rv64gc", "-mabi=lp64d", "-mcmodel=medany", "--specs=picolibc.specs"},
       "riscv64",
       "ret",
       {"qemu-system-riscv64", "-M", "virt", "-bios", "none"},
       "gcc-riscv64-unknown-elf",
       "picolibc-riscv64-unknown-elf",
       "qemu-system-misc"},
  };
  return targets;
}

std::vector<std::string> target_names() {
  std::vector<std::string> names;
  for (const Target& target : all_targets()) names.push_back(target.name);
  return names;
}

const Target* find_target(const std::string& name) {
  for (const Target& target : all_targets())
    if (target.name == name) return &target;
  return nullptr;
}

std::string check_target(const std::string& name) {
  if (find_target(name)) return "";
  return fmt::format("no target '{}'; there are {}", name, fmt::join(target_names(), ", "));
}

void check_tools(const Target& target) {
  const std::string compiler = target.tools + "g++", simulator = target.machine.front();
  if (compiler_version(target).empty())
    missing(target, fmt::format("the compiler '{}'", compiler), target.compiler_package);
  if (simulator_version(target).empty())
    missing(target, fmt::format("the simulator '{}'", simulator), target.simulator_package);
  std::vector<std::string> command = target_c_compiler(target);
  for (const char* argument : {"-E", "-include", "math.h", "-x", "c", "/dev/null"})
    command.emplace_back(argument);
  if (words_of(command).empty())
    missing(target, fmt::format("a C library for '{}'", compiler), target.library_package);
}

std::string compiler_version(const Target& target) { return words_of({target.tools + "g++", "--version"}); }

std::string simulator_version(const Target& target) {
  return words_of({target.machine.front(), "--version"});
}

std::vector<std::string> target_compiler(const Target& target) {
  return compiler(target, "g++", {"-std=c++17", "-fno-exceptions", "-fno-rtti", "-fno-threadsafe-statics"});
}

std::vector<std::string> target_c_compiler(const Target& target) {
  return compiler(target, "gcc", {"-std=c99"});
}

void write_board(const Target& target, const std::string& folder) {
  for (const std::string& file : {std::string("board.h"), target.board + ".c", target.board + ".ld"})
    support::write_file(folder + "/" + file, emit::template_text(file));
}

void link_firmware(const Target& target, const std::string& folder, const std::string& name,
                   const std::vector<std::string>& objects) {
  const std::string board = folder + "/" + target.board;
  std::vector<std::string> command = target_c_compiler(target);
  command.push_back(board + ".c");
  command.insert(command.end(), objects.begin(), objects.end());
  for (const std::string& argument :
       {std::string("-nostartfiles"), "-T" + board + ".ld", std::string("-Wl,--gc-sections"),
        std::string("-lm"), std::string("-o"), folder + "/" + name + ".elf"})
    command.push_back(argument);
  run_tool(command);
}

std::string run_firmware(const Target& target, const std::string& folder, const std::string& name) {
  std::vector<std::string> command = target.machine;
  for (const std::string& argument :
       {std::string("-display"), std::string("none"), std::string("-monitor"), std::string("none"),
        std::string("-serial"), std::string("none"), std::string("-icount"), std::string("shift=0"),
        std::string("-semihosting-config"), std::string("enable=on,target=native"), std::string("-kernel"),
        folder + "/" + name + ".elf"})
    command.push_back(argument);
  const support::ProcessResult result = support::run_process(command);
  if (result.status != 0)
    throw support::EnvironmentError(fmt::format("the simulated {} ends with status {}:\n{}", target.processor,
                                                result.status, result.output.substr(0, 2000)));
  return result.output;
}

}  // namespace jourdain::commands
