#include "emit/parts.hpp"

#include <algorithm>
#include <utility>

namespace jourdain::emit {

namespace {

/// How many values are live after each declaration.
std::vector<long> live_after(const std::vector<Declaration>& declarations,
                             const std::set<std::size_t>& results) {
  std::map<std::size_t, std::size_t> last;
  for (std::size_t k = 0; k < declarations.size(); ++k)
    for (const std::size_t value : declarations[k].reads) last[value] = k;
  for (const std::size_t value : results) last[value] = declarations.size();
  std::vector<long> change(declarations.size() + 2, 0), live;
  for (std::size_t k = 0; k < declarations.size(); ++k)
    if (const auto end = last.find(declarations[k].value); end != last.end()) {
      ++change[k];
      --change[end->second];
    }
  long count = 0;
  for (std::size_t k = 0; k < declarations.size(); ++k) live.push_back(count += change[k]);
  return live;
}

/// Parts end where few values are live.
void cut(const std::vector<Declaration>& declarations, const std::set<std::size_t>& results,
         std::size_t maximum, Parts& parts) {
  const std::vector<long> live = live_after(declarations, results);
  parts.count = 0;
  for (std::size_t begin = 0, end = 0; begin < declarations.size(); begin = end, ++parts.count) {
    end = declarations.size();
    if (end - begin > maximum)
      end = std::size_t(std::min_element(live.begin() + long(begin + maximum / 2),
                                         live.begin() + long(begin + maximum)) -
                        live.begin()) +
            1;
    for (std::size_t k = begin; k < end; ++k) parts.part_of[declarations[k].value] = parts.count;
  }
}

}  // namespace

Parts cut_into_parts(const std::vector<Declaration>& declarations,
                     const std::map<std::size_t, std::size_t>& pairs, const std::set<std::size_t>& results,
                     const Lengths& lengths) {
  Parts parts;
  if (declarations.size() <= lengths.whole) {
    for (const Declaration& each : declarations) parts.part_of[each.value] = 0;
    return parts;
  }
  cut(declarations, results, lengths.part, parts);
  for (const auto& [first, second] : pairs) parts.part_of.at(second) = parts.part_of.at(first);
  std::map<std::size_t, std::size_t> last, width;
  const auto read = [&](std::size_t value, std::size_t part) {
    if (parts.part_of.at(value) < part) last[value] = std::max(last[value], part);
  };
  for (const Declaration& each : declarations) {
    width[each.value] = each.width;
    for (const std::size_t value : each.reads) read(value, parts.part_of.at(each.value));
  }
  for (const std::size_t value : results) read(value, parts.count - 1);
  std::vector<std::vector<std::size_t>> made(parts.count), ended(parts.count);
  for (const auto& [value, part] : last) {
    made[parts.part_of.at(value)].push_back(value);
    ended[part].push_back(value);
  }
  std::map<std::size_t, std::set<std::size_t>> unused;  // entries by width
  for (std::size_t part = 0; part < parts.count; ++part) {
    for (const std::size_t value : made[part]) {
      std::set<std::size_t>& fitting = unused[width[value]];
      parts.entries[value] = fitting.empty() ? std::exchange(parts.size, parts.size + width[value])
                                             : fitting.extract(fitting.begin()).value();
    }
    for (const std::size_t value : ended[part]) unused[width[value]].insert(parts.entries.at(value));
  }
  return parts;
}

}  // namespace jourdain::emit
