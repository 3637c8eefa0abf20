#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "agent/device/device.h"
#include "agent/diagnosis/summary.h"
#include "agent/link/scout_link.h"
#include "agent/teach/teleoperation.h"
#include "agent/teach/unfinished.h"
#include "services/vision/picture_intake.h"

namespace trailcast::agent {

class Snapshots;

struct ScoutOptions {
  std::string route;  // name
  ScoutLinkOptions link;
  std::vector<std::string> tags;      // in any order
  std::optional<route::Place> place;  // where the drive begins
  bool review = false;                // no robot follows it before an operator activates it
  Unfinished unfinished = Unfinished::kKeep;
  vision::IntakeOptions intake = {};
  Snapshots* snapshots = nullptr;  // for people who look through its camera; may be null
};

// Teaches a route with what `device` sees until its drive is over or `options.link.stop` returns
// true. `exchange` may be null; the route is then stored but not sent. The error says why no route,
// or only part of one, was taught, and what is kept where.
[[nodiscard]] Result<Summary> Teach(RobotDevice& device, const ScoutOptions& options,
                                    std::unique_ptr<store::RouteStore> store,
                                    std::unique_ptr<exchange::RouteExchange> exchange);

struct Taught {
  enum class End {
    kComplete,
    kDiscarded,    // because an operator has cancelled it
    kInterrupted,  // by `options.link.stop`: the taught part is kept, cut off
  };
  End end = End::kComplete;
  bool delivered = false;  // a server has it; otherwise it is in the store, for later
  std::string text{};      // one line for people: what was taught, and where it is
};

// Does the same for a robot whose drive operators end, and whom they drive by `teleoperation` if
// they wish. It needs no server: segments that none has acknowledged in time stay in the store.
[[nodiscard]] Result<Taught> TeachByHand(RobotDevice& device, const ScoutOptions& options,
                                         Teleoperation& teleoperation,
                                         std::unique_ptr<store::RouteStore> store,
                                         std::unique_ptr<exchange::RouteExchange> exchange);

// Sends segments that earlier runs left without an acknowledgement, and waits for that.
[[nodiscard]] Result<Summary> DeliverBacklog(const ScoutLinkOptions& options,
                                             std::unique_ptr<store::RouteStore> store,
                                             std::unique_ptr<exchange::RouteExchange> exchange);

}  // namespace trailcast::agent
