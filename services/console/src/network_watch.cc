#include "services/console/network_watch.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace trailcast::console {
namespace {

// These limit a server's answer, which may never end.
constexpr std::size_t kMostLines = 200'000;
constexpr std::chrono::seconds kLongest{30};

}  // namespace

Result<NetworkAnswer> AskForNetwork(Desk& desk, const std::string& words) {
  const auto until = std::chrono::steady_clock::now() + kLongest;
  NetworkAnswer answer;
  std::uint32_t first = 0;
  while (true) {
    auto page = desk.Network(words, first);
    if (!page) return tl::unexpected(page.error());
    std::move(page->lines.begin(), page->lines.end(), std::back_inserter(answer.lines));
    if (page->next <= first) return answer;
    first = page->next;
    if (answer.lines.size() >= kMostLines || std::chrono::steady_clock::now() > until) {
      answer.whole = false;
      return answer;
    }
  }
}

NetworkWatch::Outcome NetworkWatch::Now() {
  std::unique_lock lock(mutex_);
  if (list_ && (asking_ || Clock::now() < fresh_until_)) return list_;
  if (asking_) {
    if (waiting_ >= kMostWaiting) {
      return Fail(ErrorCode::kUnavailable,
                  "others wait for the network already: try again in a moment");
    }
    ++waiting_;
    told_.wait(lock, [this] { return !asking_; });
    --waiting_;
    return *last_;
  }
  asking_ = true;
  const std::size_t changes = changes_;
  lock.unlock();
  const auto began = Clock::now();
  auto answer = AskForNetwork(desk_, "");
  Outcome outcome = std::move(answer).map([](const NetworkAnswer& all) {
    return std::make_shared<const NetworkList>(all.lines, all.whole);
  });
  const auto now = Clock::now();
  lock.lock();
  asking_ = false;
  if (outcome) {
    list_ = *outcome;
    const auto fresh = std::max<Clock::duration>(kFresh, kShare * (now - began));
    fresh_until_ = changes == changes_ ? now + fresh : now;
  }
  last_ = outcome;
  lock.unlock();
  told_.notify_all();
  return outcome;
}

void NetworkWatch::Changed() {
  const std::scoped_lock lock(mutex_);
  ++changes_;
  fresh_until_ = {};
}

}  // namespace trailcast::console
