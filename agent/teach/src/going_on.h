#pragma once

#include <functional>

#include "agent/device/device.h"
#include "services/route/route.h"
#include "services/vision/picture_intake.h"

namespace trailcast::agent {

// Returns the first picture with which a teaching that was cut off may continue: `first` or a later
// one of the drive, taken where `last`, its last segment, ended. Errors: kInvalidArgument if camera
// or odometry differ from the earlier ones, or the drive did not pass there; kUnavailable if `stop`
// comes first; the device's.
[[nodiscard]] Result<Observation> FindWhereItEnded(RobotDevice& device, Observation first,
                                                   const route::RouteInfo& cut_off,
                                                   const route::Segment& last,
                                                   const vision::IntakeOptions& intake,
                                                   const std::function<bool()>& stop);

}  // namespace trailcast::agent
