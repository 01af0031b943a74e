// Mass and inertia of bodies: what <inertial> says, or what their geoms weigh.
#pragma once

#include <vector>

#include "model/read/mjcf_file.hpp"

namespace jourdain::model {

/// An element and where the frame that it is given in stands in its body.
struct PlacedElement {
  const XmlElement* element = nullptr;
  Pose frame = {};
};

/// What <compiler> says of masses and inertias.
class MjcfInertia {
 public:
  explicit MjcfInertia(MjcfFile& file);

  /// Sets mass, centre of mass and inertia of `body`, whose element is `where`. `inertial` may be null. Geoms count
  /// where there is none, or as inertiafromgeom says; one that counts and has no known shape is an error.
  void read(const XmlElement& where, const XmlElement* inertial, const std::vector<PlacedElement>& geoms,
            Body& body);
  /// Scales all masses and inertias to the total mass that settotalmass asks for.
  void scale(std::vector<Body>& bodies);

 private:
  /// A homogeneous solid: about its centre, in the axes of `pose` in the body's frame.
  struct Solid {
    double mass = 0;
    Pose pose;
    Numbers3 moments{};
  };
  void read_inertial(const XmlElement& inertial, Body& body);
  void read_geoms(const XmlElement& where, const std::vector<PlacedElement>& geoms, Body& body);
  std::optional<Solid> solid(const PlacedElement& geom);
  bool is_counted(const XmlElement& geom);
  std::optional<Pose> stretched(const XmlElement& geom, const std::string& type, std::vector<double>& size);
  void bound(const XmlElement& where, Body& body);
  void balance(Body& body);

  MjcfFile& file_;
  std::string from_geoms_ = "auto";
  bool balanced_ = false;
  double least_mass_ = 0, least_inertia_ = 0, total_mass_ = -1;
  std::vector<double> groups_{0, 5};
};

}  // namespace jourdain::model
