#include "commands/fmu_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <zip.h>

#include <algorithm>
#include <map>
#include <memory>

#include "commands/tool.hpp"
#include "emit/templates.hpp"
#include "support/check.hpp"

namespace jourdain::commands {

using support::FileText;

namespace {

/// Entries of a C array that has one more, so that none is empty.
std::string entries(const std::vector<std::size_t>& list) {
  return list.empty() ? "0" : fmt::format("{}, 0", fmt::join(list, ", "));
}

/// A literal of C that is a double.
std::string literal(double number) {
  std::string text = fmt::format("{}", number);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

/// Of the continuous states.
std::string nominals(const FmuScene& scene) {
  std::string list;
  for (const std::size_t reference : state_references(scene))
    list += literal(scene.numbers[reference].nominal.value_or(1)) + ", ";
  return list + "1.0";
}

std::map<std::string, std::string> holes(const FmuScene& scene, const std::string& token) {
  const programs::SceneFacts& facts = scene.facts;
  std::vector<std::size_t> velocities, quaternions;
  for (const std::size_t position : scene.positions) {
    std::size_t velocity = 0;
    for (const model::Tangent::Scalar& scalar : facts.tangent.scalars)
      if (scalar.position == position) velocity = scalar.velocity;
    // What is carried along has columns of displacements behind those of velocities.
    for (std::size_t k = 0; k < facts.carried.size(); ++k)
      if (facts.carried[k] == position) velocity = facts.moving() + k;
    velocities.push_back(velocity);
  }
  for (const model::Tangent::Scalar& quaternion : facts.tangent.quaternions)
    quaternions.push_back(quaternion.position);
  const auto count = [](std::size_t number) { return fmt::format("{}", number); };
  return {{"N", scene.name},
          {"TITLE", scene.name},
          {"GENERATOR", scene.generator},
          {"NY", count(facts.positions.size())},
          {"NZ", count(facts.velocities.size())},
          {"ND", count(facts.displacements())},
          {"NU", count(facts.inputs.size())},
          {"NO", count(facts.output_numbers())},
          {"NP", count(facts.parameters.size())},
          {"NS", count(scene.positions.size())},
          {"NQ", count(quaternions.size())},
          {"KEPT_Y", count(facts.kept_positions.size())},
          {"KEPT_Z", count(facts.kept_velocities.size())},
          {"NV", count(scene.numbers.size())},
          {"REDUCED", facts.is_reduced ? "1" : "0"},
          {"DERIVATIVES", scene.has_derivatives ? "1" : "0"},
          {"TOKEN", token},
          {"CORRECTION", scene.correction},
          {"METHOD", scene.method + "_step"},
          {"STEP", literal(scene.step)},
          {"STATE_POSITIONS", entries(scene.positions)},
          {"STATE_VELOCITIES", entries(velocities)},
          {"NOMINALS", nominals(scene)},
          {"QUATERNIONS", entries(quaternions)},
          {"KEPT_POSITIONS", entries(facts.kept_positions)},
          {"KEPT_VELOCITIES", entries(facts.kept_velocities)}};
}

/// Closes what zip_close would write elsewhere.
struct Discard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};

/// 1 January 1980, the first day that archives know.
constexpr zip_uint16_t kTime = 0, kDate = (1 << 5) | 1;
constexpr zip_uint32_t kReadableByAll = 0100644u << 16;

void add(zip_t* archive, const FileText& file) {
  zip_source_t* source = zip_source_buffer(archive, file.text.data(), file.text.size(), 0);
  const zip_int64_t index =
      source ? zip_file_add(archive, file.name.c_str(), source, ZIP_FL_ENC_UTF_8) : zip_int64_t{-1};
  if (index < 0 && source) zip_source_free(source);
  if (index < 0 || zip_file_set_dostime(archive, static_cast<zip_uint64_t>(index), kTime, kDate, 0) != 0 ||
      zip_file_set_external_attributes(archive, static_cast<zip_uint64_t>(index), 0, ZIP_OPSYS_UNIX,
                                       kReadableByAll) != 0 ||
      zip_set_file_compression(archive, static_cast<zip_uint64_t>(index), ZIP_CM_DEFLATE, 9) != 0)
    throw support::EnvironmentError(
        fmt::format("libzip cannot add {}: {}", file.name, zip_strerror(archive)));
}

std::string contents(zip_source_t* source) {
  zip_stat_t about;
  if (zip_source_stat(source, &about) != 0 || zip_source_open(source) != 0)
    throw support::EnvironmentError("libzip cannot read the archive that it wrote");
  std::string bytes(about.size, '\0');
  const zip_int64_t read = zip_source_read(source, bytes.data(), bytes.size());
  zip_source_close(source);
  if (read != static_cast<zip_int64_t>(bytes.size()))
    throw support::EnvironmentError("libzip cannot read the archive that it wrote");
  return bytes;
}

}  // namespace

std::vector<FileText> fmu_sources(const FmuScene& scene, FmiVersion version, const std::string& token,
                                  const std::vector<FileText>& model_files) {
  std::vector<FileText> files;
  for (const FileText& file : model_files)
    if (file.name.ends_with(".c") || file.name.ends_with(".h")) files.push_back(file);
  const bool is_2 = version == FmiVersion::k2;
  const std::string header = is_2 ? "fmi2.h" : "fmi3.h";
  files.push_back({header, std::string(emit::template_text(header))});
  std::string text;
  for (const char* part : {"fmu_core.c.in", "fmu_values.c.in", "fmu_steps.c.in"})
    text += emit::template_text(part);
  text += emit::template_text(is_2 ? "fmi2.c.in" : "fmi3.c.in");
  if (!is_2) text += emit::template_text("fmi3_absent.c.in");
  std::map<std::string, std::string> values = holes(scene, token);
  values["HEADER"] = header;
  values["VERSION"] = is_2 ? "2.0" : "3.0";
  files.push_back({fmt::format("{}_fmi{}.c", scene.name, is_2 ? 2 : 3), emit::fill(text, values)});
  return files;
}

std::vector<std::string> compiled_sources(const std::vector<FileText>& files) {
  std::vector<std::string> names;
  for (const FileText& file : files)
    if (file.name.ends_with(".c")) names.push_back(file.name);
  return names;
}

std::string platform_of(const std::vector<std::string>& compiler, FmiVersion version) {
  std::vector<std::string> command = compiler;
  command.emplace_back("-dumpmachine");
  std::string machine = run_tool(command);
  machine = machine.substr(0, machine.find('\n'));
  const std::string processor = machine.substr(0, machine.find('-'));
  const bool is_linux = machine.find("linux") != std::string::npos;
  if (is_linux && processor == "x86_64") return version == FmiVersion::k2 ? "linux64" : "x86_64-linux";
  if (is_linux && processor == "aarch64") return "aarch64-linux";
  throw support::EnvironmentError(fmt::format(
      "'{}' compiles for '{}', which has no folder in an FMU here; --sources-only leaves the library out",
      fmt::join(compiler, " "), machine));
}

std::string zip_archive(const std::vector<FileText>& files) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(nullptr, 0, 0, &error);
  zip_t* opened = source ? zip_open_from_source(source, ZIP_TRUNCATE, &error) : nullptr;
  if (!opened) throw support::EnvironmentError(fmt::format("libzip: {}", zip_error_strerror(&error)));
  std::unique_ptr<zip_t, Discard> archive(opened);
  const std::unique_ptr<zip_source_t, void (*)(zip_source_t*)> kept(source, zip_source_free);
  zip_source_keep(source);
  for (const FileText& file : files) add(archive.get(), file);
  if (zip_close(archive.get()) != 0)
    throw support::EnvironmentError(fmt::format("libzip: {}", zip_strerror(archive.get())));
  static_cast<void>(archive.release());  // zip_close has freed it
  return contents(source);
}

}  // namespace jourdain::commands
