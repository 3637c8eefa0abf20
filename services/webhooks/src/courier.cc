#include "services/webhooks/courier.h"

#include <chrono>
#include <utility>

#include "services/base/durable_file.h"
#include "services/base/guarded.h"
#include "services/base/unix_time.h"
#include "services/program/json.h"

namespace trailcast::webhooks {

namespace fs = std::filesystem;
using program::Json;

namespace {

constexpr std::chrono::seconds kAnswerWithin{10};
constexpr std::size_t kMostBytes = 256U << 20U;
constexpr std::int64_t kMsPerSecond = 1000;

Result<Outbox::Kept> Load(const std::vector<Hook>& hooks, const fs::path& file) {
  auto text = ReadBoundedFile(file, kMostBytes);
  if (!text && text.error().code == ErrorCode::kNotFound) return Outbox::Kept{Outbox(hooks), {}};
  if (!text) return tl::unexpected(text.error());
  auto kept = Outbox::Read(hooks, *text);
  if (!kept) return Wrap(kept.error(), file.string());
  return kept;
}

bool IsGood(int status) { return status >= 200 && status < 300; }

}  // namespace

struct Courier::Seen {
  Json alerts;
  Json missions;
  bool operator==(const Seen&) const = default;
};

Result<std::unique_ptr<Courier>> Courier::Open(std::vector<Hook> hooks, const fs::path& file,
                                               Parts parts) {
  auto kept = Load(hooks, file);
  if (!kept) return tl::unexpected(kept.error());
  // Only its owner may read it: bodies tell where robots are.
  if (auto written = ReplaceFile(file, kept->outbox.Text(kept->seen), 0600); !written) {
    return tl::unexpected(written.error());
  }
  return std::unique_ptr<Courier>(
      new Courier(std::move(hooks), file, std::move(parts), *std::move(kept)));
}

Result<std::unique_ptr<Courier>> Courier::Open(std::vector<Hook> hooks, const fs::path& file,
                                               std::function<void(const std::string& line)> tell) {
  return Open(std::move(hooks), file,
              {.unix_ms = [] { return NowUnixMs(); },
               .post =
                   [](const Hook& hook, const auto& headers, const std::string& body) {
                     return http::Post(hook.to, headers, body, kAnswerWithin);
                   },
               .tell = std::move(tell)});
}

Courier::Courier(std::vector<Hook> hooks, fs::path file, Parts parts, Outbox::Kept kept)
    : hooks_(std::move(hooks)),
      file_(std::move(file)),
      parts_(std::move(parts)),
      outbox_(std::move(kept.outbox)),
      finder_(std::move(kept.seen)),
      waiting_count_(outbox_.waiting()),
      thread_([this] { Run(); }) {}

Courier::~Courier() {
  {
    const std::scoped_lock lock(mutex_);
    over_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Courier::Look(Json alerts, Json missions) {
  {
    const std::scoped_lock lock(mutex_);
    next_ = std::make_unique<Seen>(Seen{std::move(alerts), std::move(missions)});
  }
  changed_.notify_all();
}

void Courier::Run() {
  const auto done = Guarded("the thread that tells webhooks", [this]() -> Result<void> {
    Serve();
    return {};
  });
  if (!done) parts_.tell(fmt::format("hooks are told nothing any more: {}", done.error().message));
}

void Courier::Serve() {
  std::unique_lock lock(mutex_);
  while (true) {
    const auto due = outbox_.NextDue();
    const auto is_due = [&] { return over_ || next_ != nullptr; };
    if (!due) {
      changed_.wait(lock, is_due);
    } else if (const auto wait_ms = *due - parts_.unix_ms();
               wait_ms > 0 && wait_ms <= Outbox::kLongestWait_ms) {
      changed_.wait_for(lock, std::chrono::milliseconds(wait_ms), is_due);
    }
    std::unique_ptr<Seen> seen = std::exchange(next_, nullptr);
    const bool over = over_;
    lock.unlock();
    const std::int64_t now_ms = parts_.unix_ms();
    if (seen && !(last_ && *seen == *last_)) {
      for (const Event& event : finder_.Look(seen->alerts, seen->missions, now_ms)) {
        Add(event, now_ms);
      }
      last_ = std::move(seen);
      Keep();
    }
    if (over) return;
    if (const auto delivery = outbox_.Due(now_ms)) {
      Deliver(*delivery);
      Keep();
    }
    lock.lock();
  }
}

void Courier::Deliver(const Outbox::Delivery& delivery) {
  const Hook& hook = hooks_[delivery.hook];
  const std::int64_t now_ms = parts_.unix_ms();
  std::multimap<std::string, std::string> headers{{"Trailcast-Event", delivery.event.name},
                                                  {"Trailcast-Delivery", delivery.event.id}};
  if (!hook.secret.empty()) {
    headers.emplace("Trailcast-Signature",
                    SignatureOf(hook.secret, now_ms / kMsPerSecond, delivery.event.body));
  }
  const auto status = parts_.post(hook, headers, delivery.event.body);
  if (status && IsGood(*status)) {
    outbox_.Arrived(delivery);
    overflowing_.erase(delivery.hook);
    return;
  }
  const std::string why = status ? fmt::format("it answers {}", *status) : status.error().message;
  const bool again = outbox_.Failed(delivery, parts_.unix_ms());
  if (delivery.tries > 0 && again) return;
  parts_.tell(fmt::format("hook {} is not told of {}: {}: {}", hook.url, delivery.event.name, why,
                          again ? "it is tried again for a day" : "it is given up"));
}

void Courier::Add(const Event& event, std::int64_t now_ms) {
  for (const std::size_t hook : outbox_.Add(event, now_ms)) {
    if (!overflowing_.insert(hook).second) continue;
    parts_.tell(
        fmt::format("{} events wait for hook {}, and no more are kept: it is never told of the "
                    "oldest ones, from now on until it answers",
                    Outbox::kMostWaiting, hooks_[hook].url));
  }
}

void Courier::Measure(http::MetricsText& text) const {
  text.Add("webhook_events_waiting", "gauge", "Events that hooks still have to be told.",
           waiting_count_.load());
  text.Add("webhook_events_dropped_total", "counter",
           "Events that a hook was never told of, since too many waited or a day was over.",
           dropped_count_.load());
}

void Courier::Keep() {
  waiting_count_ = outbox_.waiting();
  dropped_count_ = outbox_.dropped();
  std::string text = outbox_.Text(finder_.Seen());
  if (text == kept_) return;
  const auto written = ReplaceFile(file_, text, 0600);
  kept_ = std::move(text);
  const std::string trouble = written ? std::string() : written.error().message;
  if (!trouble.empty() && trouble != trouble_) {
    parts_.tell("what hooks have to be told is not kept: " + trouble);
  }
  trouble_ = trouble;
}

}  // namespace trailcast::webhooks
