// A model's own sines are read as sines only where they are written as they must be, and are asked for the right
// angles.
#include <gtest/gtest.h>

#include "readback/compiled_text.hpp"

namespace jourdain::tests {
namespace {

CompiledText with_own_sines(ir::Language language) {
  ir::TextChoices choices;
  choices.language = language;
  return compiled_text("double_pendulum", {"initial_state", "forward_dynamics"}, choices);
}

/// Another token where `c` stands, or 0.
char other(char c) {
  if (c >= '0' && c <= '9') return static_cast<char>('0' + (c - '0' + 1) % 10);
  const std::string tokens = "+-*/^&|", others = "-+/*|^&";
  const std::size_t at = tokens.find(c);
  return at == std::string::npos ? '\0' : others[at];
}

/// Positions in `text` of what can be changed outside of comments, from `first` up to `end`.
std::vector<std::size_t> places(const std::string& text, const std::string& first, const std::string& end) {
  std::vector<std::size_t> found;
  const std::size_t stop = text.find(end, text.find(first));
  for (std::size_t i = text.find(first); i < stop; ++i) {
    if (text.compare(i, 2, "//") == 0) i = text.find('\n', i);
    if (text.compare(i, 2, "/*") == 0) i = text.find("*/", i) + 2;
    if (other(text[i])) found.push_back(i);
  }
  return found;
}

/// Changes every place of a file, one at a time; each must be seen.
void expect_every_change_seen(ir::Language language, const std::string& file, const std::string& first,
                              const std::string& end) {
  const CompiledText text = with_own_sines(language);
  ASSERT_EQ(text.differences(text.compiled.files), std::vector<std::string>());
  for (std::size_t k = 0; k < text.compiled.files.size(); ++k) {
    std::vector<emit::File> files = text.compiled.files;
    std::string& changed = files[k].text;
    if (files[k].name != file) continue;
    const std::vector<std::size_t> all = places(changed, first, end);
    EXPECT_GT(all.size(), 100u) << file;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const char before = changed[all[i]];
      changed[all[i]] = other(before);
      EXPECT_FALSE(text.differences(files).empty()) << file << ": " << changed.substr(all[i] - 30, 60);
      changed[all[i]] = before;
    }
    return;
  }
  FAIL() << "no " << file;
}

TEST(OwnSinesText, IsReadTokenByTokenInCpp) {
  expect_every_change_seen(ir::Language::kCpp, "double_pendulum_kernels.hpp",
                           "#if defined(JOURDAIN_LIBRARY_SINES)",
                           "JOURDAIN_FUNCTION inline double square_root");
  expect_every_change_seen(ir::Language::kCpp, "double_pendulum_kernels.hpp",
                           "#if !defined(JOURDAIN_LIBRARY_SINES)", "}  // namespace detail");
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
