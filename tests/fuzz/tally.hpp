// What came out of all cases: by kind and outcome, and each class of failures with its first case.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "fuzz/trial.hpp"

namespace jourdain::tests {

/// What a worker says of a case, as bytes in a pipe: written and read whole.
struct Record {
  std::uint64_t index = 0;
  CaseKind kind = CaseKind::kToml;
  Outcome outcome = Outcome::kDone;
  bool read = false, emitted = false, compiled = false;
  double seconds = 0;
  std::array<char, 200> why{};
};

struct FailureClass {
  std::uint64_t first = ~std::uint64_t{0}, count = 0;
};

class FuzzTally {
 public:
  void add(const Record& record);

  std::uint64_t failures() const;
  /// By outcome and message.
  const std::map<std::pair<Outcome, std::string>, FailureClass>& classes() const { return classes_; }
  /// The table, the shares, the slowest case and the classes of failures.
  std::string text() const;
  /// Shares that cases must reach so that they test anything; "" where they do, or where there are too few cases to
  /// tell.
  std::string too_few() const;

 private:
  struct Row {
    std::array<std::uint64_t, kOutcomes> counts{};
    double seconds = 0;
  };
  std::map<CaseKind, Row> rows_;
  std::map<std::pair<Outcome, std::string>, FailureClass> classes_;
  std::uint64_t cases_ = 0, read_ = 0, emitted_ = 0, compiled_ = 0, slowest_ = 0;
  double seconds_ = 0, longest_ = 0;
};

}  // namespace jourdain::tests
