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
    std::string placed_name = {};        ///< the frame in it that the pose is of, where not of itself
    SourceRange placed_where = {};       ///< of that name
    std::string base = {};               ///< whole; of where the file does not say
    SdfPose pose = {};                   ///< in that
    std::string placed = {};             ///< whole; empty: the frame itself
    std::string attached = {};           ///< whole; empty and no link: the world
    std::optional<BodyIndex> link = {};  ///< of a link
    SourceRange where = {};              ///< of its name
    bool is_placed = false;              ///< `pose` is of the frame itself, not of `placed`
    SdfPose in_world = {};               ///< where that is known
    bool is_resolved = false;
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
  /// The whole name of the frame that the pose of `model`, called `name`, is of.
  std::string placed(const std::string& name, const Frame& model);
  void report_cycle(const std::string& name);
  /// In its base: that of a model whose pose is that of a frame in it follows from where that frame is in the model.
  SdfPose pose_in_base(const std::string& name);
  /// Of `name` in the model frame `model`, around it; nothing after a diagnostic where it is not placed from there.
  std::optional<SdfPose> pose_within(const std::string& name, const std::string& model);

  SdfFile& file_;
  std::map<std::string, Frame> frames_;
};

}  // namespace jourdain::model
