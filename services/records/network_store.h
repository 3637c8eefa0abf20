#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
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

// A junction that was found, and an operator's verdict on it.
struct ProposedJunction {
  enum class Verdict : std::uint8_t { kNone = 0, kRefused = 1, kTaken = 2 };
  network::Proposal proposal{};
  Verdict verdict = Verdict::kNone;
  double length_m = 0.0;  // metres that the routes share there; 0 if not known
  bool operator==(const ProposedJunction&) const = default;
};

// A mutex zone and the robot that holds it.
struct KeptLane {
  std::int64_t number = 0;
  network::Lane lane{};
  std::set<AgentId> holders{};
};

// How often robots passed a section of a revision and lost their path there, weighed for a moment.
struct FollowedSection {
  route::RouteKey key{};
  std::int64_t number = 0;  // its position along the route
  double passed = 0.0;
  double lost = 0.0;
  std::int64_t at_unix_ms = 0;
  bool operator==(const FollowedSection&) const = default;
};

// Keeps the network in a SQLite file of its own, created if missing: junctions, conditions on
// sections and names of places as operators set them, proposed junctions, holders of mutex zones,
// robots at docks, when robots charge, and how sections were followed. A call's data is on the disk
// when it returns. The caller decides which routes places and conditions name. Errors name the
// file: kUnavailable (disk full, no such folder, too many), kConflict (another process has it
// open), kCorrupt (not our file, or a damaged one).
class NetworkStore {
 public:
  static constexpr std::int64_t kMostJunctions = 100'000;
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

  // Returns junctions in the order in which they were put.
  [[nodiscard]] Result<std::vector<network::Junction>> Junctions();
  // Conditions for driving backwards come last.
  [[nodiscard]] Result<std::vector<network::Condition>> Conditions();
  [[nodiscard]] Result<std::vector<network::NamedPlace>> Names();  // by name
  [[nodiscard]] Result<std::vector<ProposedJunction>> Proposals();
  // Returns the revisions that were searched for junctions.
  [[nodiscard]] Result<std::vector<std::string>> Searched();
  [[nodiscard]] Result<std::vector<KeptLane>> Lanes();
  [[nodiscard]] Result<std::vector<FollowedSection>> Followed();  // the oldest first
  // Returns the robots that are at each dock, or on their way there, by its name.
  [[nodiscard]] Result<std::map<std::string, std::set<AgentId>>> DockHolders();
  // Returns when robots charge, or nothing if they are not sent to.
  [[nodiscard]] Result<std::optional<network::ChargeLimits>> Charge();

  // Replaces the junction from and to the same places. `by` says who decided it; the time is by the
  // caller's clock.
  [[nodiscard]] Result<void> Put(const network::Junction& junction, const std::string& by,
                                 std::int64_t now_unix_ms);
  // Drops the junction from and to exactly these places, if there is one.
  [[nodiscard]] Result<void> Drop(const network::Junction& junction);
  // Replaces all conditions of this route.
  [[nodiscard]] Result<void> Replace(const std::string& route,
                                     const std::vector<network::Condition>& conditions,
                                     const std::string& by, std::int64_t now_unix_ms);
  // Replaces the place of that name.
  [[nodiscard]] Result<void> Put(const network::NamedPlace& named, const std::string& by,
                                 std::int64_t now_unix_ms);
  // Drops the place of that name, if there is one.
  [[nodiscard]] Result<void> Forget(const std::string& name);
  // Replaces proposals from and to the same places. One that is taken becomes a junction. All or
  // nothing is put.
  [[nodiscard]] Result<void> Put(std::span<const ProposedJunction> proposed, const std::string& by,
                                 std::int64_t now_unix_ms);
  [[nodiscard]] Result<void> MarkSearched(std::span<const std::string> revisions);
  [[nodiscard]] Result<void> HoldDock(const std::string& name, const std::set<AgentId>& holders);
  [[nodiscard]] Result<void> Put(const std::optional<network::ChargeLimits>& charge);
  // Adds a mutex zone and returns its number.
  [[nodiscard]] Result<std::int64_t> Put(const network::Lane& lane, const std::string& by,
                                         std::int64_t now_unix_ms);
  [[nodiscard]] Result<void> DropLane(std::int64_t number);
  // Both change all or nothing.
  [[nodiscard]] Result<void> Hold(std::span<const std::int64_t> lanes, const AgentId& agent);
  [[nodiscard]] Result<void> Release(std::span<const std::int64_t> lanes, const AgentId& agent);
  // Replaces what is kept of the same sections, all or nothing. Beyond kMostFollowed the oldest are
  // deleted.
  [[nodiscard]] Result<void> Put(std::span<const FollowedSection> followed);
  // Drops the proposals of a revision that has left the store.
  [[nodiscard]] Result<void> DropProposals(const std::string& revision);

 private:
  explicit NetworkStore(std::unique_ptr<OwnDatabase> database);
  std::unique_ptr<OwnDatabase> database_;
};

}  // namespace trailcast::store
