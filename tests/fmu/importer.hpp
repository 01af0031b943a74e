// A small importer of FMUs, which shares nothing with what writes them but the headers of the standard's functions.
#pragma once

#include <tinyxml2.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "fmi2.h"
#include "fmi3.h"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {

using References = std::vector<unsigned>;
using Numbers = std::vector<double>;

/// Status of a call, the same numbers in both versions.
enum Status { kOk = 0, kWarning = 1, kDiscard = 2, kError = 3 };

/// `jourdain fmu` with these arguments behind the path of a description, from models/ on and without its end. The file
/// lives as long as the tests.
std::string make_fmu(const std::string& model, int version, const std::string& more = "");

/// The attributes of a variable, those of its type too.
using Attributes = std::map<std::string, std::string>;

/// An unpacked FMU, its library loaded.
class Fmu {
 public:
  explicit Fmu(const std::string& file, bool load = true);
  ~Fmu();
  Fmu(const Fmu&) = delete;
  Fmu& operator=(const Fmu&) = delete;

  bool is_2() const { return is_2_; }
  const std::string& token() const { return token_; }
  const std::string& folder() const { return folder_.path(); }
  const tinyxml2::XMLElement& root() const { return *document_.RootElement(); }
  const Attributes& variable(const std::string& name) const;
  unsigned reference(const std::string& name) const;
  std::string name_of(unsigned reference) const;
  /// Of an unknown of the structure: "Outputs", "Derivatives", "InitialUnknowns", in order.
  References structure(const std::string& group) const;
  /// References that an unknown depends on by its entry of that group.
  References dependencies(const std::string& group, unsigned reference) const;
  /// States whose derivatives the structure lists, in order.
  References states() const;

  template <class Function>
  Function* function(const char* name) const {
    return reinterpret_cast<Function*>(symbol(name));
  }

 private:
  void* symbol(const char* name) const;
  std::vector<const tinyxml2::XMLElement*> unknowns(const std::string& group) const;
  unsigned as_reference(unsigned number) const { return is_2_ ? number - 1 : number; }

  support::TemporaryFolder folder_;
  tinyxml2::XMLDocument document_;
  bool is_2_ = false;
  std::string token_;
  std::vector<std::string> names_;  ///< by reference
  std::map<std::string, Attributes> variables_;
  void* library_ = nullptr;
};

struct Directions {
  References unknowns, knowns;
  Numbers seed;
};

/// One instance by the calls of whichever version; each answers with the status.
class Instance {
 public:
  Instance(const Fmu& fmu, bool is_exchange, const std::string& name = "one");
  Instance(const Fmu& fmu, bool is_exchange, const std::string& name, const std::string& token);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  void* handle() const { return handle_; }
  const std::vector<std::string>& log() const { return log_; }

  int enter_initialization(double start = 0, bool has_stop = false, double stop = 0);
  int exit_initialization();
  /// From the first call on to where it can be stepped, or is in continuous-time mode.
  void start(double time = 0);
  int terminate();
  int reset();
  int get(const References& references, Numbers& values);
  int set(const References& references, const Numbers& values);
  Numbers values(const References& references);  ///< expects kOk
  double value(const std::string& name);         ///< expects kOk
  int set(const std::string& name, double value);
  int step(double point, double length);

  int enter_event();
  int update(bool& states_change);
  int enter_continuous();
  int completed_step(bool& needs_event);
  int set_time(double time);
  int set_states(const Numbers& x);
  int get_states(Numbers& x);
  int get_rates(Numbers& rates);

  int save(void*& state);
  int restore(void* state);
  int free_state(void*& state);
  int serialize(void* state, std::vector<char>& bytes);
  int deserialize(const std::vector<char>& bytes, void*& state);

  int directional(const Directions& directions, Numbers& result);
  int adjoint(const Directions& directions, Numbers& result);

 private:
  const Fmu& fmu_;
  bool is_exchange_;
  std::vector<std::string> log_;
  std::unique_ptr<fmi2CallbackFunctions> callbacks_;
  void* handle_ = nullptr;
};

/// Steps of `length` from `begin`, `count` of them.
void step_through(Instance& instance, double begin, double length, long count);

/// The same by classical Runge-Kutta steps in model exchange, with the events that the FMU asks for. How many there
/// were.
int integrate(Instance& instance, double begin, double length, long count);

}  // namespace jourdain::tests
