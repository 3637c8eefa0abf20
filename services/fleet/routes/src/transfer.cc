#include "services/fleet/routes/transfer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "services/base/time.h"

namespace trailcast::fleet {

std::string ProgressText(const std::string& doing, std::uint64_t done, std::uint64_t total,
                         std::chrono::nanoseconds elapsed) {
  const std::uint64_t some = std::min(done, total);
  const double share = total > 0 ? static_cast<double>(some) / static_cast<double>(total) : 1.0;
  std::string text = fmt::format("{}: {:.0f} % of {:.1f} MB", doing, 100.0 * share,
                                 static_cast<double>(total) / 1e6);
  if (share > 0.0) {
    text += fmt::format(", about {:.0f} s left", Seconds(elapsed) * (1.0 - share) / share);
  }
  return text;
}

TransferProgress::TransferProgress(std::string doing, std::uint64_t total_bytes)
    : doing_(std::move(doing)), total_bytes_(total_bytes), lines_(stderr) {}

void TransferProgress::Show(std::uint64_t done_bytes) {
  const auto elapsed = Clock::now() - began_;
  if (elapsed < kMoment) return;
  lines_.Show({ProgressText(doing_, done_bytes, total_bytes_, elapsed)});
}

}  // namespace trailcast::fleet
