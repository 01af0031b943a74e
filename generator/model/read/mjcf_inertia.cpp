#include "model/read/mjcf_inertia.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace jourdain::model {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kWaterDensity = 1000;  // kg/m³, MuJoCo's default

Matrix3 diagonal(const Numbers3& d) { return {{{d[0], 0, 0}, {0, d[1], 0}, {0, 0, d[2]}}}; }

Inertia inertia_of(const Matrix3& I) { return {I[0][0], I[1][1], I[2][2], I[0][1], I[0][2], I[1][2]}; }

Matrix3 matrix_of(const Inertia& I) {
  const double xy = I.xy.constant(), xz = I.xz.constant(), yz = I.yz.constant();
  return {{{I.xx.constant(), xy, xz}, {xy, I.yy.constant(), yz}, {xz, yz, I.zz.constant()}}};
}

/// Volume, m³, and principal moments per mass, m², about the centre.
struct Form {
  double volume = 0;
  Numbers3 moments{};
};

/// Half sizes a, b, c of each type: box all; ellipsoid semi-axes; sphere radius a; cylinder and capsule radius a and
/// half the length b of the straight part, along z.
std::optional<Form> form_of(const std::string& type, const std::vector<double>& size) {
  const double a = size[0], b = size[1], c = size[2];
  if (type == "sphere") return Form{4 * kPi / 3 * a * a * a, {0.4 * a * a, 0.4 * a * a, 0.4 * a * a}};
  if (type == "box")
    return Form{8 * a * b * c, {(b * b + c * c) / 3, (a * a + c * c) / 3, (a * a + b * b) / 3}};
  if (type == "ellipsoid")
    return Form{4 * kPi / 3 * a * b * c, {(b * b + c * c) / 5, (a * a + c * c) / 5, (a * a + b * b) / 5}};
  const double lateral = a * a / 4 + b * b / 3;
  if (type == "cylinder") return Form{2 * kPi * a * a * b, {lateral, lateral, a * a / 2}};
  if (type != "capsule") return {};
  // Two half balls, whose centres lie 3/8 of the radius beyond the ends of the straight part.
  const double straight = 2 * kPi * a * a * b, balls = 4 * kPi / 3 * a * a * a, all = straight + balls;
  const double side = 0.4 * a * a + b * b + 0.75 * a * b;
  const double across = (straight * lateral + balls * side) / all;
  return Form{all, {across, across, (straight * a * a / 2 + balls * 0.4 * a * a) / all}};
}

/// How many numbers of `size` the type has.
std::size_t size_count(const std::string& type) {
  return type == "sphere" ? 1 : type == "cylinder" || type == "capsule" ? 2 : 3;
}

}  // namespace

MjcfInertia::MjcfInertia(MjcfFile& file) : file_(file) {
  if (const auto* e = file.compiler("inertiafromgeom"))
    from_geoms_ = file.choice(*e, "inertiafromgeom", {"false", "true", "auto"}, from_geoms_);
  if (const auto* e = file.compiler("balanceinertia")) balanced_ = file.truth(*e, "balanceinertia", false);
  if (const auto* e = file.compiler("boundmass")) least_mass_ = file.number(*e, "boundmass", 0);
  if (const auto* e = file.compiler("boundinertia")) least_inertia_ = file.number(*e, "boundinertia", 0);
  if (const auto* e = file.compiler("settotalmass")) total_mass_ = file.number(*e, "settotalmass", -1);
  if (const auto* e = file.compiler("inertiagrouprange"))
    groups_ = file.numbers(*e, "inertiagrouprange", groups_, 2);
}

