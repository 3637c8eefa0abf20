#include "agent/link/scout_link.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "agent/link/src/held_revisions.h"
#include "services/base/guarded.h"
#include "services/base/text.h"
#include "services/base/time.h"
#include "services/exchange/bounds.h"
#include "services/exchange/publish.h"

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kWait{20};
// A server answers well within this; otherwise people are told that none does.
constexpr milliseconds kServerPatience{3000};
constexpr milliseconds kServerAsksWithin{1500};
// The first segments show that teaching works. After them one now and then shows that it goes on.
constexpr std::uint32_t kFirstTold = 5;
constexpr std::uint32_t kThenTold = 20;

spdlog::level::level_enum LevelOf(SegmentIndex index, SegmentIndex first) {
  const bool told = index.value() < first.value() + kFirstTold || index.value() % kThenTold == 0;
  return told ? spdlog::level::info : spdlog::level::debug;
}

// An agent that waits for missions also follows, and operators command it.
exchange::AgentStatus ScoutStatus(const ScoutLinkOptions& options) {
  exchange::AgentStatus status;
  status.agent = options.agent;
  status.instance = options.instance;
  status.role =
      options.instance != 0 ? exchange::AgentRole::kFollower : exchange::AgentRole::kScout;
  return status;
}

}  // namespace

ScoutLink::ScoutLink(ScoutLinkOptions options, std::unique_ptr<store::RouteStore> store,
                     std::unique_ptr<exchange::RouteExchange> exchange)
    : options_(std::move(options)),
      store_(std::move(store)),
      exchange_(std::move(exchange)),
      outbox_(options_.agent, *store_) {
  if (!exchange_) return;
  presence_.emplace(*exchange_, ScoutStatus(options_));
  presence_->FeelBy(options_.vitals);
}

ScoutLink::~ScoutLink() {
  if (!thread_.joinable()) return;
  options_.delivery_timeout = milliseconds{0};
  if (auto outcome = Finish(); !outcome) spdlog::error("{}", outcome.error().message);
}

Result<void> ScoutLink::Open() {
  opened_ = steady_clock::now();
  if (!exchange_) return {};
  auto notes = outbox_.LoadBacklog();
  if (!notes) return tl::unexpected(notes.error());
  for (const std::string& note : *notes) spdlog::info("{}", note);
  if (auto told = TellHeld(); !told) return told;
  if (options_.instance != 0) return {};
  const auto handle = [this](const exchange::Message& message) {
    outbox_.Handle(message, steady_clock::now());
  };
  return presence_->Claim(handle, options_.stop);
}

Result<void> ScoutLink::Start(std::optional<route::RouteInfo> route) {
  if (route) {
    if (auto assigned = Assign(*route); !assigned) return assigned;
    planned_ = std::move(route);
  }
  thread_ = std::thread([this] { Run(); });
  return {};
}

Result<void> ScoutLink::StartFrom(const route::RouteInfo& cut_off) {
  if (auto goes_on = GoOn(cut_off); !goes_on) return goes_on;
  thread_ = std::thread([this] { Run(); });
  return {};
}

bool ScoutLink::Offer(route::Segment segment) { return Put({std::move(segment), {}}); }

bool ScoutLink::BeginAnew(int width_px, int height_px) {
  return Put({{}, Offered::Anew{width_px, height_px}});
}

bool ScoutLink::Put(Offered offered) {
  if (failed()) return false;
  const bool put = offered_.TryPut(std::make_unique<Offered>(std::move(offered)));
  bell_.Ring();
  return put;
}

void ScoutLink::Report(const TeachingNow& now) {
  // If the queue is full, the thread is busy with the disk and will get a newer report.
  [[maybe_unused]] const bool put = reports_.TryPut(TeachingNow(now));
}

