#include "agent/session/src/frame_pace.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trailcast::agent {
namespace {

constexpr std::size_t kPictures = 8;

}  // namespace

void FramePace::Note(double after_s) {
  lately_s_.push_back(after_s);
  if (lately_s_.size() > kPictures) lately_s_.pop_front();
}

motion::VelocityCommand FramePace::Within(const motion::VelocityCommand& wanted) const {
  if (lately_s_.empty()) return wanted;
  const double each_s = std::accumulate(lately_s_.begin(), lately_s_.end(), 0.0) /
                        static_cast<double>(lately_s_.size());
  const double too_far =
      std::max(each_s * std::abs(wanted.linear_mps) / options_.furthest_m,
               each_s * std::abs(wanted.angular_radps) / options_.furthest_turn_rad);
  const double share = 1.0 / std::max(1.0, too_far);
  return {share * wanted.linear_mps, share * wanted.angular_radps};
}

}  // namespace trailcast::agent
