#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "agent/device/device.h"
#include "agent/diagnosis/summary.h"
#include "agent/link/scout_link.h"
#include "agent/teach/hands.h"
#include "agent/teach/unfinished.h"
#include "services/vision/picture_intake.h"

namespace trailcast::agent {

class Glances;

struct ScoutOptions {
  std::string route;  // name
  ScoutLinkOptions link;
  std::vector<std::string> tags;      // in any order
  std::optional<route::Place> place;  // where the drive begins
  bool review = false;                // no robot is to follow it before an operator activates it
  Unfinished unfinished = Unfinished::kKeep;
  vision::IntakeOptions intake = {};
  Glances* glances = nullptr;  // for those who look through its camera; null: nobody does
};

// Teaches a route with what `device` sees until its drive is over or `options.link.stop` says so.
// `exchange` may be null: then the route is stored and not sent. The error says why no route, or
// only part of one, was taught, and what is kept where.
[[nodiscard]] Result<Summary> Teach(RobotDevice& device, const ScoutOptions& options,
                                    std::unique_ptr<store::RouteStore> store,
                                    std::unique_ptr<exchange::RouteExchange> exchange);

struct Taught {
  enum class End {
    kComplete,
    kDiscarded,    // as an operator has cancelled it
    kInterrupted,  // by `options.link.stop`: what was taught is kept, cut off
  };
  End end = End::kComplete;
  bool delivered = false;  // to a server; otherwise what is taught is in the store, for later
  std::string text{};      // one line for people: what was taught, and where it is
};

// The same of a robot whose drive operators end, and which is driven by `hands` where somebody
// does. A server is no condition: what none has confirmed in time stays in the store.
[[nodiscard]] Result<Taught> TeachByHand(RobotDevice& device, const ScoutOptions& options,
                                         Hands& hands, std::unique_ptr<store::RouteStore> store,
                                         std::unique_ptr<exchange::RouteExchange> exchange);

// Sends what earlier runs left without a receipt, and waits for the receipts.
[[nodiscard]] Result<Summary> DeliverBacklog(const ScoutLinkOptions& options,
                                             std::unique_ptr<store::RouteStore> store,
                                             std::unique_ptr<exchange::RouteExchange> exchange);

}  // namespace trailcast::agent
