#include "dynamics/link_equations.hpp"

#include <fmt/format.h>

#include <map>

namespace jourdain::dynamics {

using kinematics::kGround;
using kinematics::Link;
using kinematics::LinkKind;

namespace {

std::string link_named(const char* quantity, std::size_t i) { return fmt::format("{}{}", quantity, i); }
std::string link_named(const char* quantity, std::size_t j, std::size_t i) {
  return i == kGround ? link_named(quantity, j) : fmt::format("{}{}_{}", quantity, j, i);
}

/// Angles of links against links inward of them, or against what their run stands in (kGround).
class Angles {
 public:
  explicit Angles(const Scene& scene) : scene_(scene), angle_(scene.link_count()) {
    for (std::size_t j = 0; j < scene.link_count(); ++j)
      if (scene.turns(j)) add(j);
  }

  Ex cosine(std::size_t j, std::size_t i) const {
    return scene_.statements.bind(link_named("c", j, i), kinematics::cosine(angle_[j].at(i)));
  }
  Ex sine(std::size_t j, std::size_t i) const {
    return scene_.statements.bind(link_named("s", j, i), kinematics::sine(angle_[j].at(i)));
  }

 private:
  /// The angle against the ground starts with that of the run's first link, as the others are needed anyway.
  void add(std::size_t j) {
    const Ex& own = scene_.states[j].position;
    std::size_t first = j;
    for (; scene_.tree.turns_beside_parent(first); first = scene_.tree.links[first].parent) {
      const std::size_t i = scene_.tree.links[first].parent, p = scene_.tree.links[j].parent;
      angle_[j][i] = p == i ? own : scene_.statements.bind(link_named("angle", j, i), angle_[p].at(i) + own);
    }
    const Ex& start = scene_.states[first].position;
    angle_[j][kGround] =
        first == j ? own : scene_.statements.bind(link_named("angle", j), start + angle_[j].at(first));
  }

  const Scene& scene_;
  std::vector<std::map<std::size_t, Ex>> angle_;
};

class Derivation {
 public:
  Derivation(const Scene& scene, RowScale scale)
      : scene_(scene),
        statements_(scene.statements),
        angles_(scene),
        count_(scene.link_count()),
        mass_(count_),
        first_(count_),
        polar_(count_) {
    result_.M.assign(count_, std::vector<Ex>(count_, 0));
    result_.inertia.assign(count_, 0);
    result_.weight.assign(count_, 0);
    result_.weight_alone.assign(count_, 0);
    gather();
    set_scale(scale);
  }

  LinkEquations derive() {
    for (std::size_t i = 0; i < count_; ++i) {
      const Ex& rate = scene_.omega.own[i][2];
      square_.push_back(scene_.turns(i) ? statements_.bind(link_named("lww", i), rate * rate) : Ex(0));
    }
    for (std::size_t i = 0; i < count_; ++i)
      if (scene_.turns(i))
        turn(i);
      else
        slide(i);
    for (std::size_t i = 0; i < count_; ++i)
      result_.inertia[i] = statements_.bind(link_named("lk", i), result_.inertia[i]);
    return std::move(result_);
  }

 private:
  /// Of what each link carries: masses outward, and what turns with it, with links beside it as masses.
  void gather() {
    for (std::size_t i = 0; i < count_; ++i) {
      const kinematics::MassMoments& own = scene_.tree.links[i].moments;
      mass_[i] = own.mass;
      first_[i] = own.first;
      polar_[i] = statements_.bind(link_named("lJ", i), own.second[0][0] + own.second[1][1]);
    }
    for (std::size_t i = count_; i-- > 0;) {
      const Link& link = scene_.tree.links[i];
      if (link.parent == kGround) continue;
      mass_[link.parent] = statements_.bind(link_named("lm", i), mass_[link.parent] + mass_[i]);
      if (!scene_.tree.turns_beside_parent(i)) continue;
      const Vector3 mr = statements_.bind(link_named("lmr", i), mass_[i] * link.r_PL);
      first_[link.parent] = statements_.bind(link_named("lh", i), first_[link.parent] + mr);
      polar_[link.parent] = statements_.bind(
          link_named("lJc", i), polar_[link.parent] + (mr[0] * link.r_PL[0] + mr[1] * link.r_PL[1]));
    }
  }

  void set_scale(RowScale scale) {
    result_.scale.assign(count_, 1);
    if (scale == RowScale::kNone) return;
    std::vector<std::size_t> root(count_), unit(count_, kGround);  // the last turn, by root of its tree
    for (std::size_t i = 0; i < count_; ++i) {
      const std::size_t p = scene_.tree.links[i].parent;
      root[i] = p == kGround ? i : root[p];
      if (scene_.turns(i)) unit[root[i]] = polar_[i].is_zero() ? kGround : i;  // a rotor alone may resist
    }
    for (std::size_t i = 0; i < count_; ++i) {
      const std::size_t u = unit[root[i]];
      if (u == kGround) continue;
      result_.scale[i] =
          i == root[i] ? statements_.bind(link_named("lone", i), 1 / polar_[u]) : result_.scale[root[i]];
      if (u == i) result_.M[i][i] = 1;
    }
  }

