#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "services/base/result.h"
#include "services/http/metrics_text.h"
#include "services/webhooks/outbox.h"

namespace trailcast::webhooks {

// Tells hooks of alerts and missions, on a thread of its own. It keeps what waits in a file, so
// that it is told after a restart, too; a hook may be told of one event twice.
class Courier {
 public:
  struct Parts {
    std::function<std::int64_t()> unix_ms;
    // Returns the status of the answer.
    std::function<Result<int>(const Hook& hook,
                              const std::multimap<std::string, std::string>& headers,
                              const std::string& body)>
        post;
    std::function<void(const std::string& line)> tell;  // for people, from the courier's thread
  };
  // Opens the file, which need not exist. kCorrupt if it has something else, kUnavailable if it
  // cannot be written.
  [[nodiscard]] static Result<std::unique_ptr<Courier>> Open(std::vector<Hook> hooks,
                                                             const std::filesystem::path& file,
                                                             Parts parts);
  // The same with the system's clock and HTTP.
  [[nodiscard]] static Result<std::unique_ptr<Courier>> Open(
      std::vector<Hook> hooks, const std::filesystem::path& file,
      std::function<void(const std::string& line)> tell);
  // Returns once a delivery that is under way has ended and what waits is on the disk.
  ~Courier();
  Courier(const Courier&) = delete;
  Courier& operator=(const Courier&) = delete;

  // Hands over what alerts and missions are there now, as openapi.yaml has them, and waits for
  // nothing. Only the latest is looked at.
  void Look(nlohmann::ordered_json alerts, nlohmann::ordered_json missions);
  // Adds how many events wait, and how many were dropped since the start.
  void Measure(http::MetricsText& text) const;

 private:
  struct Seen;
  Courier(std::vector<Hook> hooks, std::filesystem::path file, Parts parts, Outbox::Kept kept);
  void Run();
  void Serve();
  void Deliver(const Outbox::Delivery& delivery);
  void Add(const Event& event, std::int64_t now_ms);
  void Keep();

  const std::vector<Hook> hooks_;
  const std::filesystem::path file_;
  const Parts parts_;
  Outbox outbox_;  // the thread's own, as are those below
  EventFinder finder_;
  std::set<std::size_t> overflowing_;  // hooks, until one of their events arrives
  std::unique_ptr<Seen> last_;         // most looks show what the one before has shown
  std::string kept_;                   // the file's content
  std::string trouble_;                // as it was last told

  std::atomic<std::uint64_t> waiting_count_{0};  // of the outbox, for any thread
  std::atomic<std::uint64_t> dropped_count_{0};

  std::mutex mutex_;  // guards what follows
  bool over_ = false;
  std::unique_ptr<Seen> next_;
  std::condition_variable changed_;
  std::thread thread_;
};

}  // namespace trailcast::webhooks
