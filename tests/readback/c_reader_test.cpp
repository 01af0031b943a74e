// What C has and C++ has not: pointers, suffixes, prefixes. What a C compiler would refuse, or compute otherwise, is
// refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "readback/compiled_text.hpp"

namespace jourdain::tests {
namespace {

struct Change {
  const char *file, *from, *to;
};

/// What reading back finds after the change, which must be possible.
std::vector<std::string> differences(const CompiledText& text, const Change& change) {
  std::vector<emit::File> files = text.compiled.files;
  for (emit::File& file : files) {
    if (file.name != change.file) continue;
    const std::size_t at = file.text.find(change.from);
    EXPECT_NE(at, std::string::npos) << change.from;
    if (at != std::string::npos) file.text.replace(at, std::string(change.from).size(), change.to);
  }
  return text.differences(files);
}

TEST(CReader, RefusesWhatCWouldRefuseOrComputeOtherwise) {
  const CompiledText text = compiled_text("pendulum", {"initial_state", "rk4_step"}, {ir::Language::kC});
  ASSERT_EQ(text.differences(text.compiled.files), std::vector<std::string>());
  for (const Change& change : std::initializer_list<Change>{
           {"pendulum_f.c", "parameters->l = 1.0f", "parameters->l = 1.0"},
           {"pendulum.c", "parameters->l = 1.0", "parameters->l = 1.0f"},
           {"pendulum.c", "parameters->l = 1.0", "parameters->l = 1"},
           {"pendulum.c", "state->y[0]", "state.y[0]"},
           {"pendulum.c", "stage2.y[i]", "stage2->y[i]"},
           {"pendulum.c", "(model, state, input, a1", "(model, *state, input, a1"},
           {"pendulum.c", "(model, state, input, a1", "(model, &stage2, input, a1"},
           {"pendulum.c", "(model, &stage2, input", "(model, stage2, input"},
           {"pendulum.c", "&stage2, input, a2", "state, input, a2"},
           {"pendulum.c", "for (i = 0;", "for (int i = 0;"},
           {"pendulum.c", "for (i = 0;", "for (i = 1;"},
           {"pendulum.c", "static double pendulum_detail_sine(", "double pendulum_detail_sine("},
           {"pendulum.c", "2.0 * (", "2.0 * -("},
           {"pendulum.c", "half = 0.5 * h;", ""},
           {"pendulum.c", "#include <math.h>", "#include <tgmath.h>"},
           {"pendulum.h", "pendulum_position_count = 1", "pendulum_position_count = 2"},
           {"pendulum.h", "pendulum_y_pivot = 0", "pendulum_y_pivot = 1"},
           {"pendulum.h", "double l;", "float l;"},
           {"pendulum.h", "const pendulum_state *state", "pendulum_state *state"},
           {"pendulum.h", "extern \"C\" {", "extern \"C++\" {"},
           {"pendulum.h", "typedef struct {\n  double y[1];", "typedef struct {\n  double y[2];"},
           {"pendulum.c", "{\"pivot\", 0}", "{\"pivot\"}"},
           {"pendulum.c", "{\"pivot\", 0}", "{\"pivo?t\", 0}"}})
    EXPECT_NE(differences(text, change), std::vector<std::string>()) << change.from << " -> " << change.to;
}

TEST(CReader, RefusesAStructThatIsAssignedItsAddress) {
  const CompiledText text = compiled_text("four_bar", {"initial_state", "close_loops"}, {ir::Language::kC});
  ASSERT_EQ(text.differences(text.compiled.files), std::vector<std::string>());
  EXPECT_NE(differences(text, {"four_bar.c", "closed = *state", "closed = state"}),
            std::vector<std::string>());
}

TEST(CReader, KnowsThatANegativeNumberIsOneNumber) {
  const CompiledText text = compiled_text("four_bar", {"initial_state"}, {ir::Language::kC, true, false});
  const std::string& source = text.compiled.files[1].text;
  const std::size_t at = source.find("= (-"), end = source.find(");", at);
  ASSERT_NE(at, std::string::npos);
  const std::string literal = source.substr(at, end + 2 - at),
                    bare = "= " + literal.substr(3, literal.size() - 5) + ";";
  EXPECT_THAT(differences(text, {"four_bar.c", literal.c_str(), bare.c_str()}),
              testing::Contains(testing::HasSubstr("neg(")));
}

}  // namespace
}  // namespace jourdain::tests
