#include "studies/error_sources.hpp"

#include <cmath>

namespace jourdain::studies {

namespace {

using Eigen::VectorXd;

ErrorNorms norms(const VectorXd& error, std::size_t positions) {
  const auto ny = static_cast<Eigen::Index>(positions);
  return {error.head(ny).lpNorm<Eigen::Infinity>(), error.tail(error.size() - ny).lpNorm<Eigen::Infinity>()};
}

VectorXd difference(const std::vector<LongReal>& a, const std::vector<LongReal>& b) {
  VectorXd result(static_cast<Eigen::Index>(a.size()));
  for (std::size_t i = 0; i < a.size(); ++i) result[Eigen::Index(i)] = double(a[i] - b[i]);
  return result;
}

VectorXd difference(const std::vector<double>& a, const std::vector<LongReal>& b) {
  return difference(std::vector<LongReal>(a.begin(), a.end()), b);
}

/// Points before `k`, `stride` apart, newest first, as many as the method remembers.
std::vector<Point<LongReal>> earlier_points(const ReferenceSolution& reference, std::size_t k,
                                            std::size_t stride, int count) {
  std::vector<Point<LongReal>> points;
  for (int i = 1; i <= count; ++i)
    points.push_back(reference.exact[k - static_cast<std::size_t>(i) * stride]);
  return points;
}

template <class Real>
std::vector<Real> end_of(const Flow<Real>& flow, const jourdain_method& method, double h, long count) {
  Point<Real> point = flow.start();
  Memory memory = flow.fresh_memory(method);
  flow.step(method, point, h, count, memory);
  return point.x;
}

}  // namespace

ErrorSources error_sources(const Flow<double>& flow, const Flow<LongReal>& long_flow, std::size_t index,
                           const ReferenceSolution& reference,
                           const std::vector<Eigen::MatrixXd>& transitions, std::size_t stride) {
  const jourdain_method& method = long_flow.table().methods[index];
  ErrorSources result;
  result.method = index;
  result.h = reference.interval * static_cast<double>(stride);
  VectorXd E = VectorXd::Zero(static_cast<Eigen::Index>(flow.size()));
  const std::size_t steps = (reference.exact.size() - 1) / stride;
  Memory start_memory = long_flow.fresh_memory(method);
  for (std::size_t step = 0; step < steps; ++step) {
    const std::size_t k = step * stride;
    // What an implicit method remembers comes from its step on the exact solution before.
    const bool starting = method.implicit || step < static_cast<std::size_t>(method.history);
    Memory memory = starting
                        ? start_memory
                        : long_flow.memory_of(method, earlier_points(reference, k, stride, method.history));
    Point<LongReal> point = reference.exact[k];
    long_flow.step(method, point, result.h, 1, memory);
    if (starting) start_memory = memory;
    const VectorXd d = difference(point.x, reference.exact[k + stride].x);
    for (std::size_t i = k; i < k + stride; ++i) E = transitions[i] * E;
    E += d;
    const ErrorNorms local = norms(d, flow.position_count());
    result.truncation.position += local.position;
    result.truncation.velocity += local.velocity;
  }
  result.propagated = norms(E, flow.position_count());
  const auto count = static_cast<long>(steps);
  const std::vector<double> working = end_of(flow, flow.table().methods[index], result.h, count);
  const VectorXd rounding = difference(working, end_of(long_flow, method, result.h, count));
  const VectorXd measured = difference(working, reference.exact[steps * stride].x);
  result.rounding = norms(rounding, flow.position_count());
  result.predicted = norms(E + rounding, flow.position_count());
  result.measured = norms(measured, flow.position_count());
  result.difference = norms(E + rounding - measured, flow.position_count());
  return result;
}

ErrorNorms rounding_error(const Flow<double>& flow, const Flow<LongReal>& long_flow, std::size_t index,
                          double h, long count) {
  const std::vector<double> working = end_of(flow, flow.table().methods[index], h, count);
  return norms(difference(working, end_of(long_flow, long_flow.table().methods[index], h, count)),
               flow.position_count());
}

}  // namespace jourdain::studies
