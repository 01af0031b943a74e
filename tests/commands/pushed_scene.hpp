// A body on a slide that a force pushes, and runs of it.
#pragma once

#include <string>
#include <vector>

#include "commands/run_jourdain.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {

/// A body of `mass` (kg) on a slide from `at` (m), with more keys of the joint, and a force on it.
inline std::string pushed_slide(const std::string& mass, const std::string& at, const std::string& keys,
                                const std::string& force) {
  return "[model]\nname = \"pushed\"\ngravity = [0, 0, 0]\n[[body]]\nname = \"a\"\nmass = " + mass +
         "\n[[joint]]\nname = \"x\"\ntype = \"prismatic\"\nparent = \"world\"\nchild = \"a\"\naxis = [1, 0, "
         "0]\n"
         "initial_position = " +
         at + "\n" + keys + "[[force]]\njoint = \"x\"\nvalue = \"" + force + "\"\n";
}

class PushedScene {
 public:
  explicit PushedScene(const std::string& scene) {
    support::write_file(folder_.path() + "/scene.toml", scene);
  }

  support::ProcessResult simulate(const std::string& method, const std::string& step,
                                  const std::string& duration,
                                  const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"simulate",   folder_.path() + "/scene.toml",
                                      "--method",   method,
                                      "--step",     step,
                                      "--duration", duration,
                                      "--output",   csv()};
    words.insert(words.end(), more.begin(), more.end());
    return jourdain(words);
  }
  std::string csv() const { return folder_.path() + "/x.csv"; }

 private:
  support::TemporaryFolder folder_;
};

}  // namespace jourdain::tests
