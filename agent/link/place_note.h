#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::agent {

// How far along its route a follower got.
struct NotedPlace {
  route::RouteKey key;
  double along_m = 0.0;
  double magnification = 1.0;  // this robot's pixels per scout's
  std::int64_t unix_ms = 0;    // when, by the robot's clock: for people
};

// A small file beside a follower's store: what a run that does not arrive leaves to the next one.
// Whole at any moment, whenever the process is killed. After a loss of power it may be an old one
// or none: then the next run does not find the robot there, and says so.
class PlaceNote {
 public:
  explicit PlaceNote(std::filesystem::path file) : file_(std::move(file)) {}

  // Nothing when none was left. kCorrupt: somebody else wrote to it.
  [[nodiscard]] Result<std::optional<NotedPlace>> Read() const;
  [[nodiscard]] Result<void> Write(const NotedPlace& place) const;
  // The robot arrived: there is nothing to go on with.
  [[nodiscard]] Result<void> Remove() const;

 private:
  std::filesystem::path file_;
};

}  // namespace trailcast::agent
