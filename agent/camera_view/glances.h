#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <variant>

#include "agent/device/device.h"
#include "agent/diagnosis/glance_view.h"
#include "agent/link/glance_desk.h"
#include "services/base/mailbox.h"
#include "services/exchange/route_exchange.h"

namespace trailcast::agent {

// Lets people look through the robot's camera. The thread that drives hands over a copy of a frame
// when one is wanted, and waits for nothing; one of this object's own, which gives way to others,
// draws and encodes it; the one that owns the exchange hears who asks, and answers.
class Glances {
 public:
  // A picture is encoded ever more coarsely until it has no more bytes.
  static constexpr std::size_t kMostBytes = 12U << 10U;

  explicit Glances(AgentId self);
  ~Glances();
  Glances(const Glances&) = delete;
  Glances& operator=(const Glances&) = delete;

  // The same exchange, or null; while messages are taken from it, glances are served. This outlives
  // it.
  [[nodiscard]] std::unique_ptr<exchange::RouteExchange> Through(
      std::unique_ptr<exchange::RouteExchange> exchange);

  // The driving thread's. True once for each picture that is wanted.
  [[nodiscard]] bool wanted() { return wanted_.load(std::memory_order_relaxed) && TakeWanted(); }
  void Show(GlanceFrame frame) { HandOver(std::move(frame)); }
  // Of a robot that does not drive.
  void ShowIfWanted(RobotDevice& device);

 private:
  class Visitor;
  using Item = std::variant<std::monostate, GlanceFrame, std::string>;
  using Time = GlanceDesk::Time;

  [[nodiscard]] bool TakeWanted() { return wanted_.exchange(false); }
  void HandOver(Item item);
  void Serve(exchange::RouteExchange& exchange, Time now);
  void Paint();
  [[nodiscard]] CameraPicture Painted(const Item& item);
  [[nodiscard]] CameraPicture Encode(const GlanceFrame& frame);

  GlanceDesk desk_;  // the exchange's thread's

  std::atomic<bool> wanted_{false};
  Mailbox<Item> frames_{2};
  Mailbox<CameraPicture> pictures_{2};
  Bell handed_over_;

  int quality_;  // the painting thread's, as that
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace trailcast::agent
