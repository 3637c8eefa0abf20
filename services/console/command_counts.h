#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "services/exchange/messages.h"
#include "services/fleet/now_client.h"
#include "services/http/metrics_text.h"

namespace trailcast::console {

// This counts the outcomes of commands to robots from this console. It may be used from any thread.
class CommandCounts {
 public:
  void Count(exchange::NowOrder order, const std::vector<fleet::RobotsWord>& words);
  void Measure(http::MetricsText& text);

 private:
  enum class Result : std::uint8_t { kObeyed, kRefused, kUnanswered };

  std::mutex mutex_;
  std::map<std::pair<exchange::NowOrder, Result>, std::uint64_t> counts_;
};

}  // namespace trailcast::console
