#include "loops/plan/plan_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "model/coordinates.hpp"

namespace jourdain::loops {

namespace {

std::vector<std::string> velocity_names(const std::vector<std::size_t>& velocities,
                                        const model::CoordinateLayout& layout) {
  std::vector<std::string> names;
  for (const std::size_t k : velocities) names.push_back(layout.velocity_names[k]);
  return names;
}

/// Who is independent, as the beginning of a sentence.
std::string independent_text(const LoopPlan& plan, const model::CoordinateLayout& layout) {
  if (plan.independent.empty()) return "all coordinates follow from time, ";
  return fmt::format("independent: {}; the others ",
                     fmt::join(velocity_names(plan.independent, layout), ", "));
}

std::string at_defaults(const std::vector<std::string>& parameters) {
  return parameters.empty() ? "" : fmt::format(", at the default value of {}", fmt::join(parameters, ", "));
}

std::string regularity_text(const LoopPlan& plan) {
  if (!plan.proof)
    return fmt::format(
        "NOT PROVEN to stay regular: what is solved for them has a smallest singular value of {:.2g} of the "
        "constraints' largest at the configurations seen",
        plan.conditioning);
  const RegularityProof& proof = *plan.proof;
  return fmt::format(
      "Proven{}{}{}: the branch of the initial state exists, no other one meets it, and determinants of what "
      "is "
      "solved for are {:.2g} or more of their rows' sizes. Dependent coordinates that are off by {:.1g} "
      "(rad; "
      "slides over {:.2g} m) end within {:.1g} of the branch, no other solution is within {:.1g} of it",
      proof.region.empty() ? "" : " for ", proof.region, at_defaults(proof.at_defaults), proof.margin,
      proof.radius, proof.length, proof.ends_within, proof.isolation);
}

/// With what is carried along.
std::string explicit_text(const LoopPlan& plan, const model::CoordinateLayout& layout) {
  const ClosedForm& form = *plan.closed_form;
  const std::string at = at_defaults(form.at_defaults);
  const std::vector<std::size_t> carried = plan.carried();
  const bool closes = plan.z.size() - plan.independent.size() > carried.size();
  std::string text;
  if (closes)
    text = fmt::format(
        "in closed form, on the branch of the initial state. Proven: it exists everywhere in the declared "
        "ranges{}; every discriminant is {:.2g} or more (the square of the sine of the angle from a dead "
        "position)",
        at, form.smallest_margin);
  if (carried.empty()) return text;
  const std::string names = fmt::format("{}", fmt::join(velocity_names(carried, layout), ", "));
  return text +
         (closes ? fmt::format("; velocities of {} follow, ", names)
                 : fmt::format("({}) in their velocities, ", names)) +
         fmt::format(
             "their positions are carried along. Proven: what is solved for these velocities is regular "
             "everywhere "
             "in the declared ranges{}, its determinant {:.2g} or more of that at the start",
             at, form.least_determinant);
}

std::vector<std::string> names_of(const model::Mechanism& mechanism, const std::vector<std::size_t>& rows) {
  const std::vector<std::string> all = row_names(mechanism);
  std::vector<std::string> names;
  for (const std::size_t r : rows) names.push_back(all[r]);
  return names;
}

}  // namespace

std::vector<std::string> sentences(const model::Mechanism& mechanism, const LoopPlan& plan) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  std::vector<std::string> list;
  list.push_back(
      fmt::format("{} degree{} of freedom: {} coordinates of the tree, {} of {} constraints are independent",
                  plan.freedom, plan.freedom == 1 ? "" : "s", layout.velocity_count(), plan.rows.size(),
                  plan.row_length.size()));
  if (!plan.redundant.empty())
    list.push_back(
        fmt::format("redundant constraints: {}{}", fmt::join(plan.redundant, ", "),
                    plan.disagreeing.empty()
                        ? ""
                        : fmt::format("; they disagree with the others by {:.1g} and stay open by that",
                                      plan.disagreement)));
  const std::string independent = independent_text(plan, layout);
  switch (plan.treatment) {
    case model::LoopTreatment::kExplicit:
      list.push_back(independent + explicit_text(plan, layout));
      break;
    case model::LoopTreatment::kPartitioned:
      list.push_back(fmt::format("{}by {} Newton iteration{} at the end of a step. {}", independent,
                                 plan.iterations, plan.iterations == 1 ? "" : "s", regularity_text(plan)));
      break;
    case model::LoopTreatment::kMultipliers:
      list.push_back(fmt::format(
          "multipliers{}; one projection of positions and velocities at the end of a step",
          plan.stabilisation == 0 ? "" : fmt::format(", stabilised with {:g}/s", plan.stabilisation)));
      list.push_back(
          fmt::format("G M^-1 G^T is regularised by d = {:.2g}/kg: near singular configurations multipliers "
                      "and accelerations lose a share (d/(s + d))^{}, s its smallest singular value",
                      plan.regularisation, plan.corrections + 1));
      list.push_back(
          "a step from one side of a singular configuration of the mechanism to the other goes straight on; "
          "nothing but State's opening may show it");
      break;
  }
  if (!plan.sharing.empty())
    list.push_back(fmt::format("{} are redundant in turn: they share one multiplier",
                               fmt::join(names_of(mechanism, plan.sharing), ", ")));
  if (!plan.reason.empty()) list.push_back(fmt::format("why so: {}", plan.reason));
  return list;
}

std::string closing_text(const LoopPlan& plan) {
  switch (plan.treatment) {
    case model::LoopTreatment::kExplicit:
      return "dependent coordinates in closed form";
    case model::LoopTreatment::kPartitioned:
      return fmt::format("{} Newton iteration{}", plan.iterations, plan.iterations == 1 ? "" : "s");
    case model::LoopTreatment::kMultipliers:
      return "one projection of positions and velocities";
  }
  return "";
}

std::string assembly_text(const std::vector<Moved>& moved, const std::string& where) {
  std::string text;
  for (const Moved& each : moved)
    text += fmt::format("note: {}the loops close with {}{} = {:.10g} instead of {:.10g}\n", where,
                        each.coordinate, each.velocity ? "'s velocity" : "", each.to, each.from);
  return text;
}

}  // namespace jourdain::loops
