// Functions that take entries of tables are read as the numbers that stand in them.
#include <gtest/gtest.h>

#include "readback/every_change.hpp"

namespace jourdain::tests {
namespace {

CompiledText of_tables(const ir::TextChoices& choices) {
  return compiled_text("wind_turbine", {"initial_state", "forward_dynamics"}, choices);
}

TEST(TableText, IsReadTokenByTokenInCpp) {
  ir::TextChoices plain, packs;
  packs.packs = true;
  for (const ir::TextChoices& choices : {plain, packs}) {
    const CompiledText text = of_tables(choices);
    const std::string file = "wind_turbine_kernels.hpp";
    expect_every_change_seen(text, file, "struct TableOf", "Real table_", 1, 50);
    expect_every_change_seen(text, file, "Real table_", "void sine_cosine", 37);
  }
}

TEST(TableText, IsReadTokenByTokenInC) {
  ir::TextChoices choices;
  choices.language = ir::Language::kC;
  const CompiledText text = of_tables(choices);
  expect_every_change_seen(text, "wind_turbine.c", "static double wind_turbine_detail_table_", "\nvoid ", 37);
  expect_every_change_seen(text, "wind_turbine_f.c", "static float wind_turbine_f_detail_table_", "\nvoid ",
                           37);
}

}  // namespace
}  // namespace jourdain::tests
