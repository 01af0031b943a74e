#include "properties/random_mixture.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/coordinates.hpp"
#include "model/joint_kinds.hpp"
#include "model/read/read.hpp"
#include "properties/consistent_state.hpp"
#include "properties/random.hpp"
#include "properties/random_laws.hpp"
#include "properties/random_loops.hpp"
#include "properties/random_rolling.hpp"
#include "properties/random_scene.hpp"
#include "properties/to_toml.hpp"
#include "reference/minimal.hpp"
#include "support/check.hpp"

namespace jourdain::tests {

namespace {

constexpr std::uint64_t kMostDraws = 50;
constexpr long double kLargestForce = 1e5L;  // N, N m

/// Tables of library elements, as text.
class Elements {
 public:
  Elements(const model::Mechanism& mechanism, Random& random) : mechanism_(mechanism), random_(random) {
    for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
      for (std::size_t c = 0; c < mechanism.joints[j].coordinates.size(); ++c)
        if (!mechanism.joints[j].coordinates[c].motion) free_.push_back({j, c});
  }

  std::string run() {
    for (std::size_t i = random_.below(3); i-- > 0;) add_stop();
    for (std::size_t i = random_.below(2); i-- > 0;) add_friction();
    for (std::size_t i = random_.below(3); i-- > 0;) add_contact();
    if (random_.chance(0.3)) add_tyre();
    if (random_.chance(0.3)) add_cable();
    if (random_.chance(0.5)) add_gear_mesh();
    return text_;
  }

 private:
  struct At {
    std::size_t joint = 0, coordinate = 0;
  };

  std::string number(double low, double high) { return fmt::format("{:.6f}", random_.uniform(low, high)); }
  std::string three(double size) {
    return fmt::format("[{}, {}, {}]", number(-size, size), number(-size, size), number(-size, size));
  }
  std::string body() { return mechanism_.bodies[random_.below(mechanism_.bodies.size())].name; }

  /// "joint = …", and 'coordinate' where it has several.
  std::string place(const At& at) const {
    const model::Joint& joint = mechanism_.joints[at.joint];
    const auto kinds = model::joint_kind(joint).coordinates();
    std::string text = fmt::format("joint = \"{}\"\n", joint.name);
    if (kinds.size() > 1) text += fmt::format("coordinate = \"{}\"\n", kinds[at.coordinate].suffix);
    return text;
  }

  void add_stop() {
    if (free_.empty()) return;
    text_ += "\n[[stop]]\n" + place(free_[random_.below(free_.size())]);
    text_ += fmt::format("stiffness = {}\ndamping = {}\n", number(5, 50), number(0, 3));
    const bool both = random_.chance(0.5);
    if (both || random_.chance(0.5)) text_ += fmt::format("lower = {}\n", number(-0.6, 0));
    if (both || text_.rfind("lower") < text_.rfind("[[stop]]"))
      text_ += fmt::format("upper = {}\n", number(0.1, 0.6));
  }

  void add_friction() {
    if (free_.empty()) return;
    const At at = free_[random_.below(free_.size())];
    text_ += fmt::format("\n[[friction]]\nname = \"brake{}\"\n", count_++) + place(at);
    text_ += fmt::format("coulomb = {}\nbristle_stiffness = {}\nbristle_damping = {}\nviscous = {}\n",
                         number(0.5, 2), number(5, 30), number(0, 2), number(0, 1));
    if (random_.chance(0.5))
      text_ += fmt::format("breakaway = {}\nstribeck_speed = {}\n", number(2, 3), number(0.3, 1));
  }

  /// A plane, or ground of a height, near the world's origin.
  std::string ground() {
    std::string text = fmt::format("point = {}\nnormal = {}\n", three(0.3), three(1));
    if (random_.chance(0.3))
      text += fmt::format("height = \"{}*sin(x) + {}*y*z + {}*t\"\n", number(-0.1, 0.1), number(-0.1, 0.1),
                          number(-0.1, 0.1));
    return text;
  }

  void add_contact() {
    text_ += fmt::format("\n[[contact]]\nname = \"touch{}\"\nframe = \"{}\"\n", count_++, body()) + ground();
    text_ += fmt::format("stiffness = {}\ndamping = {}\n", number(5, 50), number(0, 1));
    if (random_.chance(0.3)) text_ += "exponent = 1.5\n";
    if (random_.chance(0.3)) text_ += fmt::format("radius = {}\n", number(0.05, 0.3));
    if (random_.chance(0.4))
      text_ += fmt::format("friction = {}\nslip_speed = {}\n", number(0.1, 1), number(0.05, 0.3));
    else if (random_.chance(0.5))
      text_ += fmt::format(
          "friction = {}\nfriction_model = \"lugre\"\nbristle_stiffness = {}\nbristle_damping = {}\n"
          "slip_speed = 0.01\n",
          number(0.1, 1), number(1, 10), number(0, 1));
  }

