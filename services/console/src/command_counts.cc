#include "services/console/command_counts.h"

#include "services/mission/now.h"

namespace trailcast::console {

using exchange::NowOrder;

void CommandCounts::Count(NowOrder order, const std::vector<fleet::RobotsWord>& words) {
  const std::scoped_lock lock(mutex_);
  for (const fleet::RobotsWord& word : words) {
    const Result obeys = word.refused ? Result::kRefused : Result::kObeyed;
    ++counts_[{order, word.answered ? obeys : Result::kUnanswered}];
  }
}

void CommandCounts::Measure(http::MetricsText& text) {
  const std::scoped_lock lock(mutex_);
  text.Begin("commands_total", "counter", "Commands to robots from this console, each robot's.");
  for (const NowOrder order :
       {NowOrder::kPause, NowOrder::kResume, NowOrder::kCancel, NowOrder::kStop, NowOrder::kRelease,
        NowOrder::kEnd, NowOrder::kHome}) {
    for (const auto& [result, name] : {std::pair{Result::kObeyed, "obeyed"},
                                       {Result::kRefused, "refused"},
                                       {Result::kUnanswered, "unanswered"}}) {
      text.Add(static_cast<double>(counts_[{order, result}]),
               {{"order", mission::ToString(order)}, {"result", name}});
    }
  }
}

}  // namespace trailcast::console
