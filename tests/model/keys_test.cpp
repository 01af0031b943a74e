// The table of keys is what the readers know, and its page what the command prints.
#include <gmock/gmock.h>

#include <algorithm>
#include <optional>
#include <set>
#include <sstream>

#include "model/joint_kinds.hpp"
#include "model/loop_kinds.hpp"
#include "model/read/keys.hpp"
#include "model/read/read.hpp"
#include "support/enumerators.hpp"
#include "support/files.hpp"

namespace jourdain::model {
namespace {

std::string examples() {
  std::string text;
  for (const KeySection& section : key_sections()) text += std::string(section.example) + "\n";
  return text;
}

std::string problems(const std::string& text) {
  support::Diagnostics diagnostics(JOURDAIN_SOURCE_DIR "/models/keys.toml", text);
  read_mechanism(diagnostics);
  return diagnostics.format();
}

/// What the reader says it knows in a table with an unknown key, of a joint or loop of that type.
std::set<std::string> known_in(const std::string& heading, const std::string& type) {
  const std::string found = problems("[model]\nname = \"x\"\n[[" + heading + "]]\nname = \"a\"\ntype = \"" +
                                     type + "\"\nqqqqqqqqqqqq = 1\n");
  const std::size_t at = found.find("known are ");
  EXPECT_NE(at, std::string::npos) << found;
  if (at == std::string::npos) return {};
  std::istringstream words(found.substr(at + 10, found.find('\n', at) - at - 10));
  std::set<std::string> names;
  for (std::string word; words >> word;) names.insert(word.substr(0, word.find(',')));
  return names;
}

TEST(Keys, OfTheExamplesMakeOneModel) { EXPECT_EQ(problems(examples()), ""); }

TEST(Keys, OfJointsAreThoseOfAllTypesAndTheirCoordinates) {
  std::set<std::string> known;
  for (const std::string& type : joint_type_names()) known.merge(known_in("joint", type));
  std::set<std::string> listed;
  for (const JointType type : support::entries_of<JointType>())
    for (const JointMotion& motion : joint_kind(type).coordinates())
      if (!motion.suffix.empty()) listed.emplace(motion.suffix);  // a table of its own
  for (const char* section : {"joint", "coordinate"})
    for (const std::string& key : keys_of(section)) listed.insert(key);
  EXPECT_EQ(known, listed);
}

TEST(Keys, OfLoopsAreThoseOfAllTypes) {
  std::set<std::string> known;
  for (const std::string& type : loop_type_names()) known.merge(known_in("loop", type));
  const std::vector<std::string> listed = keys_of("loop");
  EXPECT_EQ(known, std::set<std::string>(listed.begin(), listed.end()));
}

/// All tables that a file may have are sections, but for the parts of a joint.
TEST(Keys, HaveASectionForEveryTable) {
  const std::string found = problems("qqqqqqqqqqqq = 1\n");
  for (const KeySection& section : key_sections()) {
    const std::string name = section.name;
    if (name == "coordinate") continue;
    EXPECT_THAT(found, testing::HasSubstr(name == "parameter" ? "parameters" : name));
  }
}

}  // namespace
}  // namespace jourdain::model
