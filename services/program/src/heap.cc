#include "services/program/heap.h"

#include <malloc.h>

namespace trailcast::program {

void KeepFreedMemory() {
  constexpr int kMostThatGlibcTakes = 32 * 1024 * 1024;
  constexpr int kNever = 1024 * 1024 * 1024;
  mallopt(M_MMAP_THRESHOLD, kMostThatGlibcTakes);  // NOLINT(concurrency-mt-unsafe): no thread yet
  mallopt(M_TRIM_THRESHOLD, kNever);               // NOLINT(concurrency-mt-unsafe)
}

}  // namespace trailcast::program
