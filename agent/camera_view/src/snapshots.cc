#include "agent/camera_view/snapshots.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "services/base/give_way.h"
#include "services/base/guarded.h"
#include "services/image/files.h"

namespace trailcast::agent {
namespace {

using std::chrono::steady_clock;

constexpr std::chrono::hours kSnapshotWakeUp{1};  // unless something was handed over
constexpr int kBestQuality = 70;
constexpr int kWorstQuality = 10;
constexpr int kQualityStep = 10;
// A picture this small leaves room for a better quality the next time.
constexpr std::size_t kFewBytes = Snapshots::kMostBytes * 2 / 3;
constexpr int kNiceness = 10;

constexpr const char* kNoPicture = "no picture comes from its camera";

}  // namespace

class Snapshots::Visitor : public exchange::RouteExchange {
 public:
  Visitor(Snapshots& host, std::unique_ptr<exchange::RouteExchange> exchange)
      : host_(host), exchange_(std::move(exchange)) {}

  Result<void> Publish(const exchange::Message& message) override {
    return exchange_->Publish(message);
  }
  void Gather() override { exchange_->Gather(); }
  void Flush() override { exchange_->Flush(); }
  std::vector<exchange::Message> Take(std::chrono::milliseconds max_wait) override {
    auto messages = exchange_->Take(max_wait);
    const auto now = steady_clock::now();
    for (const exchange::Message& message : messages) host_.handler_.Handle(message, now);
    host_.Serve(*exchange_, now);
    return messages;
  }
  Result<void> Listen(exchange::Topic topic, const std::set<route::RouteKey>& routes) override {
    return exchange_->Listen(topic, routes);
  }
  [[nodiscard]] std::uint64_t dropped() const override { return exchange_->dropped(); }

 private:
  Snapshots& host_;
  std::unique_ptr<exchange::RouteExchange> exchange_;
};

Snapshots::Snapshots(AgentId self)
    : handler_(std::move(self)), quality_(kBestQuality), thread_([this] { Paint(); }) {}

Snapshots::~Snapshots() {
  ending_ = true;
  handed_over_.Ring();
  thread_.join();
}

std::unique_ptr<exchange::RouteExchange> Snapshots::Through(
    std::unique_ptr<exchange::RouteExchange> exchange) {
  if (!exchange) return nullptr;
  return std::make_unique<Visitor>(*this, std::move(exchange));
}

void Snapshots::ShowIfWanted(RobotDevice& device) {
  if (!wanted()) return;
  auto seen = device.Look();
  if (seen) {
    Show({.picture = *std::move(seen)});
  } else {
    HandOver(seen.error().message);
  }
}

void Snapshots::HandOver(Item item) {
  // If the queue is full, the frames before this one will do.
  (void)frames_.TryPut(std::move(item));
  handed_over_.Ring();
}

void Snapshots::Serve(exchange::RouteExchange& exchange, Time now) {
  std::optional<exchange::Snapshot> answer;
  while (auto picture = pictures_.TryGet()) {
    if (auto given = handler_.Give(*std::move(picture), now)) answer = std::move(given);
  }
  if (!answer && handler_.AskedInVain(now)) {
    wanted_ = false;
    answer = handler_.Give({.detail = kNoPicture}, now);
  }
  // An answer that cannot be sent is asked for again.
  if (answer) (void)exchange.Publish(*answer);
  if (handler_.Asks(now)) wanted_ = true;
}

void Snapshots::Paint() {
  GiveWay(kNiceness);
  while (!ending_) {
    handed_over_.Wait(kSnapshotWakeUp);
    while (auto item = frames_.TryGet()) {
      // A frame that cannot be drawn gives no picture, and the robot drives on.
      auto painted = Guarded("the thread that draws what the camera sees",
                             [&]() -> Result<CameraPicture> { return Painted(*item); });
      CameraPicture picture = painted.value_or(CameraPicture{.detail = kNoPicture});
      // If the queue is full, nobody takes the pictures and nobody waits for them.
      (void)pictures_.TryPut(std::move(picture));
    }
  }
}

CameraPicture Snapshots::Painted(const Item& item) {
  const auto* frame = std::get_if<SnapshotFrame>(&item);
  return frame != nullptr ? Encode(*frame) : CameraPicture{.detail = std::get<std::string>(item)};
}

CameraPicture Snapshots::Encode(const SnapshotFrame& frame) {
  const image::RgbImage drawn = DrawSnapshot(frame);
  auto jpeg = image::EncodeJpeg(drawn, quality_);
  while (jpeg && jpeg->size() > kMostBytes && quality_ > kWorstQuality) {
    quality_ = std::max(kWorstQuality, quality_ - kQualityStep);
    jpeg = image::EncodeJpeg(drawn, quality_);
  }
  if (!jpeg) return {.detail = kNoPicture};
  if (jpeg->size() < kFewBytes) quality_ = std::min(kBestQuality, quality_ + kQualityStep);
  return {.jpeg = *std::move(jpeg), .marked = frame.marked(), .detail = SnapshotText(frame)};
}

}  // namespace trailcast::agent
