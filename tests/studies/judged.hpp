// Step limits of an emitted model: predicted, and observed by runs.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "studies/emitted.hpp"
#include "studies/stability.hpp"

namespace jourdain::tests {

using namespace studies;

inline const Progress kSilent = [](const std::string&, double) {};
inline constexpr double kAgreement = 0.05;  // of a predicted limit and the one that runs show, relative

/// Stability of a model over `count` intervals (s).
struct Judged {
  EmittedModel model;
  ConstantInputs none;
  Flow<double> flow;
  ReferenceSolution reference;
  model::Tangent tangent;
  Stability stability;

  Judged(EmittedModel emitted, long count, bool conserves_energy, double interval = 0.0625)
      : model(std::move(emitted)),
        none(std::vector<double>(static_cast<std::size_t>(model.table().input_count))),
        flow(model.table(), none),
        reference(solve_reference(flow, nullptr, ReferenceKind::kCvode, interval, count, 1, 1, kSilent)),
        tangent(model.tangent),
        stability(study_stability(flow, reference, tangent, conserves_energy, 60, kSilent)) {}

  const MethodLimit& limit(const std::string& method) const {
    return stability.limits[method_called(model.table(), method)];
  }
  void expect_observed(const std::string& method) const {
    const MethodLimit& predicted = limit(method);
    ASSERT_TRUE(predicted.observed) << method;
    EXPECT_NEAR(predicted.observed->h / predicted.h, 1, kAgreement) << method;
  }
};

}  // namespace jourdain::tests
