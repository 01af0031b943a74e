// One scene in several forms that step in the same way: minimal or absolute coordinates, numeric or emitted code.
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "reference/descriptor.hpp"
#include "reference/minimal.hpp"
#include "studies/flow.hpp"

namespace jourdain::studies {

using Bodies = std::vector<reference::AbsoluteBody<double>>;
using Descriptor = reference::DescriptorReference<double>;

/// The scene in one form, at its own state; classical Runge-Kutta steps.
class SceneForm {
 public:
  virtual ~SceneForm() = default;
  /// `count` steps of length h (s) from time t (s).
  virtual void steps(double t, double h, long count) = 0;
  virtual Bodies bodies(double t) const = 0;
  /// Largest |g| and |G x + g_t| of the constraints now.
  virtual std::pair<double, double> drift(double) const { return {0, 0}; }
  virtual bool finite() const = 0;
};

/// All that is referred to must outlive the forms.
/// By the numeric reference in minimal coordinates; `absolute` says where the bodies are.
std::unique_ptr<SceneForm> minimal_form(const reference::Reference<double>& model, const Descriptor& absolute,
                                        const Inputs& inputs, const Point<double>& start);

/// By the numeric reference in absolute coordinates; projected onto the constraints after each step, or not.
std::unique_ptr<SceneForm> descriptor_form(const Descriptor& model, const Inputs& inputs,
                                           reference::AbsoluteState<double> start, bool projecting);

/// By a method of emitted code, from the flow's start; `absolute` is of the flow's own tree.
std::unique_ptr<SceneForm> emitted_form(const Flow<double>& flow, std::size_t method,
                                        const Descriptor& absolute);

}  // namespace jourdain::studies
