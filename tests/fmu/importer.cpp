#include "fmu/importer.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <sstream>

#include "package/project.hpp"
#include "support/process.hpp"

namespace jourdain::tests {

namespace {

using Element = tinyxml2::XMLElement;

std::string text(const char* attribute) { return attribute ? attribute : ""; }

std::vector<std::string> words(const std::string& line) {
  std::istringstream stream(line);
  return {std::istream_iterator<std::string>(stream), {}};
}

void run(std::vector<std::string> command) {
  const support::ProcessResult result = support::run_process(command);
  ASSERT_EQ(result.status, 0) << result.output;
}

}  // namespace

std::string make_fmu(const std::string& model, int version, const std::string& more) {
  static const support::TemporaryFolder folder;
  static std::map<std::string, std::string> made;
  std::string& file = made[fmt::format("{} {} {}", model, version, more)];
  if (!file.empty()) return file;
  file = fmt::format("{}/{}.fmu", folder.path(), made.size());
  std::vector<std::string> command = {command_folder() + "/jourdain",
                                      "fmu",
                                      fmt::format("{}/models/{}.toml", JOURDAIN_SOURCE_DIR, model),
                                      "-o",
                                      file,
                                      "--fmi",
                                      fmt::format("{}", version)};
  for (const std::string& word : words(more)) command.push_back(word);
  run(command);
  return file;
}

Fmu::Fmu(const std::string& file, bool load) {
  run({"python3", "-m", "zipfile", "-e", file, folder()});
  EXPECT_EQ(document_.LoadFile((folder() + "/modelDescription.xml").c_str()), tinyxml2::XML_SUCCESS);
  is_2_ = text(root().Attribute("fmiVersion")) == "2.0";
  token_ = text(root().Attribute(is_2_ ? "guid" : "instantiationToken"));
  for (const Element* one = root().FirstChildElement("ModelVariables")->FirstChildElement(); one;
       one = one->NextSiblingElement()) {
    Attributes attributes;
    for (const Element* part = one; part; part = part->FirstChildElement())
      for (const auto* attribute = part->FirstAttribute(); attribute; attribute = attribute->Next())
        attributes[attribute->Name()] = attribute->Value();
    EXPECT_EQ(one->UnsignedAttribute("valueReference"), names_.size());
    names_.push_back(attributes["name"]);
    EXPECT_TRUE(variables_.emplace(attributes["name"], attributes).second) << attributes["name"];
  }
  if (!load) return;
  const std::string name = root().FirstChildElement("ModelExchange")->Attribute("modelIdentifier");
  const std::string platform = std::filesystem::directory_iterator(folder() + "/binaries")->path().string();
  const std::string path = fmt::format("{}/{}.so", platform, name);
  library_ = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  EXPECT_TRUE(library_) << dlerror();
}

Fmu::~Fmu() {
  if (library_) dlclose(library_);
}

void* Fmu::symbol(const char* name) const {
  void* found = dlsym(library_, name);
  EXPECT_TRUE(found) << name;
  return found;
}

const Attributes& Fmu::variable(const std::string& name) const {
  static const Attributes none;
  const auto found = variables_.find(name);
  EXPECT_NE(found, variables_.end()) << name;
  return found == variables_.end() ? none : found->second;
}

unsigned Fmu::reference(const std::string& name) const {
  return static_cast<unsigned>(std::find(names_.begin(), names_.end(), name) - names_.begin());
}

std::string Fmu::name_of(unsigned reference) const { return names_.at(reference); }

std::vector<const Element*> Fmu::unknowns(const std::string& group) const {
  const Element* place = root().FirstChildElement("ModelStructure");
  if (is_2_) place = place->FirstChildElement(group.c_str());
  const std::map<std::string, std::string> of_3 = {{"Outputs", "Output"},
                                                   {"Derivatives", "ContinuousStateDerivative"},
                                                   {"InitialUnknowns", "InitialUnknown"}};
  const std::string kind = is_2_ ? "Unknown" : of_3.at(group);
  std::vector<const Element*> list;
  for (const Element* one = place ? place->FirstChildElement(kind.c_str()) : nullptr; one;
       one = one->NextSiblingElement(kind.c_str()))
    list.push_back(one);
  return list;
}

References Fmu::structure(const std::string& group) const {
  References references;
  for (const Element* one : unknowns(group))
    references.push_back(as_reference(one->UnsignedAttribute(is_2_ ? "index" : "valueReference")));
  return references;
}

References Fmu::dependencies(const std::string& group, unsigned reference) const {
  References known;
  for (const Element* one : unknowns(group)) {
    if (as_reference(one->UnsignedAttribute(is_2_ ? "index" : "valueReference")) != reference) continue;
    EXPECT_TRUE(one->Attribute("dependencies")) << name_of(reference);
    for (const std::string& word : words(text(one->Attribute("dependencies"))))
      known.push_back(as_reference(static_cast<unsigned>(std::stoul(word))));
  }
  return known;
}

References Fmu::states() const {
  References list;
  for (const unsigned rate : structure("Derivatives"))
    list.push_back(as_reference(static_cast<unsigned>(std::stoul(variable(name_of(rate)).at("derivative")))));
  return list;
}

namespace {

void log_2(fmi2ComponentEnvironment environment, fmi2String, fmi2Status, fmi2String, fmi2String message,
           ...) {
  char line[500];
  va_list rest;
  va_start(rest, message);
  std::vsnprintf(line, sizeof line, message, rest);
  va_end(rest);
  static_cast<std::vector<std::string>*>(environment)->push_back(line);
}

void log_3(fmi3InstanceEnvironment environment, fmi3Status, fmi3String, fmi3String message) {
  static_cast<std::vector<std::string>*>(environment)->push_back(message);
}

}  // namespace

// A call of the version that the FMU is of.
#define CALL(version, name) fmu_.function<decltype(fmi##version##name)>("fmi" #version #name)

Instance::Instance(const Fmu& fmu, bool is_exchange, const std::string& name)
    : Instance(fmu, is_exchange, name, fmu.token()) {}

Instance::Instance(const Fmu& fmu, bool is_exchange, const std::string& name, const std::string& token)
    : fmu_(fmu),
      is_exchange_(is_exchange),
      callbacks_(new fmi2CallbackFunctions{log_2, nullptr, nullptr, nullptr, &log_}) {
  if (fmu.is_2())
    handle_ = CALL(2, Instantiate)(name.c_str(), is_exchange ? fmi2ModelExchange : fmi2CoSimulation,
                                   token.c_str(), "", callbacks_.get(), fmi2False, fmi2True);
  else if (is_exchange)
    handle_ = CALL(3, InstantiateModelExchange)(name.c_str(), token.c_str(), "", false, true, &log_, log_3);
  else
    handle_ = CALL(3, InstantiateCoSimulation)(name.c_str(), token.c_str(), "", false, true, false, false,
                                               nullptr, 0, &log_, log_3, nullptr);
}

Instance::~Instance() { fmu_.is_2() ? CALL(2, FreeInstance)(handle_) : CALL(3, FreeInstance)(handle_); }

int Instance::enter_initialization(double start, bool has_stop, double stop) {
  if (!fmu_.is_2()) return CALL(3, EnterInitializationMode)(handle_, false, 0, start, has_stop, stop);
  const int status = CALL(2, SetupExperiment)(handle_, fmi2False, 0, start, has_stop, stop);
  return status == kOk ? CALL(2, EnterInitializationMode)(handle_) : status;
}

int Instance::exit_initialization() {
  return fmu_.is_2() ? int(CALL(2, ExitInitializationMode)(handle_))
                     : int(CALL(3, ExitInitializationMode)(handle_));
}

void Instance::start(double time) {
  ASSERT_TRUE(handle_);
  ASSERT_EQ(enter_initialization(time), kOk);
  ASSERT_EQ(exit_initialization(), kOk) << (log_.empty() ? "" : log_.back());
  if (!is_exchange_) return;
  bool change = true;
  ASSERT_EQ(update(change), kOk);
  ASSERT_FALSE(change);
  ASSERT_EQ(enter_continuous(), kOk);
}

int Instance::terminate() {
  return fmu_.is_2() ? int(CALL(2, Terminate)(handle_)) : int(CALL(3, Terminate)(handle_));
}

int Instance::reset() { return fmu_.is_2() ? int(CALL(2, Reset)(handle_)) : int(CALL(3, Reset)(handle_)); }

int Instance::get(const References& list, Numbers& values) {
  values.assign(list.size(), 0);
  if (fmu_.is_2()) return CALL(2, GetReal)(handle_, list.data(), list.size(), values.data());
  return CALL(3, GetFloat64)(handle_, list.data(), list.size(), values.data(), values.size());
}

int Instance::set(const References& list, const Numbers& values) {
  if (fmu_.is_2()) return CALL(2, SetReal)(handle_, list.data(), list.size(), values.data());
  return CALL(3, SetFloat64)(handle_, list.data(), list.size(), values.data(), values.size());
}

Numbers Instance::values(const References& references) {
  Numbers values;
  EXPECT_EQ(get(references, values), kOk) << (log_.empty() ? "" : log_.back());
  return values;
}

double Instance::value(const std::string& name) { return values({fmu_.reference(name)}).front(); }

int Instance::set(const std::string& name, double value) {
  return set(References{fmu_.reference(name)}, Numbers{value});
}

int Instance::step(double point, double length) {
  if (fmu_.is_2()) return CALL(2, DoStep)(handle_, point, length, fmi2True);
  bool event = true, end = true, early = true;
  double last = 0;
  const int status = CALL(3, DoStep)(handle_, point, length, true, &event, &end, &early, &last);
  EXPECT_FALSE(status == kOk && (event || end || early || last != point + length));
  return status;
}

int Instance::enter_event() {
  return fmu_.is_2() ? int(CALL(2, EnterEventMode)(handle_)) : int(CALL(3, EnterEventMode)(handle_));
}

int Instance::update(bool& states_change) {
  if (fmu_.is_2()) {
    fmi2EventInfo info{1, 1, 1, 1, 1, 0};
    const int status = CALL(2, NewDiscreteStates)(handle_, &info);
    states_change = info.valuesOfContinuousStatesChanged != 0;
    EXPECT_FALSE(status == kOk && (info.newDiscreteStatesNeeded || info.nextEventTimeDefined));
    return status;
  }
  bool again = true, end = true, nominals = true, has_next = true;
  double next = 0;
  const int status =
      CALL(3, UpdateDiscreteStates)(handle_, &again, &end, &nominals, &states_change, &has_next, &next);
  EXPECT_FALSE(status == kOk && (again || end || nominals || has_next));
  return status;
}

int Instance::enter_continuous() {
  return fmu_.is_2() ? int(CALL(2, EnterContinuousTimeMode)(handle_))
                     : int(CALL(3, EnterContinuousTimeMode)(handle_));
}

int Instance::completed_step(bool& needs_event) {
  if (fmu_.is_2()) {
    int event = 1, end = 1;
    const int status = CALL(2, CompletedIntegratorStep)(handle_, fmi2True, &event, &end);
    needs_event = event != 0;
    return status;
  }
  bool end = true;
  return CALL(3, CompletedIntegratorStep)(handle_, true, &needs_event, &end);
}

int Instance::set_time(double time) {
  return fmu_.is_2() ? int(CALL(2, SetTime)(handle_, time)) : int(CALL(3, SetTime)(handle_, time));
}

int Instance::set_states(const Numbers& x) {
  return fmu_.is_2() ? int(CALL(2, SetContinuousStates)(handle_, x.data(), x.size()))
                     : int(CALL(3, SetContinuousStates)(handle_, x.data(), x.size()));
}

int Instance::get_states(Numbers& x) {
  x.assign(fmu_.states().size(), 0);
  return fmu_.is_2() ? int(CALL(2, GetContinuousStates)(handle_, x.data(), x.size()))
                     : int(CALL(3, GetContinuousStates)(handle_, x.data(), x.size()));
}

int Instance::get_rates(Numbers& rates) {
  return fmu_.is_2() ? int(CALL(2, GetDerivatives)(handle_, rates.data(), rates.size()))
                     : int(CALL(3, GetContinuousStateDerivatives)(handle_, rates.data(), rates.size()));
}

int Instance::save(void*& state) {
  return fmu_.is_2() ? int(CALL(2, GetFMUstate)(handle_, &state))
                     : int(CALL(3, GetFMUState)(handle_, &state));
}

int Instance::restore(void* state) {
  return fmu_.is_2() ? int(CALL(2, SetFMUstate)(handle_, state)) : int(CALL(3, SetFMUState)(handle_, state));
}

int Instance::free_state(void*& state) {
  return fmu_.is_2() ? int(CALL(2, FreeFMUstate)(handle_, &state))
                     : int(CALL(3, FreeFMUState)(handle_, &state));
}

int Instance::serialize(void* state, std::vector<char>& bytes) {
  std::size_t size = 0;
  if (fmu_.is_2()) {
    EXPECT_EQ(CALL(2, SerializedFMUstateSize)(handle_, state, &size), fmi2OK);
    bytes.resize(size);
    return CALL(2, SerializeFMUstate)(handle_, state, bytes.data(), size);
  }
  EXPECT_EQ(CALL(3, SerializedFMUStateSize)(handle_, state, &size), fmi3OK);
  bytes.resize(size);
  return CALL(3, SerializeFMUState)(handle_, state, reinterpret_cast<fmi3Byte*>(bytes.data()), size);
}

int Instance::deserialize(const std::vector<char>& bytes, void*& state) {
  if (fmu_.is_2()) return CALL(2, DeSerializeFMUstate)(handle_, bytes.data(), bytes.size(), &state);
  return CALL(3, DeserializeFMUState)(handle_, reinterpret_cast<const fmi3Byte*>(bytes.data()), bytes.size(),
                                      &state);
}

int Instance::directional(const Directions& d, Numbers& result) {
  result.assign(d.unknowns.size(), 0);
  if (fmu_.is_2())
    return CALL(2, GetDirectionalDerivative)(handle_, d.unknowns.data(), d.unknowns.size(), d.knowns.data(),
                                             d.knowns.size(), d.seed.data(), result.data());
  return CALL(3, GetDirectionalDerivative)(handle_, d.unknowns.data(), d.unknowns.size(), d.knowns.data(),
                                           d.knowns.size(), d.seed.data(), d.seed.size(), result.data(),
                                           result.size());
}

int Instance::adjoint(const Directions& d, Numbers& result) {
  result.assign(d.knowns.size(), 0);
  return CALL(3, GetAdjointDerivative)(handle_, d.unknowns.data(), d.unknowns.size(), d.knowns.data(),
                                       d.knowns.size(), d.seed.data(), d.seed.size(), result.data(),
                                       result.size());
}

void step_through(Instance& instance, double begin, double length, long count) {
  for (long k = 0; k < count; ++k)
    ASSERT_EQ(instance.step(begin + static_cast<double>(k) * length, length), kOk) << instance.log().back();
}

int integrate(Instance& instance, double begin, double length, long count) {
  Numbers x, stage;
  EXPECT_EQ(instance.get_states(x), kOk);
  const std::size_t n = x.size();
  Numbers rates[4] = {Numbers(n), Numbers(n), Numbers(n), Numbers(n)};
  int events = 0;
  for (long k = 0; k < count; ++k) {
    const double t = begin + static_cast<double>(k) * length;
    for (int s = 0; s < 4; ++s) {
      const double part = s == 0 ? 0.0 : s == 3 ? 1.0 : 0.5;
      stage = x;
      for (std::size_t i = 0; s > 0 && i < n; ++i) stage[i] += part * length * rates[s - 1][i];
      EXPECT_EQ(instance.set_time(t + part * length), kOk);
      EXPECT_EQ(instance.set_states(stage), kOk);
      EXPECT_EQ(instance.get_rates(rates[s]), kOk);
    }
    for (std::size_t i = 0; i < n; ++i)
      x[i] += length / 6 * (rates[0][i] + 2 * rates[1][i] + 2 * rates[2][i] + rates[3][i]);
    EXPECT_EQ(instance.set_time(t + length), kOk);
    EXPECT_EQ(instance.set_states(x), kOk);
    bool needs_event = false, change = false;
    EXPECT_EQ(instance.completed_step(needs_event), kOk);
    if (!needs_event) continue;
    ++events;
    EXPECT_EQ(instance.enter_event(), kOk);
    EXPECT_EQ(instance.update(change), kOk);
    EXPECT_EQ(instance.enter_continuous(), kOk);
    if (change) {
      EXPECT_EQ(instance.get_states(x), kOk);
    }
  }
  return events;
}

}  // namespace jourdain::tests
