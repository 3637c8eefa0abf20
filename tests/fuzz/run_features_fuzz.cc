// Features as logs as MCAP have them.
#include <cmath>

#include "agent/diagnosis/seen_features.h"
#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const auto& feature : trailcast::agent::ReadFeatures({data, size})) {
    trailcast::fuzz::Require(std::isfinite(feature.u_px) && std::isfinite(feature.v_px) &&
                                 std::isfinite(feature.to_u_px) && std::isfinite(feature.to_v_px),
                             "numbers that can be drawn");
  }
  return 0;
}
