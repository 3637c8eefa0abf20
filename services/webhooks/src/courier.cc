#include "services/webhooks/courier.h"

#include <chrono>
#include <fstream>
#include <sstream>
#include <system_error>
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
constexpr std::uintmax_t kMostBytes = 256U << 20U;
constexpr std::int64_t kMsPerSecond = 1000;

Result<Outbox::Kept> Load(const std::vector<Hook>& hooks, const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) return Outbox::Kept{Outbox(hooks), {}};
  if (const auto size = fs::file_size(file, error); error || size > kMostBytes) {
    return Fail(ErrorCode::kCorrupt, "it is no file, or larger than {} bytes", kMostBytes);
  }
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return Outbox::Read(hooks, std::move(text).str());
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
  if (!kept) return Wrap(kept.error(), file.string());
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
        outbox_.Add(event, now_ms);
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
    return;
  }
  const std::string why = status ? fmt::format("it answers {}", *status) : status.error().message;
  const bool again = outbox_.Failed(delivery, parts_.unix_ms());
  if (delivery.tries > 0 && again) return;
  parts_.tell(fmt::format("hook {} is not told of {}: {}: {}", hook.url, delivery.event.name, why,
                          again ? "it is tried again for a day" : "it is given up"));
}

void Courier::Keep() {
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
