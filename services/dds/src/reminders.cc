#include "services/dds/src/reminders.h"

#include <algorithm>

namespace trailcast::dds {

void Reminders::Tick(Time now, const std::function<bool(const Place&)>& is_confirmed,
                     const std::function<void(const Place&)>& remind) {
  std::erase_if(written_, [&](const auto& entry) {
    const auto& [place, written] = entry;
    return now >= written.due_at && (written.waited > kMost || is_confirmed(place));
  });
  for (auto& [place, written] : written_) {
    if (now < written.due_at) continue;
    remind(place);
    written.waited *= 2;
    written.due_at = now + written.waited;
  }
}

std::chrono::milliseconds Reminders::Wait(Time now, std::chrono::milliseconds max_wait) const {
  for (const auto& [place, written] : written_) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(written.due_at - now);
    max_wait = std::clamp(left, std::chrono::milliseconds(0), max_wait);
  }
  return max_wait;
}

}  // namespace trailcast::dds
