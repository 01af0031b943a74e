#include "model/loop_kinds.hpp"

namespace jourdain::model {

namespace {

/// In the order of LoopType.
const std::vector<LoopKind>& kinds() {
  static const LoopRow x{"x"}, y{"y"}, z{"z"}, a1_d{"a1_d"}, a2_d{"a2_d"}, c1_d{"c1_d"}, c2_d{"c2_d"},
      n_d{"n_d"}, length{"length"}, a1_w{"a1_w", false}, a2_w{"a2_w", false}, a1_b2{"a1_b2", false},
      n_w{"n_w", false}, residual{"residual", false};
  static const std::vector<LoopKind> list = {{"ball", {x, y, z}},
                                             {"revolute", {x, y, z, a1_w, a2_w}},
                                             {"universal", {x, y, z, n_w}},
                                             {"prismatic", {a1_d, a2_d, a1_w, a2_w, a1_b2}},
                                             {"cylindrical", {a1_d, a2_d, a1_w, a2_w}},
                                             {"planar_pin", {c1_d, c2_d}},
                                             {"point_in_plane", {n_d}},
                                             {"point_on_line", {a1_d, a2_d}},
                                             {"rod", {length}},
                                             {"residual", {residual}}};
  return list;
}

}  // namespace

const LoopKind& loop_kind(LoopType type) { return kinds()[static_cast<std::size_t>(type)]; }

std::size_t row_count(LoopType type) { return loop_kind(type).rows.size(); }

const std::vector<std::string>& loop_type_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const LoopKind& kind : kinds()) list.emplace_back(kind.name);
    return list;
  }();
  return names;
}

}  // namespace jourdain::model
