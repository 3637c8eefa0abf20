#include "tests/soak/vitals.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <thread>
#include <vector>

namespace trailcast::soak {
namespace {

std::vector<Vitals> Samples(std::uint64_t first_kb, std::uint64_t more_kb, int more_threads = 0) {
  std::vector<Vitals> samples;
  for (int i = 0; i < 20; ++i) {
    const auto step = static_cast<std::uint64_t>(i);
    // Some noise: up and down by 1 %.
    samples.push_back({first_kb + step * more_kb + (i % 2 == 0 ? first_kb / 100 : 0),
                       8 + i * more_threads / 10, 20});
  }
  return samples;
}

TEST(Growth, AProcessThatKeepsItsSizeIsFlat) {
  const auto growth = GrowthOf(Samples(25'000, 0));
  ASSERT_TRUE(growth);
  EXPECT_TRUE(IsFlat(*growth));
}

TEST(Growth, ALeakOfHalfAPercentACycleIsFound) {
  const auto growth = GrowthOf(Samples(25'000, 125));
  ASSERT_TRUE(growth);
  EXPECT_FALSE(IsFlat(*growth));
  EXPECT_NEAR(growth->memory_share(), 15 * 0.005, 0.015);
}

TEST(Growth, OneThreadMoreIsFound) {
  const auto growth = GrowthOf(Samples(25'000, 0, 1));
  ASSERT_TRUE(growth);
  EXPECT_FALSE(IsFlat(*growth));
}

TEST(Growth, SevenSamplesAreTooFewToTell) {
  EXPECT_FALSE(GrowthOf(std::vector<Vitals>(7, Vitals{1, 1, 1})));
}

TEST(VitalsOf, CountsThreadsAndDescriptorsOfAProcess) {
  const auto before = VitalsOf(getpid());
  ASSERT_TRUE(before);
  EXPECT_GT(before->memory_kb, 1000U);
  const int file = open("/dev/null", O_RDONLY | O_CLOEXEC);
  std::jthread other([](const std::stop_token& stop) {
    while (!stop.stop_requested()) std::this_thread::yield();
  });
  const auto after = VitalsOf(getpid());
  close(file);
  ASSERT_TRUE(after);
  EXPECT_EQ(after->descriptors, before->descriptors + 1);
  EXPECT_EQ(after->threads, before->threads + 1);
}

TEST(VitalsOf, SaysNothingOfAProcessThatIsNotThere) { EXPECT_FALSE(VitalsOf(-1)); }

}  // namespace
}  // namespace trailcast::soak
