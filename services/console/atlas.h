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

// Shapes of routes, whose segments are fetched from the fleet when somebody asks: one route at a
// time, by a member of its own that joins for it and leaves when nobody has asked for a minute. So
// nothing of it holds up what robots are told. May be used from any thread.
class Atlas {
 public:
  using Join = std::function<Result<fleet::OperatorPeer>()>;
  static constexpr std::size_t kMostKept = 64;
  static constexpr std::size_t kMostAsked = 32;   // routes that wait to be fetched
  static constexpr std::size_t kMostWaiting = 4;  // who wait for them
  static constexpr std::chrono::seconds kLeaveAfter{60};
  // What failed is tried again, and which revision is active asked again, no sooner.
  static constexpr std::chrono::seconds kAskAgain{5};

  // `join`: with fleet::ExporterTopics. A server is to reply within the time.
  explicit Atlas(Join join, std::chrono::milliseconds reply_within = std::chrono::seconds(5));
  ~Atlas();
  Atlas(const Atlas&) = delete;
  Atlas& operator=(const Atlas&) = delete;

  struct Found {
    std::shared_ptr<const std::string> shape{};  // openapi.yaml's RouteShape; null: not there yet
    double fetched = 0.0;                        // 0 to 1 of it
  };
  // Of this teaching of a route, or of the one that robots take. Waits for it, up to `most`.
  // kNotFound; kConflict while it is being taught; kUnavailable when it cannot be fetched, or too
  // many are asked for.
  [[nodiscard]] Result<Found> Find(const RouteId& route, std::optional<TeachingId> teaching,
                                   std::chrono::milliseconds most);
  // Nothing is fetched any more, and whoever waits is let go.
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
  // `peer`: joins if there is none.
  [[nodiscard]] Shape Draw(std::optional<fleet::OperatorPeer>& peer, const Wanted& wanted);
  [[nodiscard]] Shape Survey(fleet::OperatorPeer& peer, const Wanted& wanted);
  // Null: it is not there, or no longer true.
  [[nodiscard]] const Sheet* Held(const Wanted& wanted) const;
  [[nodiscard]] bool closed();

  const Join join_;
  const std::chrono::milliseconds reply_within_;

  std::mutex mutex_;  // guards what follows
  bool closed_ = false;
  std::size_t waiting_ = 0;
  std::deque<Wanted> asked_;  // the first is under way
  NewestMap<Wanted, Sheet> sheets_{kMostKept};
  std::condition_variable changed_;

  std::thread thread_;
};

}  // namespace trailcast::console
