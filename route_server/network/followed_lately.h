#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "services/base/newest_map.h"
#include "services/exchange/messages.h"
#include "services/records/network_store.h"

namespace trailcast::server {

// How well robots have followed each stretch of a revision lately, by what they say of themselves:
// how often one came over it, and how often one lost its path there, found again or not. Both count
// half after a week, by the caller's clock. No I/O.
class FollowedLately {
 public:
  static constexpr double kHalfAfter_ms = 7.0 * 24.0 * 3600.0 * 1000.0;
  // A metre of a stretch where all were lost costs so many more. A robot that has lost its path
  // looks about for some half a minute, in which others drive 20 m, and may need somebody: that
  // much further round is better. No stretch is worse, since the robots may be at fault as well.
  static constexpr double kLostCosts = 4.0;
  // Besides those that came over it, so many are taken to have done so well: one that was lost says
  // less than many, and what has faded next to nothing.
  static constexpr double kTakenForGranted = 2.0;
  // Beyond it those are forgotten that were not heard of for longest.
  static constexpr std::size_t kMostStretches = store::NetworkStore::kMostFollowed;

  // Of a complete revision; nothing: it is not known.
  using LengthOf = std::function<std::optional<double>(const route::RouteKey&)>;
  explicit FollowedLately(LengthOf length_of) : length_of_(std::move(length_of)) {}

  void Load(std::span<const store::FollowedStretch> followed);  // the oldest first
  void Hear(const exchange::FollowedStretches& told, std::int64_t now_unix_ms);

  // A stretch that costs more for it. To the tenth, as people are told.
  struct Poor {
    route::RouteKey key{};
    double from_m = 0.0;
    double to_m = 0.0;  // beyond the route's end: up to it
    double passed = 0.0;
    double lost = 0.0;
    double cost = 1.0;  // of a metre; above 1
    bool operator==(const Poor&) const = default;
  };
  // By revision, and along it.
  [[nodiscard]] std::vector<Poor> Poorly(std::int64_t now_unix_ms) const;

  // What has changed since it was last saved.
  [[nodiscard]] std::vector<store::FollowedStretch> Unsaved() const;
  void NoteSaved();

 private:
  struct Count {
    double passed = 0.0;
    double lost = 0.0;
    std::int64_t at_unix_ms = 0;
    bool saved = false;
  };
  [[nodiscard]] static Count Faded(Count count, std::int64_t now_unix_ms);

  LengthOf length_of_;
  NewestMap<std::pair<route::RouteKey, std::int64_t>, Count> counts_{kMostStretches};
};

}  // namespace trailcast::server
