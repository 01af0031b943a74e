#include "mutants/tally.hpp"

#include <fmt/format.h>

namespace jourdain::tests {

void Tally::add(const std::string& fault, Net net, const std::string& where) {
  std::vector<std::size_t>& row = counts_[fault];
  row.resize(kNets);
  ++row[static_cast<std::size_t>(net)];
  if (net == Net::kNone) escapes_.push_back("not caught: " + fault + ": " + where);
  if (net == Net::kEquivalent) escapes_.push_back("same result: " + fault + ": " + where);
}

std::size_t Tally::count() const {
  std::size_t sum = 0;
  for (const auto& [fault, row] : counts_)
    for (const std::size_t n : row) sum += n;
  return sum;
}

std::size_t Tally::count(Net net) const {
  std::size_t sum = 0;
  for (const auto& [fault, row] : counts_) sum += row[static_cast<std::size_t>(net)];
  return sum;
}

std::string Tally::text() const {
  const auto line = [](const std::string& name, const std::vector<std::string>& cells) {
    std::string row = fmt::format("{:<34}", name);
    for (const std::string& cell : cells) row += fmt::format("{:>12}", cell);
    return row + "\n";
  };
  std::string text = line(stage_, {"assertion", "reference", "validation", "readback", "same value",
                                   "same result", "rounding", "not caught"});
  for (const auto& [fault, row] : counts_) {
    std::vector<std::string> cells;
    for (const std::size_t n : row) cells.push_back(n == 0 ? "." : fmt::format("{}", n));
    text += line("  " + fault, cells);
  }
  for (const std::string& escape : escapes_) text += "  " + escape + "\n";
  return text;
}

}  // namespace jourdain::tests
