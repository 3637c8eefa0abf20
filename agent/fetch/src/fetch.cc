#include "agent/fetch/fetch.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "agent/fetch/src/fetch_estimate.h"
#include "services/base/time.h"

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kFetchWakeUp{200};
constexpr std::chrono::seconds kTellEvery{2};

// Counts what has come so far.
class Fetching {
 public:
  explicit Fetching(const FollowerLinkOptions& options) : options_(options) {}

  // Returns true when the route is complete.
  Result<bool> Take(FollowerLink& link) {
    while (auto item = link.TryTake()) {
      news_at_ = steady_clock::now();
      if (std::get_if<RouteComplete>(&*item) != nullptr) return true;
      if (auto* error = std::get_if<Error>(&*item)) return tl::unexpected(*error);
      if (auto* route = std::get_if<route::RouteInfo>(&*item)) {
        announced_ = route->segment_count;
        told_at_ = news_at_;
      }
    }
    if (link.fetched() > fetched_) {
      news_at_ = steady_clock::now();
      estimate_.Note(news_at_, link.fetched());
    }
    fetched_ = link.fetched();
    held_ = link.held_before() + fetched_;
    if (options_.stop()) return Fail(ErrorCode::kUnavailable, "stopped by a signal; {}", SoFar());
    // Before the first news, the link has bounds of its own and says more precisely what fails.
    if (announced_ > 0 && steady_clock::now() - news_at_ > options_.wait) {
      return Fail(ErrorCode::kUnavailable, "nothing came for {:.0f} s; {}", Seconds(options_.wait),
                  SoFar());
    }
    Tell();
    return false;
  }

 private:
  [[nodiscard]] std::string SoFar() const {
    return fmt::format("{} of {} segments of route '{}' are in {}: the next run goes on from there",
                       held_, announced_, options_.route, options_.store_file);
  }
  void Tell() {
    const auto now = steady_clock::now();
    if (announced_ == 0 || now - told_at_ < kTellEvery) return;
    told_at_ = now;
    estimate_.Note(now, fetched_);
    const auto left = estimate_.Left(announced_ - std::min(announced_, held_));
    const std::string outlook = left ? fmt::format(", about {:.0f} s left", left->count())
                                : now - news_at_ > kTellEvery ? ", none came lately"
                                                              : "";
    spdlog::info("{} of {} segments of '{}' are here{}", held_, announced_, options_.route,
                 outlook);
  }

  const FollowerLinkOptions& options_;
  std::uint32_t announced_ = 0;
  std::uint32_t fetched_ = 0;  // by this run
  std::uint32_t held_ = 0;     // at present, including those of earlier runs
  FetchEstimate estimate_;
  steady_clock::time_point news_at_ = steady_clock::now();
  steady_clock::time_point told_at_ = news_at_;
};

}  // namespace

Result<Summary> Fetch(const FollowerLinkOptions& options, std::unique_ptr<store::RouteStore> store,
                      std::unique_ptr<exchange::RouteExchange> exchange) {
  FollowerLinkOptions stored_alone = options;
  stored_alone.feeds_segments = false;
  stored_alone.hears_operators = false;
  FollowerLink link(std::move(stored_alone), std::move(store), std::move(exchange));
  if (auto started = link.Start(); !started) return tl::unexpected(started.error());
  Fetching fetching(options);
  Result<bool> all = false;
  while (all && !*all) {
    link.WaitForNews(kFetchWakeUp);
    all = fetching.Take(link);
  }
  link.Finish();
  using exchange::AgentMode;
  if (!all) {
    link.Close(options.stop() ? AgentMode::kStopped : AgentMode::kFault, all.error().message);
    return tl::unexpected(all.error());
  }
  link.Close(AgentMode::kArrived, fmt::format("holds revision {} of '{}'",
                                              link.route()->revision.value(), options.route));
  Summary summary;
  summary.AddRoute(*link.route());
  return summary;
}

}  // namespace trailcast::agent
