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

// How well robots have followed each section of a revision lately, by their reports: how often one
// passed it, and how often one lost its path there, whether or not it found it again. Both counts
// halve in a week, by the caller's clock. It has no I/O.
class FollowedLately {
 public:
  static constexpr double kHalfAfter_ms = 7.0 * 24.0 * 3600.0 * 1000.0;
  // The additional cost of a metre of a section where all robots were lost. A robot that has lost
  // its path searches for some half a minute, in which others drive 20 m, and may need help; so
  // much of a detour is better. The cost is bounded, because the robots may be at fault as well.
  static constexpr double kLostCosts = 4.0;
  // So many robots are assumed to have passed it well, in addition to those that did. One lost
  // robot then counts for less than many, and old reports for almost nothing.
  static constexpr double kTakenForGranted = 2.0;
  // Beyond this number those with the oldest news are forgotten.
  static constexpr std::size_t kMostSections = store::NetworkStore::kMostFollowed;

  // Returns the length of a complete revision, or nothing if it is not known.
  using LengthOf = std::function<std::optional<double>(const route::RouteKey&)>;
  explicit FollowedLately(LengthOf length_of) : length_of_(std::move(length_of)) {}

  void Load(std::span<const store::FollowedSection> followed);  // the oldest first
  void Hear(const exchange::FollowedSections& told, std::int64_t now_unix_ms);

  // A section that therefore costs more, rounded to tenths as people see it.
  struct Poor {
    route::RouteKey key{};
    double from_m = 0.0;
    double to_m = 0.0;  // may be beyond the route's end, which it then means
    double passed = 0.0;
    double lost = 0.0;
    double cost = 1.0;  // of a metre; above 1
    bool operator==(const Poor&) const = default;
  };
  // Returns them by revision, and along each.
  [[nodiscard]] std::vector<Poor> Poorly(std::int64_t now_unix_ms) const;

  // Returns the changes since it was last saved.
  [[nodiscard]] std::vector<store::FollowedSection> Unsaved() const;
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
  NewestMap<std::pair<route::RouteKey, std::int64_t>, Count> counts_{kMostSections};
};

}  // namespace trailcast::server
