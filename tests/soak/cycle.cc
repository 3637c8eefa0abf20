#include "tests/soak/cycle.h"

#include <fmt/format.h>

#include <utility>

#include "services/exchange/publish.h"
#include "services/store/route_store.h"
#include "tests/soak/verdict.h"
#include "tests/support/places.h"

namespace trailcast::soak {
namespace {

// Whatever goes wrong, by then each part of a cycle is over, also where robots that start over
// share their cores with other work.
constexpr std::chrono::seconds kPatience{600};
constexpr std::size_t kLive = 2;  // of cycles before: one retired, one to be deleted

}  // namespace

Cycle::Cycle(const Errand& errand, Fleet& fleet, Ledger& ledger, exchange::RouteExchange& exchange,
             std::vector<Retired>& live)
    : errand_(errand),
      fleet_(fleet),
      ledger_(ledger),
      exchange_(exchange),
      live_(live),
      deadline_(Clock::now() + kPatience),
      robots_left_(1 + static_cast<int>(fleet.followers().size())) {
  fleet_.Begin(errand_);
}

void Cycle::Go(Stage stage, Clock::time_point now) {
  stage_ = stage;
  deadline_ = now + kPatience;
  tool_.reset();
  tool_runs_ = 0;
}

void Cycle::Fail(const std::string& what) {
  outcome_.failures.push_back(fmt::format("{}: {}", errand_.route, what));
}

void Cycle::Handle(const exchange::Message& message, Clock::time_point now) {
  if (audit_) audit_->Handle(message, now);
}

void Cycle::Tick(Clock::time_point now) {
  switch (stage_) {
    case Stage::kDriving:
      return WatchRobots(now);
    case Stage::kAuditing:
      return WatchAudit(now);
    case Stage::kRetiring:
      if (live_.size() < 2) return Go(Stage::kDone, now);
      return Operate({"retire", live_[1].name}, Stage::kDeleting, now);
    case Stage::kDeleting:
      if (live_.size() <= kLive) return Go(Stage::kDone, now);
      ledger_.Forget(live_.back().key);
      Operate({"delete", live_.back().name, "--all-revisions"}, Stage::kDone, now);
      if (!done()) return;
      ledger_.NoteDeleted(live_.back().key);
      live_.pop_back();
      return;
    case Stage::kDone:
      return;
  }
}

void Cycle::WatchRobots(Clock::time_point now) {
  if (const auto status = fleet_.scout().TakeEnded()) {
    --robots_left_;
    if (*status != 0) {
      Fail(fmt::format("the scout ended with status {}:\n{}", *status, fleet_.scout().LastWords()));
    }
  }
  for (const auto& follower : fleet_.followers()) {
    if (const auto status = follower->TakeEnded()) NoteEnd(*follower, *status);
  }
  if (robots_left_ > 0 && now > deadline_) {
    std::vector<Member*> left = fleet_.Running(Role::kScout);
    for (Member* follower : fleet_.Running(Role::kFollower)) left.push_back(follower);
    for (Member* member : left) {
      Fail(fmt::format("{} is not done after {} s:\n{}", member->name(), kPatience.count(),
                       member->LastWords()));
      member->Kill();
    }
    robots_left_ = 0;
  }
  if (robots_left_ == 0) ReadTaught(now);
}

void Cycle::NoteEnd(const Member& follower, int status) {
  --robots_left_;
  const auto why =
      JudgeFollower(status, follower.LastWords(), errand_.route, fleet_.teaching_cut_off());
  if (!why) {
    Fail(fmt::format("{} {}", follower.name(), why.error().message));
  } else if (why->empty()) {
    ++outcome_.arrived;
  } else {
    outcome_.explained.push_back(fmt::format("{} on {}: {}", follower.name(), errand_.route, *why));
  }
}

void Cycle::ReadTaught(Clock::time_point now) {
  const auto store = store::OpenSqliteStore(fleet_.ScoutsStore());
  const auto routes = store ? (*store)->ListRoutes() : tl::unexpected(store.error());
  if (!routes || routes->size() != 1) {
    Fail("the scout's store has not one route");
    return Go(Stage::kDone, now);
  }
  const route::RouteKey key = routes->front().key;
  std::vector<route::SegmentPiece> taught;
  for (std::uint32_t i = 0; i < routes->front().segment_count; ++i) {
    auto piece = (*store)->ReadSegment(key, SegmentIndex(i));
    if (!piece) return Fail(piece.error().message), Go(Stage::kDone, now);
    taught.push_back(std::move(*piece));
  }
  outcome_.segments = taught.size();
  live_.insert(live_.begin(), {errand_.route, key});
  audit_.emplace(key, taught, now);
  ledger_.NoteTaught(key, std::move(taught));
  Go(Stage::kAuditing, now);
}

void Cycle::WatchAudit(Clock::time_point now) {
  const auto outgoing = audit_->Tick(now);
  // A request that cannot be sent is repeated.
  (void)exchange::PublishAll(exchange_, outgoing);
  const bool late = now > deadline_;
  if (!audit_->Complete() && !late) return;
  if (late) Fail("the server does not serve all of it");
  if (audit_->wrong() > 0) {
    Fail(fmt::format("{} segments are served otherwise than they were taught", audit_->wrong()));
  }
  audit_.reset();
  Go(Stage::kRetiring, now);
}

void Cycle::Operate(const std::vector<std::string>& words, Stage next, Clock::time_point now) {
  if (!tool_) {
    Words all{ProgramsDir() + "/trailcast", "--network-interface", "air", "routes"};
    all.insert(all.end(), words.begin(), words.end());
    tool_ = std::make_unique<test::Process>(all, errand_.folder / "tool.log");
    ++tool_runs_;
  }
  if (!tool_->Ended()) {
    if (now < deadline_) return;
    Fail(fmt::format("'trailcast routes {}' hangs: {}", words.front(), tool_->output()));
    tool_.reset();  // which ends it
    return Go(next, now);
  }
  const std::string output = tool_->output();
  const bool succeeded = tool_->Wait() == 0;
  // The answer to an earlier run may have been lost, not so its effect.
  const bool gone = tool_runs_ > 1 && output.find("there is no route") != std::string::npos;
  tool_.reset();
  if (succeeded || gone) return Go(next, now);
  if (now < deadline_) return;
  Fail(fmt::format("'trailcast routes {}' fails: {}", words.front(), output));
  Go(next, now);
}

}  // namespace trailcast::soak
