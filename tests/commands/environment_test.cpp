// What commands make of the compiler and the folders of the machine they run on.
#include <gtest/gtest.h>

#include <filesystem>

#include "commands/run_jourdain.hpp"
#include "support/diagnostics.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;

/// A program in `folder` that calls the compiler named by its first argument with the others, and leaves a file behind.
std::string launcher(const support::TemporaryFolder& folder) {
  const std::string path = folder.path() + "/launcher";
  support::write_file(path, "#!/bin/sh\ntouch '" + folder.path() + "/launched'\nexec \"$@\"\n");
  fs::permissions(path, fs::perms::owner_all);
  return path;
}

TEST(Environment, TheCompilerMayHaveSeveralWords) {
  const support::TemporaryFolder folder;
  const std::string compiler = "CXX=" + launcher(folder) + "  g++ -DNOTHING ", csv = folder.path() + "/p.csv";
  expect(jourdain({compiler}, {"simulate", "models/pendulum.toml", "--duration", "0.1", "--output", csv}), 0,
         "wrote");
  EXPECT_TRUE(fs::exists(folder.path() + "/launched"));
  expect(jourdain({compiler}, {"cost", "models/pendulum.toml", "--methods", "euler"}), 0, "stack");
  expect(jourdain({"CXX=" + launcher(folder) + " no-such-compiler"},
                  {"simulate", "models/pendulum.toml", "--output", csv}),
         3, "no-such-compiler");
}

TEST(Environment, WithoutAFolderForTemporaryFilesItIsNamed) {
  const support::TemporaryFolder folder;
  const std::string csv = folder.path() + "/p.csv";
  expect(jourdain({"TMPDIR=" + folder.path() + "/missing"},
                  {"simulate", "models/pendulum.toml", "--duration", "0.1", "--output", csv}),
         3, "no folder for temporary files (TMPDIR)");
  EXPECT_FALSE(fs::exists(csv));
}

TEST(Environment, AForceOfAThousandFactorsIsAccepted) {
  const support::TemporaryFolder folder;
  const std::string file = folder.path() + "/thousand_factors.toml";
  std::string product = "j";
  for (int i = 1; i < 1000; ++i) product += "*j";
  support::write_file(
      file,
      "[model]\nname = \"m\"\n[[body]]\nname = \"b\"\nmass = 1\ninertia = [1, 1, 1]\n[[joint]]\n"
      "name = \"j\"\ntype = \"revolute\"\nparent = \"world\"\nchild = \"b\"\n[[force]]\njoint = \"j\"\n"
      "value = \"" +
          product + "\"\n");
  expect(jourdain({}, {"check", file}), 0, "ok: m");
}

}  // namespace
}  // namespace jourdain::tests
