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
  double magnification = 1.0;  // this robot's pixels per pixel of the scout's
  std::int64_t unix_ms = 0;    // time by the robot's clock, for people
};

// A small file beside a follower's store, in which a run that does not arrive leaves its place to
// the next one. It is whole at any moment, even if the process is killed. After a loss of power it
// may be old or missing; the next run then does not find the robot there, and says so.
class PlaceNote {
 public:
  explicit PlaceNote(std::filesystem::path file) : file_(std::move(file)) {}

  // Returns nothing if no place was left. kCorrupt means that another program wrote to the file.
  [[nodiscard]] Result<std::optional<NotedPlace>> Read() const;
  [[nodiscard]] Result<void> Write(const NotedPlace& place) const;
  // Removes the note of a robot that arrived.
  [[nodiscard]] Result<void> Remove() const;

 private:
  std::filesystem::path file_;
};

}  // namespace trailcast::agent
