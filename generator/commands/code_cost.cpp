#include "commands/code_cost.hpp"

#include <cxxabi.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <set>
#include <sstream>

#include "commands/tool.hpp"
#include "support/check.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::commands {

namespace {

/// A function of the object by its mangled name.
struct Node {
  bool defined = false;      ///< not only called
  long stack = 0, code = 0;  ///< its own, bytes
  std::set<std::string> callees;
};
using CallGraph = std::map<std::string, Node>;

/// The text behind `key` up to the closing quotation mark; empty where there is none.
std::string quoted_after(const std::string& line, const std::string& key) {
  const std::size_t begin = line.find(key + "\"");
  if (begin == std::string::npos) return "";
  const std::size_t first = begin + key.size() + 1;
  return line.substr(first, line.find('"', first) - first);
}

/// "shim.cpp:_Z4step" is the function _Z4step.
std::string symbol_of(const std::string& title) { return title.substr(title.rfind(':') + 1); }

/// The compiler's graph of calls: a node for each function, "…\n528 bytes (static)", and an edge for each call.
CallGraph read_calls(const std::string& text) {
  CallGraph graph;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("edge:"))
      graph[symbol_of(quoted_after(line, "sourcename: "))].callees.insert(
          symbol_of(quoted_after(line, "targetname: ")));
    const std::string label = quoted_after(line, "label: ");
    const std::size_t bytes = label.rfind(" bytes (");
    if (!line.starts_with("node:") || bytes == std::string::npos) continue;
    const bool bounded = label.find("dynamic", bytes) == std::string::npos ||
                         label.find("bounded", bytes) != std::string::npos;
    JD_CHECK(bounded, "a frame depends on data: {}", label);
    const std::size_t begin = label.rfind("\\n", bytes) + 2;
    Node& node = graph[symbol_of(quoted_after(line, "title: "))];
    node.defined = true;
    node.stack = std::atol(label.substr(begin, bytes - begin).c_str());
  }
  return graph;
}

/// "_ZN3arm4stepEv.cold" is a part of _ZN3arm4stepEv.
std::string whole_of(const std::string& symbol) { return symbol.substr(0, symbol.find(".cold")); }

/// Adds the sizes that `nm -S` prints: value, size, kind, name. Parts that the compiler split off count with the whole.
void read_sizes(const std::string& text, CallGraph& graph) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    std::string value, size, kind, name;
    if (!(fields >> value >> size >> kind >> name)) continue;
    const auto found = graph.find(whole_of(name));
    if (found != graph.end()) found->second.code += std::strtol(size.c_str(), nullptr, 16);
  }
}

/// The function in a section of its own, ".text.unlikely._Z4step"; empty where it is none.
std::string function_of_section(const std::string& section) {
  for (const char* prefix : {".text.unlikely.", ".text.hot.", ".text.startup.", ".text."})
    if (section.starts_with(prefix)) return whole_of(section.substr(std::string(prefix).size()));
  return "";
}

/// Functions that nm lists are in the object, called or not.
void read_defined(const std::string& text, CallGraph& graph) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    std::string value, size, kind, name;
    if (fields >> value >> size >> kind >> name && (kind == "T" || kind == "W" || kind == "t"))
      graph[whole_of(name)].defined = true;
  }
}

/// From relocations, as objdump -r lists them: a title for each section, then "000021 R_X86_64_PLT32 sin-0x4".
void read_relocations(const std::string& text, CallGraph& graph) {
  constexpr const char* kTitle = "RELOCATION RECORDS FOR [";
  std::istringstream lines(text);
  std::string caller;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(kTitle)) {
      const std::size_t begin = std::string(kTitle).size();
      caller = function_of_section(line.substr(begin, line.rfind(']') - begin));
    }
    std::istringstream fields(line);
    std::string offset, kind, target;
    if (caller.empty() || !(fields >> offset >> kind >> target)) continue;
    target = target.substr(0, target.find_last_of("+-"));
    const std::string function = function_of_section(target);
    const std::string callee = function.empty() ? whole_of(target) : function;
    if (callee != caller) graph[caller].callees.insert(callee);
  }
}

/// The emitted code has no recursion.
long deepest_stack(const CallGraph& graph, const std::string& symbol) {
  const auto node = graph.find(symbol);
  if (node == graph.end()) return 0;
  long below = 0;
  for (const std::string& callee : node->second.callees)
    below = std::max(below, deepest_stack(graph, callee));
  return node->second.stack + below;
}

