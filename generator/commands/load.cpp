#include "commands/load.hpp"

#include <fmt/format.h>
#include <nettle/sha2.h>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include <array>
#include <cstdio>
#include <filesystem>

#include "loops/closed_system.hpp"
#include "model/names.hpp"
#include "start_check.hpp"
#include "support/files.hpp"

namespace jourdain::commands {

namespace {

std::string sha256(const std::string& text) {
  sha256_ctx context;
  sha256_init(&context);
  sha256_update(&context, text.size(), reinterpret_cast<const std::uint8_t*>(text.data()));
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest{};
  sha256_digest(&context, digest.size(), digest.data());
  std::string hex;
  for (std::uint8_t byte : digest) hex += fmt::format("{:02x}", byte);
  return hex;
}

/// Emitted files name no folder: they are the same from wherever the command was called.
std::string printed_path(const std::string& path) { return std::filesystem::path(path).filename().string(); }

std::string check_name(const std::string& name) {
  if (!model::is_identifier(name) || name.find("__") != std::string::npos || name[0] == '_')
    return fmt::format("'{}' is not a C++ identifier that may name a namespace", name);
  if (model::is_reserved(name) || model::cpp_name(name) != name)
    return fmt::format("'{}' is reserved; try '{}'", name, model::cpp_name(name));
  return "";
}

}  // namespace

void ModelArguments::add_to(CLI::App& command) {
  command.add_option("MODEL", path, "model description: .toml, or .urdf")->required();
  command.add_option("--name", name, "namespace and file name of the emitted code")->check(check_name);
  command.add_option("--root", root, "URDF: root link fixed to the world, or free")
      ->check(CLI::IsMember({"fixed", "free"}));
  command.add_option("--lock", read.locked_joints, "joints to lock at coordinate zero")->delimiter(',');
  command.add_flag("!--no-damping", read.damping, "URDF: leave out joint damping");
  command.add_flag("!--no-snap", read.snap, "keep rotation entries that are nearly 0 or ±1 as they are");
  command
      .add_option("--derivatives", derivatives,
                  "terms that linearly implicit steps differentiate: all, or those of applied forces but "
                  "gravity (fewer "
                  "operations)")
      ->check(CLI::IsMember({"all", "applied"}))
      ->capture_default_str();
}

std::optional<LoadedMechanism> load(const ModelArguments& arguments) {
  support::Diagnostics diagnostics(arguments.path, support::read_file(arguments.path));
  model::ReadOptions read = arguments.read;
  read.root = arguments.root == "free" ? model::RootJoint::kFree : model::RootJoint::kFixed;
  std::optional<model::Mechanism> mechanism = model::read_mechanism(diagnostics, read);
  if (mechanism) check_inertia(*mechanism, diagnostics);
  if (mechanism) check_start(*mechanism, diagnostics);
  std::optional<loops::LoopPlan> plan;
  if (mechanism && !diagnostics.has_errors()) plan = loops::plan_loops(*mechanism, diagnostics);
  fmt::print(stderr, "{}", diagnostics.format());
  if (!mechanism || diagnostics.has_errors()) return std::nullopt;
  LoadedMechanism loaded{std::move(*mechanism), {}};
  if (!arguments.path.ends_with(".toml")) loaded.limits = model::read_urdf_limits(diagnostics.text());
  loaded.options.name = arguments.name.empty() ? model::cpp_name(loaded.mechanism.name) : arguments.name;
  loaded.options.loops = std::move(plan);
  if (loaded.options.loops) fmt::print(stderr, "{}", loops::assembly_text(*loaded.options.loops));
  loaded.options.path = printed_path(arguments.path);
  loaded.options.sha256 = sha256(diagnostics.text());
  loaded.options.damping = read.damping;
  if (arguments.derivatives == "applied") loaded.options.derivative_terms = DerivativeTerms::kApplied;
  if (arguments.name.empty() && loaded.options.name != loaded.mechanism.name)
    fmt::print(stderr, "note: model '{}' becomes namespace '{}' (--name chooses another)\n",
               loaded.mechanism.name, loaded.options.name);
  return loaded;
}

std::size_t LoadedMechanism::freedom() const { return plan() ? plan()->freedom : velocity_count(); }

std::string freedom_text(const LoadedMechanism& loaded) {
  return fmt::format("{} degree{} of freedom", loaded.freedom(), loaded.freedom() == 1 ? "" : "s");
}

std::vector<std::string> loop_sentences(const LoadedMechanism& loaded) {
  if (!loaded.plan()) return {};
  std::vector<std::string> list = loops::sentences(loaded.mechanism, *loaded.plan());
  const std::vector<loops::Moved>& moved = loaded.plan()->moved;
  for (const loops::Moved& m : moved)
    list.push_back(fmt::format("the initial state closes with {}{} = {:.10g} instead of {:.10g}",
                               m.coordinate, m.velocity ? "'s velocity" : "", m.to, m.from));
  if (moved.empty()) list.push_back("the initial state of the description is closed as it is");
  return list;
}

void print_refusal(const validate::Verdict& verdict) {
  constexpr std::size_t kShown = 10;
  for (std::size_t i = 0; i < std::min(kShown, verdict.failures.size()); ++i)
    fmt::print(stderr, "error: refused to emit: {}\n", verdict.failures[i]);
  if (verdict.failures.size() > kShown)
    fmt::print(stderr, "error: and {} more\n", verdict.failures.size() - kShown);
}

}  // namespace jourdain::commands