Result<ScoutLink::Outcome> ScoutLink::Finish(Ending ending) {
  how_ = ending;
  ending_ = true;
  bell_.Ring();
  if (thread_.joinable()) thread_.join();
  if (error_) return tl::unexpected(*error_);
  Outcome outcome;
  if (key_) outcome.route = outbox_.info(*key_);
  if (key_) outcome.standing = outbox_.standing(*key_);
  outcome.unreceipted = outbox_.unreceipted();
  outcome.delivered = outbox_.Done();
  outcome.refusal = outbox_.refusal();
  for (const route::RouteInfo& info : outbox_.Receipted()) {
    const auto standing = outbox_.standing(info.key);
    if (info.key != key_ && standing) outcome.earlier.emplace_back(info, *standing);
  }
  return outcome;
}

void ScoutLink::Close(exchange::AgentMode mode, const std::string& detail) {
  if (!presence_) return;
  ShowStatus(mode, detail);
  presence_->Publish();
}

void ScoutLink::Run() {
  const auto result =
      Guarded("the thread that stores and sends the route", [this] { return Work(); });
  if (!result) {
    error_ = result.error();
    failed_ = true;
  }
}

Result<void> ScoutLink::Work() {
  Result<void> result;
  while (result && !ending_.load()) result = Step();
  if (result) result = StoreOffered();
  if (result && key_) result = End();
  if (result) result = TellHeld();
  if (result && exchange_) result = Deliver();
  return result;
}

Result<void> ScoutLink::End() {
  if (how_ == Ending::kDiscard) return DiscardTaught();
  return outbox_.Complete(*key_, how_ != Ending::kComplete);
}

Result<void> ScoutLink::DiscardTaught() {
  if (auto ended = outbox_.Complete(*key_, /*cut_off=*/true); !ended) return ended;
  const route::RouteInfo taught = outbox_.info(*key_);
  key_.reset();
  return Discard(taught);
}

Result<void> ScoutLink::Begin(const Offered::Anew& anew) {
  if (key_) {
    if (auto discarded = DiscardTaught(); !discarded) return discarded;
    planned_->key.teaching = MakeTeachingId();
    if (auto numbered = Number(*planned_); !numbered) return numbered;
  }
  planned_->image_width_px = anew.width_px;
  planned_->image_height_px = anew.height_px;
  return {};
}

Result<void> ScoutLink::TellHeld() {
  auto held = HeldRevisions(*store_);
  if (!held) return tl::unexpected(held.error());
  held_revisions_ = std::move(*held);
  return {};
}

Result<void> ScoutLink::Step() {
  if (auto stored = StoreOffered(); !stored) return stored;
  if (!exchange_) {
    bell_.Wait(milliseconds(200));
    return {};
  }
  ShowStatus(exchange::AgentMode::kTeaching, told_remark_);
  return Trade();
}

Result<void> ScoutLink::StoreOffered() {
  while (const auto taken = offered_.TryGet()) {
    const Offered& offered = **taken;
    if (offered.anew) {
      if (auto begun = Begin(*offered.anew); !begun) return begun;
      continue;
    }
    const route::Segment& segment = *offered.segment;
    if (!key_) {
      if (auto begun = outbox_.Begin(*planned_); !begun) return begun;
      key_ = planned_->key;
    }
    if (auto added = outbox_.Add(*key_, segment); !added) return added;
    const route::RouteInfo& info = outbox_.info(*key_);
    spdlog::log(LevelOf(segment.index, first_index()),
                "segment {} of '{}': {} features; {:.2f} m and {} bytes so far",
                segment.index.value(), info.name, segment.features.size(), info.length_m,
                info.bytes);
  }
  while (auto report = reports_.TryGet()) latest_ = *report;
  return {};
}

Result<void> ScoutLink::Trade() {
  for (const exchange::Message& message : exchange_->Take(kWait)) {
    presence_->Handle(message);
    outbox_.Handle(message, steady_clock::now());
  }
  const auto now = steady_clock::now();
  const auto told = [this, now](const exchange::Message& message, bool sent) {
    if (!sent) outbox_.NotSent(message, now);
  };
  if (auto sent = exchange::PublishAll(*exchange_, outbox_.Tick(now), told); !sent) {
    spdlog::debug("{}", sent.error().message);
  }
  for (const Error& error : outbox_.TakeReadErrors()) {
    spdlog::error("cannot send: {}", error.message);
  }
  presence_->Tick(now);
  HearServer();
  HearRefusal();
  HearRemark();
  return outbox_.SaveReceipts();
}

