#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <variant>

#include "agent/device/device.h"
#include "agent/diagnosis/snapshot_view.h"
#include "agent/link/snapshot_handler.h"
#include "services/base/mailbox.h"
#include "services/exchange/route_exchange.h"

namespace trailcast::agent {

// Lets people look through the robot's camera. The driving thread hands over a copy of a frame when
// one is wanted, and never waits. A thread of this object, with a low priority, draws on it and
// encodes it. The thread that owns the exchange takes requests and answers them.
class Snapshots {
 public:
  // A picture is encoded more and more coarsely until it is no larger.
  static constexpr std::size_t kMostBytes = 12U << 10U;

  explicit Snapshots(AgentId self);
  ~Snapshots();
  Snapshots(const Snapshots&) = delete;
  Snapshots& operator=(const Snapshots&) = delete;

  // Returns the same exchange, or null. Requests for snapshots are served while messages are taken
  // from it. This object must outlive it.
  [[nodiscard]] std::unique_ptr<exchange::RouteExchange> Through(
      std::unique_ptr<exchange::RouteExchange> exchange);

  // Returns true once for each picture that is wanted. The driving thread calls it.
  [[nodiscard]] bool wanted() { return wanted_.load(std::memory_order_relaxed) && TakeWanted(); }
  void Show(SnapshotFrame frame) { HandOver(std::move(frame)); }
  // Serves a robot that does not drive.
  void ShowIfWanted(RobotDevice& device);

 private:
  class Visitor;
  using Item = std::variant<std::monostate, SnapshotFrame, std::string>;
  using Time = SnapshotHandler::Time;

  [[nodiscard]] bool TakeWanted() { return wanted_.exchange(false); }
  void HandOver(Item item);
  void Serve(exchange::RouteExchange& exchange, Time now);
  void Paint();
  [[nodiscard]] CameraPicture Painted(const Item& item);
  [[nodiscard]] CameraPicture Encode(const SnapshotFrame& frame);

  SnapshotHandler handler_;  // for the exchange's thread

  std::atomic<bool> wanted_{false};
  Mailbox<Item> frames_{2};
  Mailbox<CameraPicture> pictures_{2};
  Bell handed_over_;

  int quality_;  // for the painting thread, as the next member
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace trailcast::agent
