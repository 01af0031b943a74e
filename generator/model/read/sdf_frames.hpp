// The named frames of an SDF file: links, joints, models and frames, each given relative to another one.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "model/indices.hpp"
#include "model/read/sdf_file.hpp"

namespace jourdain::model {

/// Names are whole: "arm::wrist" is the frame 'wrist' of the model 'arm'; "" is the world.
class SdfFrames {
 public:
  explicit SdfFrames(SdfFile& file) : file_(file) { frames_[""] = {.is_resolved = true}; }

  struct Frame {
    std::string scope = {};              ///< of the names that follow
    std::string base_name = {};          ///< what the pose is relative to, as the file has it; or empty
    std::string attached_name = {};      ///< what it moves with, likewise
    std::string base = {};               ///< whole; of where the file does not say
    SdfPose pose = {};                   ///< in that
    std::string attached = {};           ///< whole; empty and no link: the world
    std::optional<BodyIndex> link = {};  ///< of a link
    SourceRange where = {};              ///< of its name
    bool is_resolved = false;            ///< the pose is in the world
    bool is_visited = false;
  };

  /// False where the name is taken, after a diagnostic.
  bool add(const std::string& name, Frame frame);

  /// The whole name of what is called `name` in the model `scope` ("" or ending in "::"); nothing after a diagnostic
  /// that `who` names an unknown frame.
  std::optional<std::string> find(const std::string& scope, const std::string& name, SourceRange where,
                                  const std::string& who);

  /// Finds what all frames are relative to and move with. No frame is added after that.
  void settle();

  /// In the world, at coordinate zero; the identity after a diagnostic where frames are given by each other.
  SdfPose pose(const std::string& name);

  /// The link that carries it; nothing: the world.
  std::optional<BodyIndex> link(const std::string& name);

 private:
  SdfFile& file_;
  std::map<std::string, Frame> frames_;
};

}  // namespace jourdain::model