Result<void> ScoutLink::Deliver() {
  const auto began = steady_clock::now();
  if (!outbox_.Done()) {
    spdlog::info("waiting for a server's acknowledgement of {} segments (at most {:.0f} s)",
                 outbox_.unreceipted(), Seconds(options_.delivery_timeout));
  }
  while (!outbox_.Done() || !HasAsked()) {
    if (how_ == Ending::kDiscard && !presence_->server()) return {};
    const auto bound = options_.stop() ? std::min(options_.delivery_timeout_when_stopped,
                                                  options_.delivery_timeout)
                                       : options_.delivery_timeout;
    if (steady_clock::now() - began > bound) return {};
    ShowStatus(exchange::AgentMode::kWaiting,
               fmt::format("{} for the acknowledgement of {} segments",
                           presence_->server() ? "waiting" : "no server heard: waiting",
                           outbox_.unreceipted()));
    if (auto traded = Trade(); !traded) return traded;
  }
  return {};
}

// A server that lost acknowledged segments soon asks for what this agent says it holds. An agent
// that teaches has been there long enough.
bool ScoutLink::HasAsked() const {
  if (planned_) return true;
  const auto now = steady_clock::now();
  return server_heard_at_ ? now - *server_heard_at_ > kServerAsksWithin
                          : now - opened_ > kServerPatience;
}

void ScoutLink::HearServer() {
  const auto& server = presence_->server();
  if (server && server != told_server_) {
    spdlog::info("server '{}' is there", server->value());
    told_server_ = server;
    server_heard_at_ = steady_clock::now();
  } else if (!server && told_server_) {
    spdlog::warn("server '{}' is gone: segments are kept in {} until one confirms them",
                 told_server_->value(), options_.store_file);
    told_server_.reset();
    told_no_server_ = true;
  } else if (!server && !told_no_server_ && steady_clock::now() - opened_ > kServerPatience) {
    spdlog::warn("no server heard yet: segments are kept in {} until one confirms them",
                 options_.store_file);
    told_no_server_ = true;
  }
}

void ScoutLink::HearRefusal() {
  auto refusal = outbox_.refusal();
  if (refusal == told_refusal_) return;
  told_refusal_ = std::move(refusal);
  if (told_refusal_) {
    spdlog::warn("{}; this agent's copy stays in {}", *told_refusal_, options_.store_file);
  } else {
    spdlog::info("the server takes segments again");
  }
}

// Remarks are told at once, while operators can still have the route driven differently.
void ScoutLink::HearRemark() {
  if (!key_ || outbox_.remark(*key_) == told_remark_) return;
  told_remark_ = outbox_.remark(*key_);
  if (!told_remark_.empty()) {
    spdlog::info("what is being taught {}", PlainText(told_remark_, exchange::kMaxLineBytes));
  }
}

void ScoutLink::ShowStatus(exchange::AgentMode mode, const std::string& detail) {
  exchange::AgentStatus status;
  status.mode = mode;
  if (planned_) status.route = planned_->name;
  if (key_) {
    const route::RouteInfo& info = outbox_.info(*key_);
    status.segments = info.segment_count;
    status.segment = info.segment_count;
    const double along_m = std::max(info.length_m, planned_->length_m + latest_.along_m);
    if (options_.instance != 0) status.place = {*key_, along_m, 0.0, 0.0};
  }
  const bool driving = mode == exchange::AgentMode::kTeaching;
  status.progress = driving ? latest_.drive_progress.value_or(0.0) : 1.0;
  status.speed_mps = driving ? latest_.speed_mps : 0.0;
  status.features = driving ? static_cast<std::uint32_t>(std::max(0, latest_.features)) : 0U;
  status.backlog = static_cast<std::uint32_t>(outbox_.unreceipted());
  const bool stands = driving && !latest_.stands.empty();
  status.detail =
      PlainText(stands ? latest_.stands : told_refusal_.value_or(detail), exchange::kMaxLineBytes);
  status.held = held_revisions_;
  options_.besides(status);
  presence_->Set(std::move(status));
}

}  // namespace trailcast::agent