  Ex scaled(std::size_t i, const std::string& name, const Ex& value) const {
    return statements_.bind(name, result_.scale[i] * statements_.bind(name, value));
  }

  /// Entry [j][i] is along cos(angle) + across sin(angle); its slope acts on both with squares of rates.
  void couple(std::size_t j, std::size_t i, std::size_t against, const Ex& along, const Ex& across) {
    const Ex c = angles_.cosine(j, against), s = angles_.sine(j, against);
    const Ex a = scaled(i, link_named("lc", j, i), along), b = scaled(i, link_named("ls", j, i), across);
    const Ex ac = statements_.bind(link_named("lac", j, i), a * c),
             as = statements_.bind(link_named("las", j, i), a * s);
    const Ex bc = statements_.bind(link_named("lbc", j, i), b * c),
             bs = statements_.bind(link_named("lbs", j, i), b * s);
    result_.M[j][i] = statements_.bind(link_named("lM", j, i), ac + bs);
    const Ex slope = statements_.bind(link_named("lD", j, i), as - bc);
    result_.inertia[i] = result_.inertia[i] + slope * square_[j];
    if (scene_.turns(i)) result_.inertia[j] = result_.inertia[j] - slope * square_[i];
  }

  void turn(std::size_t j) {
    const Vector3& h = first_[j];
    if (result_.M[j][j].is_zero()) result_.M[j][j] = scaled(j, link_named("lM", j, j), polar_[j]);
    std::size_t k = j;
    for (; scene_.tree.turns_beside_parent(k); k = scene_.tree.links[k].parent) {
      const std::size_t i = scene_.tree.links[k].parent;
      const Vector3& r = scene_.tree.links[k].r_PL;
      couple(j, i, i, r[0] * h[0] + r[1] * h[1], r[1] * h[0] - r[0] * h[1]);
    }
    for (std::size_t s = scene_.tree.links[k].parent; s != kGround; s = scene_.tree.links[s].parent) {
      const Vector3 d = along_slide(s, k);
      couple(j, s, kGround, d[1] * h[0] - d[0] * h[1], -(d[0] * h[0] + d[1] * h[1]));
    }
    const Vector3 g = gravity(k);
    const Ex a = scaled(j, link_named("lgc", j), h[0] * g[1] - h[1] * g[0]);
    const Ex b = scaled(j, link_named("lgs", j), h[0] * g[0] + h[1] * g[1]);
    const Ex sine = angles_.sine(j, kGround), cosine = angles_.cosine(j, kGround);
    result_.weight[j] = statements_.bind(link_named("lg", j), a * cosine - b * sine);
    result_.weight_alone[j] =
        statements_.bind(link_named("lga", j), a * scene_.frames.cosine(j) - b * scene_.frames.sine(j));
  }

  void slide(std::size_t j) {
    for (std::size_t s = j; s != kGround; s = scene_.tree.links[s].parent)
      result_.M[j][s] = scaled(j, link_named("lM", j, s), mass_[j] * along_slide(s, j)[2]);
    result_.weight[j] = scaled(j, link_named("lg", j), mass_[j] * gravity(j)[2]);
    result_.weight_alone[j] = result_.weight[j];
  }

  /// The direction of slide s in W of a link outward of it that no turn carries: constant.
  Vector3 along_slide(std::size_t s, std::size_t link) const {
    if (s == link) return scene_.frames.direction(s);
    return scene_.frames.from_parent(link, along_slide(s, scene_.tree.links[link].parent),
                                     link_named("ld", link, s));
  }

  Vector3 gravity(std::size_t link) const {
    const std::size_t p = scene_.tree.links[link].parent;
    return scene_.frames.from_parent(link, p == kGround ? scene_.tree.gravity : gravity(p),
                                     link_named("lgw", link));
  }

  const Scene& scene_;
  kinematics::Statements& statements_;
  Angles angles_;
  std::size_t count_;
  std::vector<Ex> mass_;
  std::vector<Vector3> first_;
  std::vector<Ex> polar_, square_;
  LinkEquations result_;
};

}  // namespace

bool has_link_equations(const Scene& scene) {
  bool any = false;
  for (std::size_t i = 0; i < scene.link_count(); ++i) {
    const Link& link = scene.tree.links[i];
    const bool on_slides = link.parent == kGround || scene.tree.links[link.parent].kind == LinkKind::kSlide;
    const bool is_plain = link.kind == LinkKind::kTurn || link.kind == LinkKind::kSlide;
    if (!is_plain || !scene.states[i].entry) return false;
    if (!scene.tree.turns_beside_parent(i) && !on_slides) return false;
    any = any || scene.turns(i);
  }
  return any;
}

LinkEquations derive_link_equations(const Scene& scene, RowScale scale) {
  return Derivation(scene, scale).derive();
}

}  // namespace jourdain::dynamics
