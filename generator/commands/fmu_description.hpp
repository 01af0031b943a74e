// modelDescription.xml: what an importer reads of a model before it loads it.
#pragma once

#include <string>
#include <vector>

#include "commands/fmu_scene.hpp"

namespace jourdain::commands {

/// Exponents of the base units that a unit of the model is a product of.
struct BaseUnits {
  int kg = 0, m = 0, s = 0, A = 0, rad = 0;
  double factor = 1;
};

/// Of a text such as "N m/rad"; nothing where it is no product of units that are known.
std::optional<BaseUnits> base_units(const std::string& unit);

/// The text of modelDescription.xml. `token` is the GUID, or instantiation token, that instances are asked for with;
/// `sources` the C files of the folder sources/ that are compiled.
std::string model_description(const FmuScene& scene, FmiVersion version, const std::string& token,
                              const std::vector<std::string>& sources);

/// The text of sources/buildDescription.xml of FMI 3.0.
std::string build_description(const std::string& name, const std::vector<std::string>& sources);

}  // namespace jourdain::commands
