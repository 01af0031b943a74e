#include "validate/snapping.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/snap.hpp"
#include "reference/decompositions.hpp"
#include "reference/minimal.hpp"
#include "validate/samples.hpp"

namespace jourdain::validate {

namespace {

using Terms = reference::Terms<long double>;
using Vector = reference::VectorX<long double>;

constexpr std::size_t kStates = 8;
/// Mass matrices with a larger condition number have no accelerations.
constexpr long double kSolvable = 1e16L;

Terms terms_at(const model::Mechanism& mechanism, const Sample& sample) {
  const std::vector<long double> parameters(sample.parameters.begin(), sample.parameters.end());
  const reference::Reference<long double> reference(mechanism, parameters);
  return reference.evaluate({sample.t, to_vector(sample.y), to_vector(sample.z)}, to_vector(sample.u));
}

/// Relative to the sizes of the terms, which M's inverse carries into accelerations.
std::optional<double> change(const Terms& from, const Terms& to) {
  if (!(reference::condition<long double>(from.M) <= kSolvable)) return {};
  if (!(reference::condition<long double>(to.M) <= kSolvable)) return {};
  const Vector before = reference::forward_dynamics<long double>(from);
  const Vector after = reference::forward_dynamics<long double>(to);
  const Vector sizes = before.cwiseAbs() + reference::inverse<long double>(from.M).cwiseAbs() *
                                               Vector(from.k_scale + from.q_scale);
  const long double norm = sizes.norm();
  return norm > 0 ? static_cast<double>((after - before).norm() / norm) : 0;
}

}  // namespace

std::optional<double> snapping_effect(const model::Mechanism& mechanism) {
  if (!mechanism.loops.empty()) return {};
  const model::Mechanism as_read = model::with_directions_as_read(mechanism);
  double worst = 0;
  for (const Sample& sample : draw_samples(mechanism, kStates)) {
    const std::optional<double> effect = change(terms_at(as_read, sample), terms_at(mechanism, sample));
    if (!effect) return {};
    worst = std::max(worst, *effect);
  }
  return worst;
}

std::string snapping_sentence(const model::Mechanism& mechanism) {
  if (mechanism.snapped.empty()) return "";
  const std::optional<double> effect = snapping_effect(mechanism);
  if (!effect) return "what reading angles and axes as right does to the accelerations was not measured";
  return fmt::format(
      "reading angles and axes as right changes accelerations by {:.1e} of what they are added up from at "
      "most ({} sampled states)",
      *effect, kStates);
}

}  // namespace jourdain::validate
