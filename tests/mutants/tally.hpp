// What became of planted faults: a table of operators and of the nets that caught them.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace jourdain::tests {

enum class Net {
  kAssertion,      ///< one of ours, or an exception, before anything is compared
  kReference,      ///< the symbolic equations against the numeric reference
  kValidation,     ///< programs against the symbolic equations
  kReadback,       ///< the text against the programs
  kSame,           ///< no fault: what was changed has the value that it had before
  kEquivalent,     ///< no fault: the same outputs at random states to forty digits
  kBelowRounding,  ///< another value in the end, by less than half a unit of a double's last place everywhere
  kNone            ///< it would be written
};
inline constexpr std::size_t kNets = 8;

class Tally {
 public:
  explicit Tally(std::string stage) : stage_(std::move(stage)) {}

  /// `where` names the fault for a person.
  void add(const std::string& fault, Net net, const std::string& where);

  std::size_t count() const;
  std::size_t count(Net net) const;
  /// One line per operator with the counts by net, then those that no net caught.
  std::string text() const;

 private:
  std::string stage_;
  std::map<std::string, std::vector<std::size_t>> counts_;
  std::vector<std::string> escapes_;
};

}  // namespace jourdain::tests