void MjcfInertia::read(const XmlElement& where, const XmlElement* inertial,
                       const std::vector<PlacedElement>& geoms, Body& body) {
  // Always by geoms where there are some, says MuJoCo; a body without any keeps what it has.
  const bool some = std::any_of(geoms.begin(), geoms.end(),
                                [this](const PlacedElement& geom) { return is_counted(*geom.element); });
  const bool by_geoms = (from_geoms_ == "true" && some) || (from_geoms_ == "auto" && !inertial);
  if (by_geoms)
    read_geoms(where, geoms, body);
  else if (inertial)
    read_inertial(*inertial, body);
  bound(where, body);
  if (balanced_) balance(body);
}

void MjcfInertia::read_inertial(const XmlElement& e, Body& body) {
  UrdfFile& xml = file_.xml();
  const Pose pose = file_.pose(e);
  body.mass = xml.required_number(e, "mass");
  body.mass_where = xml.value(e, "mass");
  const bool full = e.Attribute("fullinertia") != nullptr;
  body.inertia_where = xml.value(e, full ? "fullinertia" : "diaginertia");
  if (full) {
    const std::vector<double> I = file_.numbers(e, "fullinertia", std::vector<double>(6), 6);
    body.inertia = {I[0], I[1], I[2], I[3], I[4], I[5]};
    if (e.Attribute("diaginertia") || file_.is_oriented(e))
      file_.error(body.inertia_where, "<inertial> has 'fullinertia' beside its principal moments or axes",
                  "fullinertia is in the axes of the body");
  } else {
    const Numbers3 d = file_.triple(e, "diaginertia", {});
    body.inertia = {d[0], d[1], d[2], 0.0, 0.0, 0.0};
  }
  const Placement placement = placement_of(pose, xml.element(e));
  body.center_of_mass = placement.position;
  if (!full) body.inertia_axes = placement.rotation;
}

void MjcfInertia::read_geoms(const XmlElement& where, const std::vector<PlacedElement>& geoms, Body& body) {
  std::vector<Solid> solids;
  for (const PlacedElement& geom : geoms)
    if (const auto one = solid(geom)) solids.push_back(*one);
  double mass = 0;
  Numbers3 first{};
  for (const Solid& one : solids) {
    mass += one.mass;
    first = sum(first, times(one.pose.origin, one.mass));
  }
  if (!(mass > 0)) return;
  const Numbers3 center = times(first, 1 / mass);
  Matrix3 inertia{};
  for (const Solid& one : solids) {
    const Numbers3 offset = sum(one.pose.origin, times(center, -1));
    inertia =
        sum(inertia, sum(turned(one.pose.R, diagonal(one.moments)), scaled(point_inertia(offset), one.mass)));
  }
  body.mass = mass;
  body.center_of_mass = {center[0], center[1], center[2]};
  body.inertia = inertia_of(inertia);
  body.mass_where = body.inertia_where = file_.xml().element(where);
}

std::optional<MjcfInertia::Solid> MjcfInertia::solid(const PlacedElement& geom) {
  const XmlElement& e = *geom.element;
  const std::string type = file_.choice(
      e, "type", {"plane", "hfield", "sphere", "capsule", "ellipsoid", "cylinder", "box", "mesh", "sdf"},
      "sphere");
  const bool weighed = file_.holder(e, "mass") != nullptr;
  const double given = file_.number(e, weighed ? "mass" : "density", kWaterDensity);
  if (!is_counted(e) || type == "plane" || type == "hfield" || given == 0) return {};
  if (given < 0) {
    const XmlElement& holder = *file_.holder(e, weighed ? "mass" : "density");
    file_.xml().complete().numbers = false;
    file_.error(file_.xml().value(holder, weighed ? "mass" : "density"), "a geom's mass is negative");
    return {};
  }
  if (file_.holder(e, "mesh") || type == "mesh" || type == "sdf" || file_.truth(e, "shellinertia", false)) {
    const SourceRange where = file_.xml().element(e);
    file_.xml().complete().numbers = false;
    file_.error(where,
                "the body's mass would follow from the mesh or shell of this <geom>, which is not read",
                "give the body an <inertial>, or the geom mass=\"0\"");
    return {};
  }
  std::vector<double> size = file_.numbers(e, "size", {0, 0, 0}, 1);
  const std::optional<Pose> by_ends = stretched(e, type, size);
  const Pose pose = composed(geom.frame, by_ends ? *by_ends : file_.pose(e));
  const std::size_t count = size_count(type);
  if (!std::all_of(size.begin(), size.begin() + static_cast<std::ptrdiff_t>(count),
                   [](double x) { return x > 0; })) {
    const XmlElement* holder = file_.holder(e, "size");
    file_.xml().complete().numbers = false;
    file_.error(holder ? file_.xml().value(*holder, "size") : file_.xml().element(e),
                fmt::format("a {} needs {} positive number{} as 'size'", type, count, count == 1 ? "" : "s"));
    return {};
  }
  const std::optional<Form> form = form_of(type, size);
  if (!form) return {};
  const double mass = weighed ? given : given * form->volume;
  return Solid{mass, pose, times(form->moments, mass)};
}

