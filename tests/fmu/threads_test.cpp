// Instances beside each other: in one thread, in eight, of two models, loaded again.
#include <gtest/gtest.h>

#include <thread>

#include "fmu/importer.hpp"

namespace jourdain::tests {
namespace {

/// Outputs after some steps from where the first continuous state starts at `offset`.
Numbers run(const Fmu& fmu, double offset) {
  Instance instance(fmu, false);
  EXPECT_EQ(instance.set(References{fmu.states().front()}, Numbers{offset}), kOk);
  instance.start();
  step_through(instance, 0, 1e-3, 200);
  return instance.values(fmu.structure("Outputs"));
}

TEST(Threads, EightComputeWhatOneDoes) {
  const Fmu carts(make_fmu("cart_pole", 2, "--step 0.001")),
      linkages(make_fmu("squeezer", 3, "--step 1e-05"));
  constexpr int kThreads = 8;
  std::vector<Numbers> found(kThreads), expected;
  for (int k = 0; k < kThreads; ++k) expected.push_back(run(k % 2 ? carts : linkages, 0.01 * k));
  std::vector<std::thread> threads;
  for (int k = 0; k < kThreads; ++k)
    threads.emplace_back([&, k] { found[std::size_t(k)] = run(k % 2 ? carts : linkages, 0.01 * k); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(found, expected);
}

TEST(Instances, OfOneModelAreApart) {
  const Fmu fmu(make_fmu("cart_pole", 3, "--step 0.001"));
  const Numbers alone = run(fmu, 0.3);
  Instance one(fmu, false), two(fmu, false, "two");
  const References first = {fmu.states().front()};
  ASSERT_EQ(one.set(first, {0.3}), kOk);
  ASSERT_EQ(two.set(first, {-0.7}), kOk);
  ASSERT_EQ(two.set("pole_mass", 0.2), kOk);
  one.start();
  two.start();
  for (int k = 0; k < 200; ++k) {
    ASSERT_EQ(one.step(k * 1e-3, 1e-3), kOk);
    ASSERT_EQ(two.step(k * 1e-3, 1e-3), kOk);
  }
  EXPECT_EQ(one.values(fmu.structure("Outputs")), alone);
  EXPECT_EQ(two.value("pole_mass"), 0.2);
  EXPECT_EQ(one.value("pole_mass"), 0.1);
}

TEST(Libraries, AreUnloadedAndLoadedAgain) {
  Numbers before;
  for (int k = 0; k < 3; ++k) {
    const Fmu fmu(make_fmu("cart_pole", 2, "--step 0.001"));
    const Numbers now = run(fmu, 0.1);
    EXPECT_TRUE(k == 0 || now == before);
    before = now;
  }
}

/// Both have functions of the same names.
TEST(Libraries, OfBothVersionsAndTwoModelsAreApart) {
  const Fmu cart_2(make_fmu("cart_pole", 2, "--step 0.001")),
      cart_3(make_fmu("cart_pole", 3, "--step 0.001")), quadrotor(make_fmu("quadrotor", 2, "--step 0.001"));
  EXPECT_EQ(run(cart_2, 0.2), run(cart_3, 0.2));
  EXPECT_EQ(run(quadrotor, 0.2).front(), 0.2);
}

}  // namespace
}  // namespace jourdain::tests
