#include "services/console/atlas.h"

#include <algorithm>
#include <set>

#include "services/console/src/guarded_in_log.h"
#include "services/console/src/shape.h"
#include "services/exchange/bounds.h"
#include "services/exchange/route_finder.h"
#include "services/fleet/routes/catalog_client.h"
#include "services/fleet/routes/route_export.h"
#include "services/route/codec.h"
#include "services/route/labels.h"
#include "services/route/route_ref.h"

namespace trailcast::console {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kIdle{200};

}  // namespace

Atlas::Atlas(Join join, milliseconds reply_within)
    : join_(std::move(join)), reply_within_(reply_within), thread_([this] { Run(); }) {}

Atlas::~Atlas() {
  Close();
  thread_.join();
}

void Atlas::Close() {
  {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

bool Atlas::closed() {
  const std::scoped_lock lock(mutex_);
  return closed_;
}

const Atlas::Sheet* Atlas::Held(const Wanted& wanted) const {
  const Sheet* sheet = sheets_.Find(wanted);
  if (sheet == nullptr || !sheet->done) return sheet;
  // A teaching never changes, but the active one may be another.
  const bool lasts = sheet->shape && wanted.second;
  return lasts || Clock::now() < sheet->done_at + kAskAgain ? sheet : nullptr;
}

Result<Atlas::Found> Atlas::Find(const RouteId& route, std::optional<TeachingId> teaching,
                                 milliseconds most) {
  const Wanted wanted{route, teaching};
  std::unique_lock lock(mutex_);
  if (Held(wanted) == nullptr) {
    if (asked_.size() >= kMostAsked) {
      return Fail(ErrorCode::kUnavailable,
                  "too many routes are to be drawn: try again in a moment");
    }
    sheets_.Touch(wanted) = {};
    asked_.push_back(wanted);
    changed_.notify_all();
  }
  if (waiting_ < kMostWaiting) {
    ++waiting_;
    changed_.wait_for(lock, most, [&] {
      const Sheet* sheet = sheets_.Find(wanted);
      return closed_ || sheet == nullptr || sheet->done;
    });
    --waiting_;
  }
  const Sheet* sheet = sheets_.Find(wanted);
  if (sheet == nullptr) return Found{};  // others have taken its place
  if (!sheet->done) return Found{.fetched = sheet->fetched};
  if (!sheet->shape) return tl::unexpected(sheet->shape.error());
  Found found{.shape = *sheet->shape, .fetched = 1.0};
  (void)sheets_.Touch(wanted);
  return found;
}

std::optional<Atlas::Wanted> Atlas::Next(milliseconds most) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, most, [&] { return closed_ || !asked_.empty(); });
  if (closed_ || asked_.empty()) return std::nullopt;
  return asked_.front();
}

void Atlas::Run() {
  std::optional<fleet::OperatorPeer> peer;
  Clock::time_point used_at{};
  while (!closed()) {
    const auto wanted = Next(kIdle);
    if (!wanted) {
      // Taking messages keeps replies to other members from piling up.
      if (peer) (void)peer->exchange->Take(milliseconds(0));
      if (peer && Clock::now() > used_at + kLeaveAfter) peer.reset();
      continue;
    }
    auto shape = GuardedInLog("the thread that draws routes", [&] { return Draw(peer, *wanted); });
    used_at = Clock::now();
    {
      const std::scoped_lock lock(mutex_);
      asked_.pop_front();
      sheets_.Touch(*wanted) = {true, std::move(shape), 1.0, used_at};
    }
    changed_.notify_all();
  }
}

Atlas::Shape Atlas::Draw(std::optional<fleet::OperatorPeer>& peer, const Wanted& wanted) {
  if (!peer) {
    auto joined = join_();
    if (!joined) return Fail(ErrorCode::kUnavailable, "{}", joined.error().message);
    peer = std::move(*joined);
  }
  return Survey(*peer, wanted);
}

Result<route::RouteInfo> Atlas::Ask(fleet::OperatorPeer& peer, const Wanted& wanted) {
  const RouteId& route = wanted.first;
  const std::optional<TeachingId>& teaching = wanted.second;
  const auto reply = fleet::AskForRoutes(*peer.exchange, peer.self, {.name = route.value()},
                                         exchange::kMaxRoutesPerReply, reply_within_);
  if (!reply) return tl::unexpected(reply.error());
  std::vector<route::RouteInfo> of_it = reply->page.routes;
  std::erase_if(of_it, [&](const route::RouteInfo& info) {
    return info.key.route != route || (teaching && info.key.teaching != *teaching);
  });
  std::optional<route::RouteInfo> info;
  if (!teaching) {
    info = exchange::ChooseRoute(of_it);
  } else if (!of_it.empty()) {
    info = of_it.front();
  }
  if (!info && of_it.empty()) {
    return Fail(ErrorCode::kNotFound, "no server has this route, or this revision of it");
  }
  if (!info) {
    return tl::unexpected(exchange::NotMeant(fmt::format("server '{}'", reply->server.value()),
                                             of_it.front().name, of_it));
  }
  if (info->state == route::RouteState::kComplete) return *std::move(info);
  return Fail(ErrorCode::kConflict, "{} is still being taught: it is drawn when that has ended",
              route::Describe(*info));
}

Atlas::Shape Atlas::Survey(fleet::OperatorPeer& peer, const Wanted& wanted) {
  const auto info = Ask(peer, wanted);
  if (!info) return tl::unexpected(info.error());
  {
    const std::scoped_lock lock(mutex_);
    const Sheet* drawn = sheets_.Find({info->key.route, info->key.teaching});
    if (drawn != nullptr && drawn->done && drawn->shape) return drawn->shape;
  }
  ShapeMaker maker(info->image_width_px);
  fleet::TransferWatch watch;
  watch.stop = [this] { return closed(); };
  double segments = 0.0;
  const auto fetched = fleet::FetchInOrder(peer, *info, watch,
                                           [&](const route::SegmentPiece& piece) -> Result<void> {
                                             const auto segment = route::Decode(piece.bytes);
                                             if (!segment)
                                               return Wrap(segment.error(), route::Describe(*info));
                                             maker.Add(*segment);
                                             segments += 1.0;
                                             const std::scoped_lock lock(mutex_);
                                             if (Sheet* sheet = sheets_.Find(wanted))
                                               sheet->fetched = segments / info->segment_count;
                                             return {};
                                           });
  (void)peer.exchange->Listen(exchange::Topic::kSegments, {});
  if (!fetched) return tl::unexpected(fetched.error());
  auto body = std::make_shared<const std::string>(ShapeBody(info->key, maker.Shape()));
  if (!wanted.second) {
    const std::scoped_lock lock(mutex_);
    sheets_.Touch({info->key.route, info->key.teaching}) = {true, body, 1.0, Clock::now()};
  }
  return body;
}

}  // namespace trailcast::console
