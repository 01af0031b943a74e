#include "fuzz/cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "fuzz/arguments.hpp"
#include "fuzz/byte_mutation.hpp"
#include "fuzz/hostile_values.hpp"
#include "fuzz/random_urdf.hpp"
#include "fuzz/toml_mutation.hpp"
#include "fuzz/xml_mutation.hpp"
#include "properties/random_linkages.hpp"
#include "properties/refusals.hpp"
#include "properties/to_toml.hpp"

namespace jourdain::tests {

namespace {

using support::FileText;

/// Texts of the files with that extension in a folder of the sources.
std::vector<FileText> texts(const std::string& folder, const std::string& extension) {
  std::vector<FileText> found;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(JOURDAIN_SOURCE_DIR) / folder))
    if (entry.path().extension() == extension)
      found.push_back({entry.path().stem().string(), support::read_file(entry.path().string())});
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return found;
}

const std::vector<FileText>& models() {
  static const std::vector<FileText> list = texts("models", ".toml");
  return list;
}

const std::vector<FileText>& robots() {
  static const std::vector<FileText> list = texts("tests/data/robots", ".urdf");
  return list;
}

const std::vector<FileText>& mjcf_files() {
  static const std::vector<FileText> list = texts("tests/data/mjcf", ".xml");
  return list;
}

/// Large ones, which take long, are rare.
const FileText& any_model(Random& random) {
  constexpr std::size_t kLarge = 2'600;
  for (;;)
    if (const FileText& model = one_of(models(), random); model.text.size() < kLarge || random.chance(0.05))
      return model;
}

/// Not all of the tests' robots may have a free root.
std::string any_robot(Random& random) {
  return random.chance(0.05) ? one_of(robots(), random).text : random_urdf(random);
}

int few(Random& random) { return 1 + static_cast<int>(random.below(random.chance(0.7) ? 2 : 6)); }

Case compiled(CaseKind kind, const std::string& file, std::string text, std::string origin) {
  return {kind, {"compile", file, "-o", "out"}, {{file, std::move(text)}}, false, std::move(origin)};
}

Case toml_case(Random& random) {
  const FileText& model = any_model(random);
  const FileText& other = any_model(random);
  Node tree = read_tree(model.text), donor = read_tree(other.text);
  for (int times = few(random); times > 0; --times) mutate(tree, donor, random);
  return compiled(CaseKind::kToml, "model.toml", print_tree(tree),
                  fmt::format("{}, with {}", model.name, other.name));
}

Case urdf_case(Random& random) {
  const bool valid = random.chance(0.3);
  std::string text = valid ? random_urdf(random) : mutated_urdf(any_robot(random), few(random), random);
  Case result = compiled(CaseKind::kUrdf, "model.urdf", std::move(text), valid ? "valid robot" : "robot");
  result.must_pass = valid;
  if (random.chance(0.3)) result.arguments.insert(result.arguments.end(), {"--root", "free"});
  return result;
}

Case mjcf_case(Random& random) {
  static const XmlWords kWords{
      .elements = {"body",    "joint",    "freejoint", "inertial", "geom", "site",
                   "default", "compiler", "equality",  "connect",  "weld", "actuator",
                   "motor",   "position", "general",   "keyframe", "key",  "include",
                   "tendon",  "mujoco",   "worldbody", "Body",     "frame"},
      .values = {"",           " ",
                 "1 2",        "1 2 3 4",
                 "1,2,3",      "nan nan nan",
                 "1e999 0 0",  "0 0 0",
                 "0 0 0 0",    "1e308 1e308 1e308",
                 "1e-320 0 0", "0x10",
                 "free",       "ball",
                 "slide",      "hinge",
                 "box",        "mesh",
                 "capsule",    "world",
                 "main",       "true",
                 "auto",       "radian",
                 "zyx",        "1 0 1e-17",
                 "1 0 0 1e-9", "1 0 0 0 1 0 0"},
      .attributes = {"name",        "class",    "childclass", "pos",     "quat",   "axisangle", "euler",
                     "xyaxes",      "zaxis",    "type",       "axis",    "ref",    "springref", "stiffness",
                     "damping",     "armature", "mass",       "density", "size",   "fromto",    "diaginertia",
                     "fullinertia", "gear",     "joint",      "joint1",  "joint2", "body1",     "body2",
                     "anchor",      "polycoef", "relpose",    "active",  "site1",  "qpos",      "kp",
                     "eulerseq",    "angle",    "limited",    "range"}};
  const FileText& file = one_of(mjcf_files(), random);
  return compiled(CaseKind::kMjcf, "model.xml", mutated_xml(file.text, kWords, few(random), random),
                  file.name);
}

