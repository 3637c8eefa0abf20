#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "services/base/result.h"
#include "services/base/work_folder.h"
#include "services/fleet/operator_peer.h"
#include "services/fleet/routes/transfer.h"

namespace trailcast::console {

// This transfers routes as files: fetched from servers to be downloaded, or uploaded to be
// delivered. Each has a thread and a network member of its own, so that nothing else waits for it.
// It may be used from any thread.
class Transfers {
 public:
  using Join = std::function<Result<fleet::OperatorPeer>(const exchange::TopicUse&)>;
  static constexpr std::size_t kMostAtOnce = 2;
  static constexpr std::size_t kMostKept = 6;  // including the files of those that have ended
  static constexpr std::uint64_t kMostUploadBytes = 256U << 20U;

  enum class State : std::uint8_t { kUnderWay, kDone, kFailed };
  struct Progress {
    std::string id;
    bool is_upload = false;
    State state = State::kUnderWay;
    std::string route{};  // its name, once it is known
    std::uint32_t revision = 0;
    std::uint64_t done_bytes = 0;
    std::uint64_t total_bytes = 0;
    std::string detail{};  // for people
  };

  // `join` gives a transfer its member of the network, and `timeout` is how long a server may be
  // silent.
  explicit Transfers(Join join,
                     std::chrono::milliseconds timeout = std::chrono::milliseconds(10'000));
  // Ends those that are under way, and removes their files.
  ~Transfers();
  Transfers(const Transfers&) = delete;
  Transfers& operator=(const Transfers&) = delete;

  // Fetches a complete revision. Fails with kUnavailable if too many are under way.
  [[nodiscard]] Result<Progress> Fetch(const route::RouteInfo& info);
  // This is a file that is being uploaded. It is to be written to `path`, and then delivered or
  // given up.
  struct Upload {
    std::string id;
    std::filesystem::path path;
  };
  [[nodiscard]] Result<Upload> BeginUpload(std::uint64_t bytes);
  [[nodiscard]] Progress Deliver(const std::string& id);
  void GiveUp(const std::string& id);

  // Fails with kNotFound if there is no such transfer, or no longer.
  [[nodiscard]] Result<Progress> Find(const std::string& id);
  // This is the file of a transfer that was fetched.
  struct File {
    std::filesystem::path path;
    std::string name;  // for a person's folder
  };
  [[nodiscard]] Result<File> FileOf(const std::string& id);

 private:
  struct Job {
    Progress progress;
    std::filesystem::path path;
    std::thread thread;
  };

  using Work = std::function<Result<std::string>(Job&, const fleet::TransferWatch&)>;

  [[nodiscard]] Result<Job*> MakeRoom();  // callers hold mutex_
  void Start(Job& job, Work work);
  [[nodiscard]] Result<std::string> FetchTo(Job& job, const route::RouteInfo& info,
                                            const fleet::TransferWatch& watch);
  [[nodiscard]] Result<std::string> DeliverFrom(Job& job, const fleet::TransferWatch& watch);
  void End(Job& job, const Result<std::string>& result);

  const Join join_;
  const std::chrono::milliseconds timeout_;
  const Result<WorkFolder> folder_ = WorkFolder::Make();
  std::atomic<bool> over_{false};
  std::mutex mutex_;  // guards what follows except a job's path
  std::map<std::string, std::unique_ptr<Job>> jobs_;
  std::deque<std::string> order_;  // the oldest first
};

}  // namespace trailcast::console
