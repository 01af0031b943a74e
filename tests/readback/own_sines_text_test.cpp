// A model's own sines are read as sines only where they are written as they must be, and are asked for the right
// angles.
#include <gtest/gtest.h>

#include "readback/every_change.hpp"

namespace jourdain::tests {
namespace {

CompiledText with_own_sines(ir::Language language) {
  ir::TextChoices choices;
  choices.language = language;
  return compiled_text("double_pendulum", {"initial_state", "forward_dynamics"}, choices);
}

void expect_every_change_seen(ir::Language language, const std::string& file, const std::string& first,
                              const std::string& end) {
  tests::expect_every_change_seen(with_own_sines(language), file, first, end);
}

TEST(OwnSinesText, IsReadTokenByTokenInCpp) {
  expect_every_change_seen(ir::Language::kCpp, "double_pendulum_kernels.hpp",
                           "#if defined(JOURDAIN_LIBRARY_SINES)",
                           "JOURDAIN_FUNCTION inline double square_root");
}

/// Of two, three and four angles.
TEST(OwnSinesText, HasItsBlocksReadTokenByToken) {
  const CompiledText text = compiled_text("squeezer", {"initial_state", "outputs", "forward_dynamics"}, {});
  for (const char* block : {"void sine_cosine2(", "void sine_cosine3(", "void sine_cosine4("})
    EXPECT_NE(text.compiled.files[1].text.find(std::string("inline ") + block), std::string::npos) << block;
  tests::expect_every_change_seen(text, "squeezer_kernels.hpp", "#if !defined(JOURDAIN_LIBRARY_SINES)",
                                  "}  // namespace detail");
}

TEST(OwnSinesText, IsReadTokenByTokenInC) {
  for (const char* file : {"double_pendulum.c", "double_pendulum_f.c"})
    expect_every_change_seen(ir::Language::kC, file, "#if defined(JOURDAIN_LIBRARY_SINES)", "\nvoid ");
}

TEST(OwnSinesText, HasItsBlocksReadLikeSinglePairs) {
  const CompiledText text = with_own_sines(ir::Language::kCpp);
  const std::string begin = "detail::sine_cosine2(state.y[0], ", end = ", state.y[1]";
  const std::string& written = text.compiled.files[1].text;
  const std::size_t at = written.rfind(begin), stop = written.find(end, at);
  ASSERT_NE(at, std::string::npos);
  const std::string results = written.substr(at + begin.size(), stop - at - begin.size());
  const std::size_t comma = results.find(", ");
  ASSERT_NE(comma, std::string::npos) << results;
  const std::string sine = results.substr(0, comma), cosine = results.substr(comma + 2);
  for (const std::string& wrong :
       {begin + cosine + ", " + sine + end, "detail::sine_cosine2(state.y[1], " + results + end,
        begin + results + ", state.y[0]", begin + sine + ", " + sine + end}) {
    std::vector<emit::File> files = text.compiled.files;
    files[1].text.replace(at, stop + end.size() - at, wrong);
    EXPECT_FALSE(text.differences(files).empty()) << wrong;
  }
}

TEST(OwnSinesText, IsThereWhereItWasAskedForAndOnlyThere) {
  for (const ir::Language language : {ir::Language::kCpp, ir::Language::kC}) {
    const CompiledText own = with_own_sines(language);
    ir::TextChoices choices;
    choices.language = language;
    choices.own_sines = false;
    const CompiledText library =
        compiled_text("double_pendulum", {"initial_state", "forward_dynamics"}, choices);
    EXPECT_EQ(library.differences(library.compiled.files), std::vector<std::string>());
    for (const auto& [text, other] : {std::pair{&own, &library}, {&library, &own}}) {
      std::string found;
      for (const std::string& difference : text->differences(other->compiled.files))
        found += difference + "\n";
      EXPECT_NE(found.find("sines written out"), std::string::npos) << found;
    }
  }
}

}  // namespace
}  // namespace jourdain::tests
