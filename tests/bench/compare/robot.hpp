// A robot as libraries of rigid bodies take it: links in a tree, fixed joints merged.
#pragma once

#include <string>
#include <vector>

#include "model/matrix3.hpp"

namespace jourdain::compare {

enum class Motion { kTurn, kSlide, kFree };

/// A moving link, in the frame of its joint moved by the joint.
struct Link {
  std::string name;
  int parent = -1;  ///< an earlier link; −1: the world
  Motion motion = Motion::kTurn;
  model::Matrix3 rotation = model::kIdentity3;  ///< of the joint's frame in the parent's
  model::Numbers3 position{};                   ///< m
  model::Numbers3 axis{0, 0, 1};                ///< unit, in the joint's frame
  double mass = 0;                              ///< kg
  model::Numbers3 center{};                     ///< m
  model::Matrix3 inertia{};                     ///< about the centre of mass, kg m²
};

/// Links in the order of y and z; nothing damps, nothing drives.
struct Robot {
  std::vector<Link> links;
  model::Numbers3 gravity{};

  bool has_free_root() const { return links.front().motion == Motion::kFree; }
  bool is_chain() const;
  std::size_t positions() const { return links.size() + (has_free_root() ? 6 : 0); }
  std::size_t velocities() const { return links.size() + (has_free_root() ? 5 : 0); }
};

/// Throws std::runtime_error with the diagnostics, or with what no library here takes.
Robot read_robot(const std::string& path, bool free_root, const std::vector<std::string>& locked);

}  // namespace jourdain::compare
