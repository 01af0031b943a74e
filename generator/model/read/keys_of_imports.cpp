#include "model/read/keys_of_imports.hpp"

namespace jourdain::model {

KeySection import_section() {
  return {"import",
          "[[import]]",
          "Another model, of any format that is read, becomes part of this one, before all that this file "
          "declares itself, "
          "which may "
          "name what is imported with its prefix. What that file calls the world is put at position and rpy "
          "of parent. "
          "The inertial frame is that of this file, for gravity, axes = \"world\" and frames in expressions "
          "too; [model] "
          "of the other file does not count, [loops] does where this file has none.",
          {{"file", "text", "", kRequired, "from the folder of this file"},
           {"prefix", "text", "", "empty",
            "put before all names that the file declares, those of its parameters too"},
           {"parent", "name", "", "\"world\"", "a body or frame, of this file or of an import"},
           {"position", "3 numbers", "m", "[0, 0, 0]", "in parent"},
           {"rpy", "3 numbers", "rad", "[0, 0, 0]",
            "its orientation; where free joints start is placed with them"},
           {"parameters", "table", "", "none",
            "what takes the place of parameters of the file: numbers or expressions of those of this file, "
            "so that two "
            "files share one"},
           {"lock", "list of names", "", "none", "joints of the file, without the prefix, that stay at zero"},
           {"root", "\"fixed\", \"free\"", "", "\"fixed\"",
            "not of TOML: how its root hangs on parent; free: on the world"},
           {"damping", "true, false", "", "true", "not of TOML: whether joint damping is read"}},
          R"([[import]]
file = "flyball_governor.toml"
prefix = "governor_"
parent = "crankshaft"
position = [0, 0, 0.1]
lock = ["shaft"]
parameters = { c = "4e4*drag" }
)"};
}

KeySection override_section() {
  return {"override",
          "[[override]]",
          "Changes keys of a body or joint that is imported; all other keys are those of [[body]] and "
          "[[joint]], and what "
          "is left out stays as it is. A mass changes no inertia but that of a shape.",
          {{"body", "name", "", "none", "with its prefix; this, or joint"},
           {"joint", "name", "", "none", "with its prefix; all keys but type, parent, child"}},
          R"([[override]]
body = "governor_ball1"
mass = "40*flywheel"
)"};
}

KeySection repeat_section() {
  return {"repeat",
          "[[repeat]]",
          "Holds tables, [[repeat.body]], [[repeat.joint]] and so on, that are written out once for each "
          "value of its "
          "index. In all their texts {i}, {i+1}, {i-1} stand for it; \"0.1*{i}\" is an expression.",
          {{"count", "integer", "", kRequired, "how often"},
           {"first", "integer", "", "1", "value of the index"},
           {"index", "name", "", "\"i\"", "what braces hold"}},
          R"toml([[repeat]]
count = 4

[[repeat.frame]]
name = "bolt{i}"
body = "crankshaft"
position = ["0.03*cos({i}*90*deg)", "0.03*sin({i}*90*deg)", 0]
)toml"};
}

}  // namespace jourdain::model
