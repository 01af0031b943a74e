#include "emit/sentences.hpp"

#include <fmt/format.h>

#include "emit/layout.hpp"

namespace jourdain::emit {

namespace {

/// "current (A), voltage"
std::string state_names(const programs::SceneFacts& scene, bool sampled) {
  std::string names;
  for (const model::StateVariable& state : scene.states)
    if (state.sampled || !sampled)
      names += fmt::format("{}{}{}", names.empty() ? "" : ", ", state.name,
                           state.unit.empty() ? "" : fmt::format(" ({})", comment_text(state.unit)));
  return names;
}

}  // namespace

std::vector<std::string> state_sentences(const ModelText& model) {
  std::vector<std::string> sentences = {
      fmt::format("{} coordinates y (rad, m, quaternions w x y z) and generalized velocities z (rad/s, m/s).",
                  model.facts.clock ? "Time t (s), generalized" : "Generalized")};
  if (const std::string states = state_names(model.facts, false); !states.empty())
    sentences.push_back(fmt::format("The last entries of z are the states {}.", states));
  if (const std::string sampled = state_names(model.facts, true); !sampled.empty())
    sentences.push_back(fmt::format("Steps begin with samples of {}, which are held in between.", sampled));
  if (!model.facts.carried.empty())
    sentences.push_back("Velocities of " + model.facts.carried_names() +
                        " follow from z; these positions are carried along, as position_rate says.");
  if (model.facts.dependents.empty()) return sentences;
  std::string names;
  for (const std::size_t entry : model.facts.dependents)
    names += (names.empty() ? "" : ", ") + model.facts.positions[entry];
  sentences.push_back("The independent positions and z are the state proper. The others (" + names +
                      ") follow from them: they are where close_loops starts its search and what it found.");
  return sentences;
}

std::string parameter_remark(const model::Parameter& parameter) {
  std::string remark = parameter.description;
  if (!parameter.unit.empty()) remark += (remark.empty() ? "" : ", ") + parameter.unit;
  if (const auto& range = parameter.range)
    remark += fmt::format("{}from {} to {}", remark.empty() ? "" : ", ", (*range)[0], (*range)[1]);
  return comment_text(remark);
}

std::string linearization_sentence(const programs::SceneFacts& scene) {
  std::string parts = "nz each";
  if (scene.displacements() != scene.velocities.size())
    parts = fmt::format("{} and {}", scene.displacements(), scene.velocities.size());
  if (!scene.carried.empty())
    parts += fmt::format(", the last displacements those of {}", scene.carried_names());
  if (!scene.states.empty()) parts += ", states among the velocities";
  return fmt::format(
      "With x = (displacements, velocities), {}, and o the numbers of all outputs in their order, "
      "matrices row by row: d(dx/dt) = A dx + B du{}, do = C dx + D du{}. The displacement of a coordinate "
      "is "
      "its change, that of a quaternion a small rotation in body axes, dquat = 1/2 quat (0, dtheta).",
      parts, scene.time.dynamics ? " + rate_t dt" : "", scene.time.outputs ? " + output_t dt" : "");
}

std::vector<std::string> regularity_sentences(const ModelText& model, const std::string& limits) {
  return {
      fmt::format(
          "Of what the last closing of the loops solved for: 1 {}, 0 where it is singular, negative beyond.",
          model.facts.carried.empty() ? "at its best"
                                      : "where closed forms of positions are best and "
                                        "velocities as at the start"),
      fmt::format("Below {}least_regularity, or not a number, do not trust what follows.", limits)};
}

std::string opening_sentence(const ModelText& model, const std::string& limits) {
  if (model.opening_is_proven)
    return fmt::format(
        "Square of the distance that the first iterations of the last closing moved the positions, rad or m. "
        "Up to {}greatest_opening they are proven to end on the branch (see above), where no step errs by "
        "more than the distance to other solutions. Beyond it nothing is: the step was too long.",
        limits);
  if (model.searches)
    return fmt::format(
        "Squares of the distance that the last closing moved the positions, rad or m, and of the last steps "
        "towards "
        "points that touch the ground, m. Beyond {}greatest_opening loops may be left open, or these points "
        "missed: the "
        "step was too long, or the ground is more curved than what rolls on it.",
        limits);
  return fmt::format(
      "Square of the distance that the last closing moved the positions, rad or m. Beyond {}greatest_opening "
      "loops may be left open: the step was too long.",
      limits);
}

std::string beyond_sentence(const ModelText& model) {
  std::string ranges;
  for (const loops::ProvenRange& range : model.proven.positions)
    ranges += fmt::format("{}{} from {} to {}", ranges.empty() ? "" : ", ",
                          model.facts.positions[range.index], range.low, range.high);
  return fmt::format(
      "(y - low) (y - high) after the last closing: positive where a position is outside the range for which "
      "how loops are closed is proven. {}.",
      comment_text(ranges));
}

std::string closed_sentence() {
  return "Did the last closing of the loops go well, by all that State says of it? No where something is not "
         "finite.";
}

std::string proven_sentence() {
  return "Does what is proven of the loops (see above) hold at these parameters? Those that the constraints "
         "depend on must be in their declared ranges; without one a parameter must have its default value. "
         "Elsewhere nothing is known.";
}

std::string operations_sentence(const ir::Operations& count) {
  return fmt::format("{} operations ({} mul, {} add and sub, {} div), {} sin and cos{}{}{}.",
                     count.arithmetic(), count.multiply, count.add + count.subtract, count.divide,
                     count.sin + count.cos, count.atan2 == 0 ? "" : fmt::format(", {} atan2", count.atan2),
                     count.functions == 0 ? "" : fmt::format(", {} other functions", count.functions),
                     count.selections == 0 ? "" : fmt::format(", {} selections", count.selections));
}

}  // namespace jourdain::emit
