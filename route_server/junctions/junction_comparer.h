#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "services/base/mailbox.h"
#include "services/base/result.h"
#include "services/junctions/find_junctions.h"

namespace trailcast::server {

// Compares routes view by view, on a thread of its own with a low priority.
class JunctionComparer {
 public:
  // The bound on processor time. The junctions found by then are the result.
  static constexpr double kMost_ms = 20'000.0;

  using Views = std::shared_ptr<const junctions::RouteViews>;
  struct Done {
    std::uint64_t number = 0;
    Result<std::vector<junctions::Junction>> junctions{};  // an error is a fault of the program
  };
  // `b` may be null, to compare `a` with itself.
  using Find = std::function<std::vector<junctions::Junction>(
      const Views& a, const Views& b, bool same_camera, const junctions::JunctionOptions& options)>;
  [[nodiscard]] static std::vector<junctions::Junction> FindAll(
      const Views& a, const Views& b, bool same_camera, const junctions::JunctionOptions& options);

  explicit JunctionComparer(Find find = FindAll);
  ~JunctionComparer();  // gives up a comparison that is running
  JunctionComparer(const JunctionComparer&) = delete;
  JunctionComparer& operator=(const JunctionComparer&) = delete;

  // Returns the number that the answer will have, or nothing while too many wait.
  [[nodiscard]] std::optional<std::uint64_t> TryPut(Views a, Views b, bool same_camera);
  [[nodiscard]] std::optional<Done> TryGet() { return done_.TryGet(); }

 private:
  struct Job {
    std::uint64_t number = 0;
    Views a{};
    Views b{};
    bool same_camera = false;
  };
  void Run();
  [[nodiscard]] Done Compare(const Job& job) const;

  const Find find_;
  std::uint64_t jobs_put_ = 0;
  Mailbox<Job> jobs_{4};
  Mailbox<Done> done_{8};
  Bell bell_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace trailcast::server
