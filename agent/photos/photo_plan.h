#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "services/mission/orders.h"
#include "services/route/route.h"

namespace trailcast::agent {

// Where along one route a robot takes photos while it drives it once. It has no clock and no
// camera.
class PhotoPlan {
 public:
  // A robot that is further past a spot than this, because it has found itself elsewhere, takes no
  // photo of it.
  static constexpr double kNear_m = 0.5;

  PhotoPlan(const mission::PhotoWish& wish, const route::RouteInfo& route, bool backwards);

  struct Spot {
    double at_m = 0.0;  // from the route's beginning
    std::string place{};
  };
  // Returns the next spot that it passes at `along_m`. At its route's end, it also takes those that
  // are just ahead.
  [[nodiscard]] std::optional<Spot> Due(double along_m, bool at_end = false) const;
  // Notes that a photo of it was taken, so that the next is due.
  void NoteTaken(const Spot& spot);
  // Returns the mission's places, in words, of which it has taken a photo.
  [[nodiscard]] std::set<std::string> Photographed() const;

 private:
  struct Place {
    Spot spot;
    std::string words;
    bool taken = false;
  };
  // Metres in the direction of driving.
  [[nodiscard]] double Driven(double along_m) const { return backwards_ ? -along_m : along_m; }

  double every_m_;
  bool backwards_;
  std::vector<Place> places_;
  std::optional<double> reached_m_;  // driven, to the last spot with a photo
};

}  // namespace trailcast::agent
