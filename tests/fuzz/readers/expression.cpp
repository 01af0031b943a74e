#include "model/expression.hpp"
#include "fuzz/readers/said.hpp"

/// Over two parameters, one with a unit, and the time; what is taken has a value, or none that is finite.
extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {  // NOLINT: its name
  using namespace jourdain::model;
  const std::string text(data, data + size);
  const auto parsed =
      parse_expression(text, {{"a", Measure::parameter("m")}, {"b", {}}}, {{"t", {}, Measure()}});
  if (const auto* error = std::get_if<ExpressionError>(&parsed)) {
    jourdain::tests::require(error->offset <= size && !error->message.empty());
    return 0;
  }
  const double parameters[] = {0.5, -2};
  std::get<MeasuredExpression>(parsed).expression.evaluate<double>(
      parameters, [](double v) { return v; }, [](const Variable&) { return 0.25; });
  return 0;
}
