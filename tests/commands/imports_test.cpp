// What the command line says of a description that imports others.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "commands/run_jourdain.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

const std::string kPart =
    "[[body]]\nname = \"bob\"\nmass = 1\ncenter_of_mass = [0, 0, -1]\n\n[[joint]]\nname = \"hinge\"\ntype = "
    "\"revolute\"\nparent = \"world\"\nchild = \"bob\"\naxis = [0, 1, 0]\n";

/// By sha256sum, of kPart.
const std::string kPartHash = "149679d8f0e11b3542f08f7741c29eeca4910ed531210fab2d67e2f06d64d14f";

TEST(Imports, AreNamedWithTheirHashesInWhatIsEmitted) {
  const support::TemporaryFolder folder;
  support::write_file(folder.path() + "/part.toml", kPart);
  support::write_file(folder.path() + "/pair.toml",
                      "[model]\nname = \"pair\"\n[[import]]\nfile = \"part.toml\"\nprefix = \"a_\"\n"
                      "[[import]]\nfile = \"part.toml\"\nprefix = \"b_\"\n");
  const auto result = jourdain({"compile", folder.path() + "/pair.toml", "-o", folder.path() + "/out"});
  ASSERT_EQ(result.status, 0) << result.output;
  const std::string header = support::read_file(folder.path() + "/out/pair.hpp");
  const std::string line = "// imports part.toml, SHA-256 " + kPartHash + "\n";
  const std::size_t at = header.find(line);
  ASSERT_NE(at, std::string::npos) << header.substr(0, 1000);
  EXPECT_EQ(header.find(line, at + 1), std::string::npos);
  const std::string manifest = support::read_file(folder.path() + "/out/pair.json");
  EXPECT_NE(manifest.find(R"("imported": [{"model": "part.toml", "sha256": ")" + kPartHash + "\"}]"),
            std::string::npos)
      << manifest;
}

TEST(Imports, KeepTheLimitsOfTheirJoints) {
  const support::TemporaryFolder folder;
  support::write_file(folder.path() + "/pair.toml",
                      "[model]\nname = \"pair\"\n[[import]]\nfile = \"" JOURDAIN_SOURCE_DIR
                      "/tests/data/robots/rail_arm.urdf\"\nprefix = \"left_\"\n");
  const auto result = jourdain({"info", folder.path() + "/pair.toml", "--json"});
  ASSERT_EQ(result.status, 0) << result.output;
  const std::size_t slide = result.output.find("\"name\": \"left_slide\"");
  const std::size_t limits = result.output.find("\"limits\"");
  EXPECT_NE(slide, std::string::npos) << result.output;
  EXPECT_NE(limits, std::string::npos) << result.output;
}

TEST(Imports, WithAnErrorEndWithTheStatusOfAWrongModel) {
  const support::TemporaryFolder folder;
  support::write_file(folder.path() + "/pair.toml",
                      "[model]\nname = \"pair\"\n[[import]]\nfile = \"nothing.urdf\"\n");
  const auto result = jourdain({"check", folder.path() + "/pair.toml"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.output.find("pair.toml:4:8: error: 'nothing.urdf' cannot be read: there is no such file"),
            std::string::npos)
      << result.output;
}

}  // namespace
}  // namespace jourdain::tests