void collect(const CallGraph& graph, const std::string& symbol, std::set<std::string>& reached) {
  const auto node = graph.find(symbol);
  if (node == graph.end() || !reached.insert(symbol).second) return;
  for (const std::string& callee : node->second.callees) collect(graph, callee, reached);
}

CodeCost cost_of(const CallGraph& graph, const std::string& symbol) {
  std::set<std::string> reached;
  collect(graph, symbol, reached);
  CodeCost cost{deepest_stack(graph, symbol), 0, symbol};
  for (const std::string& name : reached) cost.code += graph.at(name).code;
  return cost;
}

std::string demangled(const std::string& symbol) {
  int status = 0;
  const std::unique_ptr<char, decltype(&std::free)> text(
      abi::__cxa_demangle(symbol.c_str(), nullptr, nullptr, &status), std::free);
  return text ? text.get() : symbol;
}

/// Of the function whose name in C++ holds `signature`.
std::optional<CodeCost> find_cost(const CallGraph& graph, const std::string& signature) {
  for (const auto& [symbol, node] : graph)
    if (node.defined && demangled(symbol).find(signature) != std::string::npos) return cost_of(graph, symbol);
  return {};
}

/// Does the compiler draw graphs of calls? With -flto the linker would.
bool draws_calls(const std::string& folder, NumberType number) {
  support::write_file(folder + "/empty.cpp", "");
  std::vector<std::string> command = compiler_command(number);
  for (const std::string& argument : {std::string("-fcallgraph-info=su"), std::string("-c"),
                                      folder + "/empty.cpp", std::string("-o"), folder + "/empty.o"})
    command.push_back(argument);
  return support::run_process(command).status == 0 && std::filesystem::exists(folder + "/empty.ci");
}

CallGraph compiled_graph(const CodeTools& tools, const std::string& source, const std::string& object) {
  std::vector<std::string> command = tools.compiler;
  for (const std::string& argument :
       {std::string("-fcallgraph-info=su"), std::string("-c"), source, std::string("-o"), object + ".o"})
    command.push_back(argument);
  run_tool(command);
  CallGraph graph = read_calls(support::read_file(object + ".ci"));
  read_sizes(run_tool({tools.nm, "-S", "--defined-only", object + ".o"}), graph);
  return graph;
}

}  // namespace

std::map<std::string, std::string> function_signatures(const std::string& name, const CompiledModel& compiled,
                                                       NumberType number) {
  const std::string real = number == NumberType::kFloat ? "float" : "double";
  std::map<std::string, std::string> signatures = {
      {"model", fmt::format("{}::Model<{}>::Model(", name, real)}};
  for (const programs::FunctionInfo& function : compiled.functions)
    signatures[function.name] = fmt::format("{}::{}<{}>(", name, function.name, real);
  return signatures;
}

std::map<std::string, CodeCost> source_costs(const CodeTools& tools, const std::string& source,
                                             const std::string& object,
                                             const std::map<std::string, std::string>& signatures) {
  const CallGraph graph = compiled_graph(tools, source, object);
  std::map<std::string, CodeCost> costs;
  for (const auto& [function, signature] : signatures)
    if (const std::optional<CodeCost> cost = find_cost(graph, signature)) costs[function] = *cost;
  return costs;
}

std::optional<std::map<std::string, CodeCost>> code_costs(const std::string& name,
                                                          const CompiledModel& compiled, NumberType number) {
  const support::TemporaryFolder folder;
  if (!draws_calls(folder.path(), number)) return {};
  for (const emit::File& file : compiled.files)
    support::write_file(folder.path() + "/" + file.name, file.text);
  return source_costs({compiler_command(number)}, folder.path() + "/" + name + ".cpp",
                      folder.path() + "/object", function_signatures(name, compiled, number));
}

std::map<std::string, long> linked_code(const std::string& object,
                                        const std::map<std::string, std::string>& signatures) {
  CallGraph graph;
  const support::ProcessResult relocations = support::run_process({"objdump", "-r", "-w", object + ".o"});
  if (relocations.status != 0) return {};  // as clang writes objects for the linker to optimise
  read_relocations(relocations.output, graph);
  const std::string listing = run_tool({"nm", "-S", "--defined-only", object + ".o"});
  read_defined(listing, graph);
  read_sizes(listing, graph);
  std::map<std::string, long> bytes;
  for (const auto& [function, signature] : signatures)
    if (const std::optional<CodeCost> cost = find_cost(graph, signature); cost && cost->code > 0)
      bytes[function] = cost->code;
  return bytes;
}

}  // namespace jourdain::commands
