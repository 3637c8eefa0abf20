#pragma once

#include <functional>

#include "agent/device/device.h"
#include "services/route/route.h"
#include "services/vision/picture_intake.h"

namespace trailcast::agent {

// The first picture with which a teaching that was cut off may go on: `first` or a later one of the
// drive, taken where `last`, its last segment, ended. Errors: kInvalidArgument for another camera
// or other odometry than it was taught with, or a drive that did not come by there; kUnavailable
// when `stop` says so first; the device's.
[[nodiscard]] Result<Observation> FindWhereItEnded(RobotDevice& device, Observation first,
                                                   const route::RouteInfo& cut_off,
                                                   const route::Segment& last,
                                                   const vision::IntakeOptions& intake,
                                                   const std::function<bool()>& stop);

}  // namespace trailcast::agent
