#include "commands/kinematic_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <variant>

#include "model/kinematic_kinds.hpp"
#include "model/names.hpp"
#include "model/read/frames.hpp"
#include "programs/functions.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::commands {

using model::KinematicQuantity;
using support::shown;

namespace {

constexpr const char* kAll = "pose,velocity,acceleration,jacobian,jacobian_bias";

std::vector<std::string> parts(const std::string& text, char separator) {
  std::vector<std::string> list;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    list.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return list;
}

/// FRAME:QUANTITIES:AXES; a name of SDF holds pairs of colons.
std::vector<std::string> frame_parts(std::string text) {
  constexpr char kPair = '\0';
  for (std::size_t at = 0; (at = text.find("::", at)) != std::string::npos;) text.replace(at, 2, 1, kPair);
  std::vector<std::string> words = parts(text, ':');
  for (std::string& word : words)
    for (std::size_t at = 0; (at = word.find(kPair, at)) != std::string::npos;) word.replace(at, 1, "::");
  return words;
}

std::string suggestion(const std::string& word, const std::vector<std::string>& known) {
  const std::string near = support::nearest(word, known);
  return near.empty() ? fmt::format("there are {}", fmt::join(known, ", "))
                      : fmt::format("did you mean '{}'?", near);
}

/// Adds the functions of one --frame.
std::string add_frame(const std::string& text, model::Mechanism& mechanism) {
  const std::string option = fmt::format("--frame {}: ", shown(text));
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) return option + "write NAME=FRAME, as in tool=hand";
  const std::string prefix = text.substr(0, equals);
  if (!model::is_identifier(prefix)) return fmt::format("{}'{}' is not an identifier", option, shown(prefix));
  const std::vector<std::string> words = frame_parts(text.substr(equals + 1));
  if (words.size() > 3) return option + "more than FRAME:QUANTITIES:AXES";
  const std::optional<model::FrameIndex> frame = model::frame_named(mechanism, words[0]);
  if (!frame) {
    std::vector<std::string> known;
    for (const model::Frame& other : mechanism.frames) known.push_back(other.name);
    for (const model::Body& body : mechanism.bodies) known.push_back(body.name);
    return fmt::format("{}no frame or body '{}'; {}", option, shown(words[0]), suggestion(words[0], known));
  }
  model::Axes axes = model::Axes::kWorldAligned;
  if (words.size() > 2) {
    const std::vector<std::string>& names = model::axes_names();
    const auto found = std::find(names.begin(), names.end(), words[2]);
    if (found == names.end())
      return fmt::format("{}no axes '{}'; {}", option, shown(words[2]), suggestion(words[2], names));
    axes = static_cast<model::Axes>(found - names.begin());
  }
  for (const std::string& quantities : parts(words.size() > 1 ? words[1] : kAll, ',')) {
    const auto parsed = model::parse_quantities(quantities, true);
    if (const auto* wrong = std::get_if<model::KinematicError>(&parsed))
      return fmt::format("{}{}{}{}", option, wrong->message, wrong->hint.empty() ? "" : "; ", wrong->hint);
    const std::string wrong = model::add_kinematic_function(mechanism, prefix, frame, axes,
                                                            std::get<std::vector<KinematicQuantity>>(parsed));
    if (!wrong.empty()) return option + wrong;
  }
  return "";
}

}  // namespace

std::string choose_kinematics(const std::vector<std::string>& frames, std::vector<std::string>& functions,
                              model::Mechanism& mechanism) {
  const std::vector<std::string> table = programs::function_names();
  if (!functions.empty())
    std::erase_if(mechanism.kinematics, [&](const model::KinematicFunction& function) {
      return std::find(functions.begin(), functions.end(), function.name) == functions.end();
    });
  std::vector<std::string> kept;
  for (const std::string& name : functions) {
    if (std::find(table.begin(), table.end(), name) != table.end()) {
      kept.push_back(name);
      continue;
    }
    if (model::kinematic_function_named(mechanism, name)) continue;
    const auto quantity = model::quantity_named(name);
    if (!quantity || model::quantity_row(*quantity).of_frame) {
      std::vector<std::string> known = table;
      for (const std::string& other : model::quantity_names())
        if (!model::quantity_row(*model::quantity_named(other)).of_frame) known.push_back(other);
      for (const model::KinematicFunction& other : mechanism.kinematics) known.push_back(other.name);
      return fmt::format("--functions: no function '{}'; {}", shown(name), suggestion(name, known));
    }
    const std::string wrong =
        model::add_kinematic_function(mechanism, "", {}, model::Axes::kWorldAligned, {*quantity});
    if (!wrong.empty()) return "--functions: " + wrong;
  }
  functions = kept;
  for (const std::string& text : frames)
    if (std::string wrong = add_frame(text, mechanism); !wrong.empty()) return wrong;
  return "";
}

}  // namespace jourdain::commands
