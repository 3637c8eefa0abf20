#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "agent/photos/photo_plan.h"
#include "services/base/mailbox.h"
#include "services/image/image.h"
#include "services/photos/photo_folder.h"

namespace trailcast::agent {

// Keeps the pictures of a robot's missions on its disk. The driving thread hands over a copy of a
// frame and never waits. A thread of this object, with a low priority, encodes it and writes it.
class PhotoTaker {
 public:
  static constexpr int kQuality = 85;
  // A picture is encoded more coarsely until it is no larger.
  static constexpr std::size_t kMostBytes = 512U << 10U;
  static constexpr std::size_t kMostWaiting = 3;

  explicit PhotoTaker(photos::PhotoFolder& folder);
  ~PhotoTaker();  // after it has kept what waits
  PhotoTaker(const PhotoTaker&) = delete;
  PhotoTaker& operator=(const PhotoTaker&) = delete;

  // Takes a photo of which all but its id, time and size is known. Returns false if too many wait,
  // as on a slow disk; then the next frame may do.
  [[nodiscard]] bool Take(photos::Photo photo, const image::GrayImage& picture);
  // Returns lines for the log: why a photo was not kept, and which had to go.
  [[nodiscard]] std::vector<std::string> TakeNews();

 private:
  struct Item {
    photos::Photo photo{};
    image::GrayImage picture{};
  };
  void Run();
  [[nodiscard]] Result<void> Keep(Item item);

  photos::PhotoFolder& folder_;
  Mailbox<Item> items_{kMostWaiting};
  Mailbox<std::string> news_{16};
  Bell handed_over_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

// The photos of one drive along a route, for the control loop.
class PhotoRun {
 public:
  PhotoRun(PhotoTaker& taker, mission::PhotoWish wish, AgentId robot, std::string mission,
           bool backwards)
      : taker_(taker),
        wish_(std::move(wish)),
        robot_(std::move(robot)),
        mission_(std::move(mission)),
        backwards_(backwards) {}

  // Where the robot is when it has this frame.
  struct Place {
    const route::RouteInfo& route;
    double along_m = 0.0;
    bool sure = false;
    bool at_end = false;  // of its route
  };
  // Takes a photo if one is due.
  void Pass(const Place& place, const image::GrayImage& picture);
  [[nodiscard]] int taken() const { return taken_; }
  // Returns the mission's places, in words, of which it has taken a photo.
  [[nodiscard]] std::set<std::string> Photographed() const;

 private:
  PhotoTaker& taker_;
  const mission::PhotoWish wish_;
  const AgentId robot_;
  const std::string mission_;
  const bool backwards_;
  std::optional<PhotoPlan> plan_;  // once the route is known
  int taken_ = 0;
};

}  // namespace trailcast::agent
