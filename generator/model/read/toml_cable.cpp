// [[cable]]: a cable that runs through points and never pushes, made of expressions.
#include <fmt/format.h>

#include <vector>

#include "model/expression_sums.hpp"
#include "model/read/pushing.hpp"
#include "model/read/toml_frame.hpp"
#include "model/read/toml_sections.hpp"
#include "model/spring.hpp"

namespace jourdain::model {

namespace {

using support::shown;

/// From one point to the next.
struct Segment {
  Vector3 direction;  ///< of unit length
  Expression length, rate;
};

Segment segment(FrameIndex from, FrameIndex to) {
  const Vector3 way = minus(frame_components(Variable::Kind::kFramePosition, to),
                            frame_components(Variable::Kind::kFramePosition, from)),
                velocity = minus(frame_components(Variable::Kind::kFrameVelocity, to),
                                 frame_components(Variable::Kind::kFrameVelocity, from));
  Segment s;
  s.length =
      Expression::unary(Expression::Op::kSqrt, plus(dot(way, way), kLengthSmoothing * kLengthSmoothing));
  for (std::size_t k = 0; k < 3; ++k)
    s.direction[k] = Expression::binary(Expression::Op::kDivide, way[k], s.length);
  s.rate = dot(s.direction, velocity);
  return s;
}

class CableReader {
 public:
  CableReader(TomlFile& file, const TomlTable& table, std::string name, Mechanism& mechanism)
      : file_(file), table_(table), name_(std::move(name)), mechanism_(mechanism) {}

  /// The tension max(k e + c e′, 0) at a stretch e > 0 of the whole length is the same all along: sheaves turn without
  /// friction, and count as points.
  void read() {
    const std::vector<FrameIndex> points = read_points();
    const Expression stiffness = table_.positive("stiffness", needed::kStiffness),
                     damping = table_.not_negative("damping", needed::kDamping),
                     free_length = table_.positive("free_length", needed::kLength);
    if (points.size() < kFewest) return;
    std::vector<Segment> segments;
    Expression length, rate;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      segments.push_back(segment(points[i], points[i + 1]));
      length = plus(length, segments.back().length);
      rate = plus(rate, segments.back().rate);
    }
    const Expression stretch = minus(length, free_length);
    const Expression tension = pushing(stretch, plus(times(stiffness, stretch), times(damping, rate)));
    for (std::size_t i = 0; i < points.size(); ++i) {
      Vector3 pull = {0.0, 0.0, 0.0};
      for (std::size_t k = 0; k < 3; ++k) {
        if (i + 1 < points.size()) pull[k] = plus(pull[k], segments[i].direction[k]);
        if (i > 0) pull[k] = minus(pull[k], segments[i - 1].direction[k]);
      }
      act(points[i], pull, tension);
    }
  }

 private:
  static constexpr std::size_t kFewest = 2, kMost = 20;

  std::vector<FrameIndex> read_points() {
    if (!table_.has("through")) {
      table_.missing("through", "the frames or bodies that it runs through, one after the other");
      return {};
    }
    const toml::array* names = table_.array("through", "an array of names");
    if (!names) return {};
    if (names->size() < kFewest || names->size() > kMost) {
      table_.error("through", fmt::format("{} runs through {} points, it may be {} to {}", table_.what(),
                                          names->size(), kFewest, kMost));
      return {};
    }
    std::vector<FrameIndex> points;
    for (const toml::node& node : *names) {
      const toml::value<std::string>* text = node.as_string();
      if (!text) {
        file_.error(file_.range(node.source()),
                    fmt::format("{} holds names, not {}", table_.quoted("through"), type_in_words(node)));
        return {};
      }
      const std::string name = file_.text(*text);
      const SourceRange where = file_.range(node.source());
      const std::optional<FrameIndex> frame = find_frame(file_, where, table_.what(), name, mechanism_);
      if (!frame) return {};
      if (!points.empty() && points.back() == *frame) {
        file_.error(where, fmt::format("{} runs from '{}' to itself", table_.what(), shown(name)));
        return {};
      }
      points.push_back(*frame);
    }
    return points;
  }

  void act(FrameIndex frame, const Vector3& pull, const Expression& tension) {
    Load load;
    load.name = name_;
    load.frame = frame;
    load.axes = LoadAxes::kWorld;
    load.where = table_.where("through");
    for (std::size_t k = 0; k < 3; ++k) load.force[k] = times(tension, pull[k]);
    mechanism_.loads.push_back(load);
  }

  TomlFile& file_;
  const TomlTable& table_;
  std::string name_;
  Mechanism& mechanism_;
};

}  // namespace

void read_cables(TomlFile& file, const TomlTables& section, Mechanism& mechanism) {
  for_each_table(file, section, "cable", [&](const TomlTable& table, const std::string& name) {
    CableReader(file, table, name, mechanism).read();
  });
}

}  // namespace jourdain::model
