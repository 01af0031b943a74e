#include "model/read/mjcf_law.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <string>

namespace jourdain::model {

namespace {

/// Changes a law by one level, an element or one of its classes.
class Change {
 public:
  Change(MjcfFile& file, const XmlElement& level, MjcfLaw& law) : file_(file), level_(level), law_(law) {}

  void apply() {
    struct Kind {
      void (Change::*change)();
      bool is_foreign;  ///< to servos
    };
    static const std::map<std::string, Kind> kKinds = {{"general", {&Change::general, false}},
                                                       {"motor", {&Change::motor, false}},
                                                       {"position", {&Change::position, false}},
                                                       {"velocity", {&Change::velocity, false}},
                                                       {"intvelocity", {&Change::integrated_velocity, true}},
                                                       {"damper", {&Change::damper, true}},
                                                       {"cylinder", {&Change::cylinder, true}},
                                                       {"muscle", {&Change::muscle, true}},
                                                       {"adhesion", {&Change::adhesion, true}}};
    const auto kind = kKinds.find(level_.Name());
    if (kind == kKinds.end())
      law_.is_unclear = true;
    else
      (this->*kind->second.change)();
    if (kind == kKinds.end() || kind->second.is_foreign) law_.foreign = level_.Name();
  }

 private:
  double number(const char* attribute, double otherwise) {
    return file_.xml().number(level_, attribute, otherwise);
  }

  void types(const char* gain, const char* bias) {
    law_.gain_type = gain;
    law_.bias_type = bias;
    law_.is_position = false;
  }

  void general() {
    file_.overlay(level_, "gainprm", law_.gain, 1);
    file_.overlay(level_, "biasprm", law_.bias, 1);
    const auto take = [this](const char* attribute, std::string& into) {
      if (const char* text = level_.Attribute(attribute)) into = text;
    };
    take("gaintype", law_.gain_type);
    take("biastype", law_.bias_type);
    take("dyntype", law_.dynamics);
    if (level_.Attribute("dyntype")) law_.is_position = false;
  }

  void motor() {
    types("fixed", "none");
    law_.dynamics = "none";
    law_.gain[0] = 1;
    law_.is_unclear = false;
  }

  void position() {
    types("fixed", "affine");
    law_.gain[0] = number("kp", law_.gain[0]);
    law_.bias[1] = -law_.gain[0];
    law_.bias[2] = -number("kv", -law_.bias[2]);
    if (level_.Attribute("dampratio")) law_.bias[2] = number("dampratio", 0);
    if (level_.Attribute("timeconst")) law_.dynamics = number("timeconst", 0) == 0 ? "none" : "filterexact";
    law_.is_position = true;
  }

  void integrated_velocity() {
    position();
    law_.is_position = false;
    law_.dynamics = "integrator";
  }

  void velocity() {
    types("fixed", "affine");
    law_.dynamics = "none";
    law_.gain[0] = number("kv", law_.gain[0]);
    if (level_.Attribute("kv")) law_.is_unclear = false;
    std::fill(law_.bias.begin(), law_.bias.end(), 0.0);
    law_.bias[2] = -law_.gain[0];
    law_.foreign.clear();
  }

  void damper() {
    types("affine", "none");
    law_.dynamics = "none";
    std::fill(law_.gain.begin(), law_.gain.end(), 0.0);
    law_.gain[2] = -number("kv", 0);
  }

  void cylinder() {
    types("fixed", "affine");
    law_.dynamics = "filter";
    file_.overlay(level_, "bias", law_.bias, 1);
    law_.gain[0] = number("area", law_.gain[0]);
    if (level_.Attribute("diameter")) {
      const double diameter = number("diameter", 0);
      law_.gain[0] = std::numbers::pi / 4 * diameter * diameter;
    }
  }

  void muscle() {
    types("muscle", "muscle");
    law_.dynamics = "muscle";
    // Of range[0], range[1], force, scale, lmin, lmax, vmax, fpmax, fvmax where no level has said otherwise.
    constexpr std::array<double, 9> kDefaults = {0.75, 1.05, -1, 200, 0.5, 1.6, 1.5, 1.3, 1.2};
    for (std::size_t k = 0; k < kDefaults.size(); ++k)
      if (law_.gain[k] == (k == 0 ? 1.0 : 0.0)) law_.gain[k] = kDefaults[k];
    std::vector<double> range(law_.gain.begin(), law_.gain.begin() + 2);
    file_.overlay(level_, "range", range, 2);
    std::copy(range.begin(), range.end(), law_.gain.begin());
    law_.gain[2] = number("force", law_.gain[2]);
    std::copy_n(law_.gain.begin(), kDefaults.size(), law_.bias.begin());
  }

  void adhesion() {
    types("fixed", "none");
    law_.gain[0] = number("gain", law_.gain[0]);
  }

  MjcfFile& file_;
  const XmlElement& level_;
  MjcfLaw& law_;
};

}  // namespace

bool MjcfLaw::is_affine() const {
  const bool has_gain = gain_type == "fixed" || (gain_type == "affine" && gain[1] == 0 && gain[2] == 0);
  return !is_unclear && has_gain && (bias_type == "none" || bias_type == "affine") &&
         (dynamics == "none" || (is_position && dynamics.starts_with("filter")));
}

bool MjcfLaw::has_damping_ratio() const {
  return bias_type == "affine" && gain[0] == -bias[1] && bias[2] > 0;
}

MjcfLaw law_of(MjcfFile& file, const XmlElement& actuator) {
  MjcfLaw law;
  const std::vector<const XmlElement*> levels = file.levels(actuator);
  for (auto level = levels.rbegin(); level != levels.rend(); ++level) Change(file, **level, law).apply();
  if (law.bias_type == "none") std::fill(law.bias.begin(), law.bias.end(), 0.0);
  return law;
}

}  // namespace jourdain::model
