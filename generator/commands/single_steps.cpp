#include "commands/single_steps.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <unordered_map>

#include "support/check.hpp"

namespace jourdain::commands {

namespace {

/// An instruction of the program.
struct Place {
  bool own = false;  ///< of the measuring program
  std::optional<ArithmeticInstruction> arithmetic;
  bool x87 = false;
};
using Places = std::unordered_map<std::size_t, Place>;

/// Lines of objdump -d: "0000000000401139 <step(double)>:", and "  401139:\tmulsd  %xmm0,%xmm1".
Places read_places(const std::string& disassembly, const std::string& own) {
  Places places;
  bool is_own = false;
  std::istringstream lines(disassembly);
  for (std::string line; std::getline(lines, line);) {
    if (line.ends_with(">:")) is_own = line.find(own) != std::string::npos;
    const std::size_t colon = line.find(":\t");
    if (!line.starts_with(' ') || colon == std::string::npos) continue;
    std::istringstream fields(line.substr(colon + 2));
    std::string mnemonic, operands;
    fields >> mnemonic;
    std::getline(fields, operands);
    places[std::strtoull(line.c_str(), nullptr, 16)] = {is_own, read_instruction(mnemonic, operands),
                                                        is_x87_arithmetic(mnemonic)};
  }
  return places;
}

}  // namespace

std::map<std::string, SteppedCalls> read_steps(const std::string& output, const std::string& disassembly,
                                               const std::string& own) {
  const Places places = read_places(disassembly, own);
  std::map<std::string, SteppedCalls> functions;
  std::map<std::string, double> own_instructions;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    std::string kind, name;
    fields >> kind >> name;
    double number = 0;
    if (kind == "steps") {
      while (fields >> number) functions[name].instructions.push_back(number);
    } else if (kind == "outside") {
      fields >> functions[name].outside;
    } else if (kind == "at") {
      std::size_t address = 0;
      JD_CHECK(bool(fields >> std::hex >> address >> std::dec >> number), "unexpected line '{}'", line);
      const auto place = places.find(address);
      JD_CHECK(place != places.end(), "no instruction at {:x}", address);
      if (place->second.own)
        own_instructions[name] += number;
      else if (place->second.arithmetic)
        functions[name].arithmetic[*place->second.arithmetic] += number;
      else if (place->second.x87)
        functions[name].x87 = true;
    }
  }
  std::erase_if(functions, [](const auto& item) {
    const std::vector<double>& counts = item.second.instructions;
    return std::all_of(counts.begin(), counts.end(), [](double count) { return count <= 0; });
  });
  for (auto& [name, stepped] : functions) {
    const auto calls = static_cast<double>(stepped.instructions.size());
    for (double& count : stepped.instructions) count -= own_instructions[name] / calls;
    for (auto& [instruction, count] : stepped.arithmetic) count /= calls;
    stepped.outside /= calls;
  }
  return functions;
}

}  // namespace jourdain::commands