  void add_tyre() {
    text_ += fmt::format("\n[[tyre]]\nname = \"roller{}\"\nframe = \"{}\"\naxis = {}\n", count_++, body(),
                         three(1)) +
             ground();
    text_ += fmt::format("radius = {}\nstiffness = {}\ndamping = {}\nfriction = {}\nrelaxation_length = {}\n",
                         number(0.2, 0.5), number(20, 100), number(0, 3), number(0.5, 1), number(0.3, 1));
    text_ += random_.chance(0.5) ? fmt::format("law = \"brush\"\nslip_stiffness = {}\n", number(2, 10))
                                 : fmt::format(
                                       "stiffness_factor = [{}, {}]\nshape_factor = [1.5, 1.3]\n"
                                       "curvature_factor = [0.5, -0.3]\n",
                                       number(2, 8), number(2, 8));
  }

  void add_cable() {
    text_ += fmt::format(
        "\n[[cable]]\nthrough = [\"{}\", \"world\", \"{}\"]\nstiffness = {}\ndamping = {}\nfree_length = "
        "{}\n",
        body(), body(), number(5, 30), number(0, 2), number(0.2, 2));
  }

  void add_gear_mesh() {
    std::vector<std::string> angles;
    for (const At& at : free_) {
      const model::Coordinate& coordinate = mechanism_.joints[at.joint].coordinates[at.coordinate];
      const bool is_curve = mechanism_.joints[at.joint].type == model::JointType::kCurve;
      if (coordinate.angular && !is_curve) angles.push_back(coordinate.name);
    }
    if (angles.size() < 2) return;
    const std::size_t first = random_.below(angles.size());
    const std::size_t second = (first + 1 + random_.below(angles.size() - 1)) % angles.size();
    text_ += fmt::format(
        "\n[[gear_mesh]]\nfirst = \"{}\"\nsecond = \"{}\"\nfirst_radius = {}\nsecond_radius = {}\n"
        "stiffness = {}\ndamping = {}\nbacklash = {}\n",
        angles[first], angles[second], number(0.1, 0.5), number(-0.5, -0.1), number(5, 50), number(0, 3),
        number(0, 0.2));
  }

  const model::Mechanism& mechanism_;
  Random& random_;
  std::vector<At> free_;
  std::string text_;
  int count_ = 0;
};

/// As the reader has it; none where an element may not stand where it was drawn.
std::optional<model::Mechanism> with_elements(const model::Mechanism& base, Random& random) {
  support::Diagnostics diagnostics("mixture.toml", to_toml(base) + Elements(base, random).run());
  return model::read_mechanism(diagnostics);
}

bool forces_are_finite(const model::Mechanism& mechanism, std::uint64_t seed) {
  using Long = long double;
  const auto states = consistent_states(mechanism, seed, kLoopStates);
  if (!states) return false;
  const auto inputs = Eigen::Index(model::lay_out_coordinates(mechanism).input_count());
  for (const LoopState& state : *states) {
    const auto terms = reference::Reference<Long>(mechanism).evaluate(
        state, reference::VectorX<Long>::LinSpaced(inputs, -2, 3));
    if (!(terms.q_scale.norm() < kLargestForce)) return false;
  }
  return true;
}

}  // namespace

model::Mechanism random_mixture(std::uint64_t seed) {
  for (std::uint64_t draw = 0; draw < kMostDraws; ++draw) {
    Random random(seed * 1009 + 100003 * draw);
    const model::Mechanism base = seed % 3 == 0   ? random_scene(seed + 1000 * draw)
                                  : seed % 3 == 1 ? random_loops(seed + 1000 * draw)
                                                  : random_rolling(seed);
    std::optional<model::Mechanism> mechanism = with_elements(base, random);
    if (!mechanism) continue;
    mechanism->name = fmt::format("random_mixture_{}", seed);
    add_laws(*mechanism, seed + draw);
    if (forces_are_finite(*mechanism, seed)) return std::move(*mechanism);
  }
  JD_CHECK(false, "no mixture for seed {}", seed);
  return {};
}

}  // namespace jourdain::tests
