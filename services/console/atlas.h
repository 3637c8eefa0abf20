#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "services/base/newest_map.h"
#include "services/base/result.h"
#include "services/exchange/route_exchange.h"
#include "services/fleet/operator_peer.h"
#include "services/route/route.h"

namespace trailcast::console {

// This makes shapes of routes, whose segments it fetches from the fleet on demand, one route at a
// time. It does so by a network member of its own, which joins for it and leaves when nobody has
// asked for a minute, so that it delays no command to robots. It may be used from any thread.
class Atlas {
 public:
  using Join = std::function<Result<fleet::OperatorPeer>()>;
  static constexpr std::size_t kMostKept = 64;
  static constexpr std::size_t kMostAsked = 32;   // routes that wait to be fetched
  static constexpr std::size_t kMostWaiting = 4;  // callers that wait for them
  static constexpr std::chrono::seconds kLeaveAfter{60};
  // A failed fetch is repeated, and the active revision is asked for again, no sooner than this.
  static constexpr std::chrono::seconds kAskAgain{5};

  // `join` joins with fleet::ExporterTopics. A server must reply within the time.
  explicit Atlas(Join join, std::chrono::milliseconds reply_within = std::chrono::seconds(5));
  ~Atlas();
  Atlas(const Atlas&) = delete;
  Atlas& operator=(const Atlas&) = delete;

  struct Found {
    std::shared_ptr<const std::string> shape{};  // openapi.yaml's RouteShape; null if not there yet
    double fetched = 0.0;                        // share of it, 0 to 1
  };
  // Returns the shape of this teaching of a route, or of the one that robots follow, and waits for
  // it for `most`. Fails with kNotFound; with kConflict while it is being taught; and with
  // kUnavailable when it cannot be fetched, or too many are asked for.
  [[nodiscard]] Result<Found> Find(const RouteId& route, std::optional<TeachingId> teaching,
                                   std::chrono::milliseconds most);
  // Ends fetching, and releases all callers that wait.
  void Close();

 private:
  using Clock = std::chrono::steady_clock;
  using Wanted = std::pair<RouteId, std::optional<TeachingId>>;
  using Shape = Result<std::shared_ptr<const std::string>>;
  struct Sheet {
    bool done = false;
    Shape shape{};
    double fetched = 0.0;
    Clock::time_point done_at{};
  };

  void Run();
  [[nodiscard]] std::optional<Wanted> Next(std::chrono::milliseconds most);
  [[nodiscard]] Result<route::RouteInfo> Ask(fleet::OperatorPeer& peer, const Wanted& wanted);
  // Joins if there is no `peer`.
  [[nodiscard]] Shape Draw(std::optional<fleet::OperatorPeer>& peer, const Wanted& wanted);
  [[nodiscard]] Shape Survey(fleet::OperatorPeer& peer, const Wanted& wanted);
  // Returns null if the sheet is not there, or no longer true.
  [[nodiscard]] const Sheet* Held(const Wanted& wanted) const;
  [[nodiscard]] bool closed();

  const Join join_;
  const std::chrono::milliseconds reply_within_;

  std::mutex mutex_;  // guards what follows
  bool closed_ = false;
  std::size_t waiting_ = 0;
  std::deque<Wanted> asked_;  // the first is being fetched
  NewestMap<Wanted, Sheet> sheets_{kMostKept};
  std::condition_variable changed_;

  std::thread thread_;
};

}  // namespace trailcast::console
