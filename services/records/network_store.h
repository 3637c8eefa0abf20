#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "services/base/ids.h"
#include "services/base/result.h"
#include "services/network/words.h"
#include "services/route/route.h"

namespace trailcast::store {

struct OwnDatabase;

// A joint that was found, and what an operator said of it.
struct ProposedJoint {
  enum class Verdict : std::uint8_t { kNone = 0, kRefused = 1, kTaken = 2 };
  network::Proposal proposal{};
  Verdict verdict = Verdict::kNone;
  double length_m = 0.0;  // of what the routes share there; 0: not known
  bool operator==(const ProposedJoint&) const = default;
};

// A narrow place, and who has it.
struct KeptLane {
  std::int64_t number = 0;
  network::Lane lane{};
  std::set<AgentId> holders{};
};

// How a stretch of a revision was followed: how often robots came over it, and lost their path
// there, as it counts at a time.
struct FollowedStretch {
  route::RouteKey key{};
  std::int64_t number = 0;  // along the route
  double passed = 0.0;
  double lost = 0.0;
  std::int64_t at_unix_ms = 0;
  bool operator==(const FollowedStretch&) const = default;
};

// How routes are joined, what holds on parts of them and what places are called, as operators said,
// which joints are proposed to them, who has which narrow place, and how stretches were followed: a
// SQLite file of its own, created if missing. What a call has stored is on the disk when it
// returns. Which routes places and conditions name is the caller's affair. Errors name the file:
// kUnavailable (disk full, no such folder, too many), kConflict (another process has it open),
// kCorrupt (no such file of ours, or a damaged one).
class NetworkStore {
 public:
  static constexpr std::int64_t kMostJoints = 100'000;
  static constexpr std::int64_t kMostConditions = 10'000;
  static constexpr std::int64_t kMostNames = 10'000;
  static constexpr std::int64_t kMostProposals = 20'000;
  static constexpr std::int64_t kMostLaneParts = 10'000;
  static constexpr std::int64_t kMostHolders = 10'000;
  static constexpr std::int64_t kMostFollowed = 50'000;

  [[nodiscard]] static Result<std::unique_ptr<NetworkStore>> Open(
      const std::filesystem::path& file);
  ~NetworkStore();
  NetworkStore(const NetworkStore&) = delete;
  NetworkStore& operator=(const NetworkStore&) = delete;

  // In the order in which they were put.
  [[nodiscard]] Result<std::vector<network::Joint>> Joints();
  // What is driven backwards after the others.
  [[nodiscard]] Result<std::vector<network::Condition>> Conditions();
  [[nodiscard]] Result<std::vector<network::NamedPlace>> Names();  // by name
  [[nodiscard]] Result<std::vector<ProposedJoint>> Proposals();
  // Revisions whose joints were looked for.
  [[nodiscard]] Result<std::vector<std::string>> Searched();
  [[nodiscard]] Result<std::vector<KeptLane>> Lanes();
  [[nodiscard]] Result<std::vector<FollowedStretch>> Followed();  // the oldest first

  // In place of that from and to the same places. `by`: who said so, and when by the caller's
  // clock.
  [[nodiscard]] Result<void> Put(const network::Joint& joint, const std::string& by,
                                 std::int64_t now_unix_ms);
  // That from and to just these places, if there is one.
  [[nodiscard]] Result<void> Drop(const network::Joint& joint);
  // All there are of this route.
  [[nodiscard]] Result<void> Replace(const std::string& route,
                                     const std::vector<network::Condition>& conditions,
                                     const std::string& by, std::int64_t now_unix_ms);
  // In place of what was called so.
  [[nodiscard]] Result<void> Put(const network::NamedPlace& named, const std::string& by,
                                 std::int64_t now_unix_ms);
  // What is called so, if anything is.
  [[nodiscard]] Result<void> Forget(const std::string& name);
  // In place of those from and to the same places; what is taken becomes a joint. All or nothing.
  [[nodiscard]] Result<void> Put(std::span<const ProposedJoint> proposed, const std::string& by,
                                 std::int64_t now_unix_ms);
  [[nodiscard]] Result<void> MarkSearched(std::span<const std::string> revisions);
  // One more; its number.
  [[nodiscard]] Result<std::int64_t> Put(const network::Lane& lane, const std::string& by,
                                         std::int64_t now_unix_ms);
  [[nodiscard]] Result<void> DropLane(std::int64_t number);
  // All or nothing.
  [[nodiscard]] Result<void> Hold(std::span<const std::int64_t> lanes, const AgentId& agent);
  [[nodiscard]] Result<void> Release(std::span<const std::int64_t> lanes, const AgentId& agent);
  // In place of what is kept of the same. All or nothing; of more than kMostFollowed the oldest go.
  [[nodiscard]] Result<void> Put(std::span<const FollowedStretch> followed);
  // The revision is there no more: no more of its proposals either.
  [[nodiscard]] Result<void> DropProposals(const std::string& revision);

 private:
  explicit NetworkStore(std::unique_ptr<OwnDatabase> database);
  std::unique_ptr<OwnDatabase> database_;
};

}  // namespace trailcast::store
