// Under sanitizers memory is theirs: this runs as released.
#include "services/program/heap.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <vector>

namespace trailcast::program {
namespace {

constexpr int kPictures = 12;
constexpr std::size_t kBytes = 640 * 360;

// Pages that this thread has had to be given while it made and freed frames.
long PagesGivenFor(int frames) {
  const auto given = [] {
    rusage usage{};
    getrusage(RUSAGE_THREAD, &usage);
    return usage.ru_minflt;
  };
  const long before = given();
  for (int i = 0; i < frames; ++i) {
    // All at once, as a picture's pyramid and its gradients are.
    std::vector<std::vector<unsigned char>> pictures;
    for (int k = 0; k < kPictures; ++k) pictures.emplace_back(kBytes, i);
  }
  return given() - before;
}

TEST(Heap, FramesAfterTheFirstCostNoPages) {
  const long page_bytes = 4096;
  KeepFreedMemory();
  (void)PagesGivenFor(1);
  constexpr long kFrames = 100;
  EXPECT_LT(PagesGivenFor(kFrames),
            kFrames * kPictures * static_cast<long>(kBytes) / page_bytes / 10);
}

}  // namespace
}  // namespace trailcast::program