Case bytes_case(Random& random) {
  const FileText& model = any_model(random);
  std::string name = "model.toml", text = model.text, origin = model.name;
  if (random.chance(0.3)) {
    name = "model.urdf";
    text = any_robot(random);
    origin = "random robot";
  } else if (random.chance(0.2)) {
    name = "model.xml";
    const FileText& file = one_of(mjcf_files(), random);
    text = file.text;
    origin = file.name;
  }
  for (int times = few(random); times > 0; --times)
    text = mutated_bytes(std::move(text), any_model(random).text, random);
  return compiled(CaseKind::kBytes, name, std::move(text), std::move(origin));
}

/// Whether numbers are as they were drawn: what rounds lengths of a linkage that must fit leaves its velocities
/// contradicting each other.
bool is_exact(const ValidKind& kind, std::uint64_t seed) {
  const std::vector<LinkageKind>& kinds = linkage_kinds();
  return kind.name != "linkages" ||
         random_linkage(kinds[seed % kinds.size()], seed / kinds.size()).perturbation == 0;
}

/// Chains of twenty links and more take long. In those whose sizes spread over 24 orders of magnitude some joint may
/// move less inertia than rounding leaves of the others': they are tried, and may be refused.
Case valid_case(Random& random) {
  const std::vector<ValidKind>& kinds = valid_kinds();
  constexpr std::size_t kQuick = 6;
  const ValidKind& kind = kinds[random.below(std::min(kQuick, kinds.size()))];
  const std::uint64_t seed = random.below(1'000'000);
  Case result = compiled(CaseKind::kValid, "model.toml", to_toml(valid_mechanism(kind, seed)),
                         fmt::format("{} {}", kind.name, seed));
  result.must_pass = kind.name.find("24 orders") == std::string::npos && is_exact(kind, seed);
  return result;
}

std::string table_of_inputs(Random& random) {
  std::string text =
      random.chance(0.5) ? "time,force\n0,0\n0.1,1\n0.2,-1e3\n" : "time,thrust1,thrust2\n0,1,2\n1,2,3\n";
  for (int times = static_cast<int>(random.below(3)); times > 0; --times)
    text = mutated_bytes(text, text, random);
  return text;
}

std::string scenario(Random& random) {
  std::string text =
      random.chance(0.5) ? "[input]\nforce = \"sin(t)\"\n" : "[follow]\nhinge = \"0.1*sin(t)\"\n";
  for (int times = static_cast<int>(random.below(3)); times > 0; --times)
    text = mutated_bytes(text, text, random);
  return text;
}

Case options_case(Random& random) {
  static const std::vector<std::string> kSmall = {
      "pendulum",  "crane",         "cart_pole",    "four_bar",  "slider_crank",
      "hoop_bead", "tumbling_body", "spring_joint", "quadrotor", "shaking_cart"};
  const std::string name = one_of(kSmall, random);
  const bool urdf = random.chance(0.2);
  const auto model =
      std::find_if(models().begin(), models().end(), [&](const auto& m) { return m.name == name; });
  const std::string file = urdf ? "model.urdf" : "model.toml";
  Case result{CaseKind::kOptions, random_arguments(file, random), {}, false, urdf ? "random robot" : name};
  result.files = {{file, urdf ? random_urdf(random) : model->text},
                  {"inputs.csv", table_of_inputs(random)},
                  {"inputs.toml", scenario(random)}};
  return result;
}

}  // namespace

std::string_view kind_name(CaseKind kind) {
  switch (kind) {
    case CaseKind::kToml:
      return "toml";
    case CaseKind::kUrdf:
      return "urdf";
    case CaseKind::kMjcf:
      return "mjcf";
    case CaseKind::kBytes:
      return "bytes";
    case CaseKind::kValid:
      return "valid";
    case CaseKind::kOptions:
      return "options";
  }
  return "";
}

Case make_case(std::uint64_t seed, std::uint64_t index) {
  Random random(Random(seed).bits() ^ (index * 0xd1342543de82ef95u));
  switch (index % 20) {  // shares of the kinds; valid mechanisms take most of the time
    case 0:
      return valid_case(random);
    case 2:
    case 3:
    case 4:
      return options_case(random);
    case 5:
    case 6:
    case 7:
      return bytes_case(random);
    case 8:
    case 9:
    case 10:
    case 11:
      return urdf_case(random);
    case 12:
    case 13:
    case 14:
      return mjcf_case(random);
    default:
      return toml_case(random);
  }
}

}  // namespace jourdain::tests
