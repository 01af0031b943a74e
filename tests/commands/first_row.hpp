// The first row of a table that `jourdain simulate` wrote.
#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

namespace jourdain::tests {

/// Numbers of the first row below the header.
inline std::vector<double> first_row(const std::string& csv) {
  std::istringstream text(csv.substr(csv.find('\n') + 1));
  std::vector<double> numbers;
  std::string field;
  std::string line;
  std::getline(text, line);
  std::istringstream fields(line);
  while (std::getline(fields, field, ',')) numbers.push_back(std::stod(field));
  return numbers;
}

/// The number in the first row below this name.
inline double at_start(const std::string& csv, const std::string& name) {
  std::istringstream header(csv.substr(0, csv.find('\n')));
  std::string field;
  for (const double number : first_row(csv))
    if (std::getline(header, field, ',') && field == name) return number;
  ADD_FAILURE() << "no " << name << " in " << csv.substr(0, csv.find('\n'));
  return 0;
}

}  // namespace jourdain::tests