bool MjcfInertia::is_counted(const XmlElement& geom) {
  const double group = file_.number(geom, "group", 0);
  return group >= groups_[0] && group <= groups_[1];
}

/// Of a geom between two points, its length into `size`.
std::optional<Pose> MjcfInertia::stretched(const XmlElement& e, const std::string& type,
                                           std::vector<double>& size) {
  const XmlElement* holder = file_.holder(e, "fromto");
  if (!holder || type == "sphere") return {};
  const std::vector<double> ends = file_.numbers(e, "fromto", std::vector<double>(6), 6);
  const Numbers3 from{ends[0], ends[1], ends[2]}, to{ends[3], ends[4], ends[5]};
  const Numbers3 along = sum(to, times(from, -1));
  const std::optional<Matrix3> R = rotation_to(along);
  if (!R) {
    file_.xml().complete().numbers = false;
    file_.error(file_.xml().value(*holder, "fromto"), "the two points of 'fromto' are one");
    return {};
  }
  const double half = std::hypot(along[0], along[1], along[2]) / 2;
  if (size_count(type) == 2)
    size[1] = half;
  else
    size = {size[0], size[0], half};
  return Pose{times(sum(from, to), 0.5), *R};
}

void MjcfInertia::bound(const XmlElement& where, Body& body) {
  if (least_mass_ > 0) body.mass = std::max(body.mass.constant(), least_mass_);
  if (!(least_inertia_ > 0)) return;
  Matrix3 I = matrix_of(body.inertia);
  const Numbers3 moments = symmetric_eigenvalues(I);
  if (moments[0] >= least_inertia_) return;
  if (moments[2] <= least_inertia_) I = diagonal({least_inertia_, least_inertia_, least_inertia_});
  if (I[0][1] != 0 || I[0][2] != 0 || I[1][2] != 0)
    return file_.error(file_.xml().element(where),
                       "boundinertia is above a principal moment of a body with products of inertia",
                       "give its inertia as diaginertia, with its axes");
  for (std::size_t i = 0; i < 3; ++i) I[i][i] = std::max(I[i][i], least_inertia_);
  body.inertia = inertia_of(I);
}

void MjcfInertia::balance(Body& body) {
  const Numbers3 moments = symmetric_eigenvalues(matrix_of(body.inertia));
  if (moments[0] + moments[1] >= moments[2]) return;
  const double mean = (moments[0] + moments[1] + moments[2]) / 3;
  body.inertia = inertia_of(diagonal({mean, mean, mean}));
}

void MjcfInertia::scale(std::vector<Body>& bodies) {
  double total = 0;
  for (const Body& body : bodies) total += body.mass.constant();
  if (!(total_mass_ > 0) || !(total > 0)) return;
  const double factor = total_mass_ / total;
  for (Body& body : bodies) {
    body.mass = body.mass.constant() * factor;
    body.inertia = inertia_of(scaled(matrix_of(body.inertia), factor));
  }
}

}  // namespace jourdain::model
