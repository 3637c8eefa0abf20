#pragma once

#include <array>
#include <bitset>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "services/base/newest_map.h"
#include "services/exchange/messages.h"
#include "services/exchange/servers_there.h"
#include "services/store/route_store.h"

namespace trailcast::exchange {

struct MirrorOptions {
  std::chrono::milliseconds say_every{10'000};  // while other servers are present
  std::chrono::milliseconds say_at_most{1000};  // apart, while there is something to exchange
  std::chrono::milliseconds part_again{5000};   // before the same part is told in full once more
  std::chrono::milliseconds answered_within{3000};  // after a question for a route
  std::chrono::milliseconds stuck_after{10'000};    // for a route that was making progress
  std::chrono::milliseconds ask_again{20'000};  // for a route that did not come; doubles each time
  std::chrono::milliseconds ask_at_least{640'000};
  std::chrono::milliseconds look_every{1000};  // at one part of the store, whatever was noted
  std::size_t under_way = 16;                  // routes that are asked for at a time
  std::size_t most_wanted = 4096;
  std::size_t parts_at_once = 32;  // told in full after one comparison; below what writers keep
  std::size_t in_full = 256;       // routes; of more than these, parts are told
};

// The mirror makes servers that do not share a store hold the same routes, labels and tombstones,
// whatever they missed of each other. Each server tells from time to time a summary of what it
// holds, by how the routes' ids begin. Where two summaries differ, the servers tell each other that
// part in more detail, down to single routes, and each asks for those of which the other has
// something else. The RouteKeeper takes what is then announced and sent, and decides which of two
// labels counts. Routes are pulled, some at a time, so that a broken link costs only what was under
// way and the load on a link is bounded. It has no clock and no socket, and only reads the store.
class Mirror {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::size_t kParts = 256;  // by two more digits of the routes' ids

  // `store` has to outlive it.
  Mirror(AgentId self, store::RouteStore& store, MirrorOptions options = {})
      : self_(std::move(self)), store_(store), options_(options) {
    unread_.set();
  }

  // The owner calls this before the RouteKeeper handles the message.
  void Handle(const Message& message, Time now);
  [[nodiscard]] std::vector<Message> Tick(Time now);
  // Notes that the store has something new of the route.
  void NoteStored(const route::RouteKey& key);

  struct Other {
    bool there = true;
    // These parts of all routes differed when they were last compared.
    std::size_t differing = kParts;
    std::optional<Time> differs_since{};  // empty while both hold the same
    std::uint64_t compared = 0;           // number of comparisons
  };
  // Returns servers that tell what they hold. They stay, as absent ones, if
  // they go away without a word.
  [[nodiscard]] const std::map<AgentId, Other>& others() const { return others_; }
  [[nodiscard]] std::size_t under_way() const { return under_way_.size(); }
  [[nodiscard]] std::uint64_t asked() const { return asked_count_; }  // since the start

 private:
  struct Wanted {
    std::uint64_t theirs = 0;
    std::uint64_t ours = 0;  // 0 if there are none
    Time patient_until{};
  };
  struct Asked {
    std::uint64_t theirs = 0;
    Time next{};
    std::chrono::milliseconds wait{0};
  };
  using Parts = std::array<std::uint64_t, kParts>;

  void HandleSummary(const StoreSummary& summary, Time now);
  void HandleAnnouncement(const RouteAnnouncement& announcement, Time now);
  void NoteServers(const Message& message, Time now);
  void Compare(const StoreSummary& theirs, const Parts& ours, Time now);
  void CompareEntries(const StoreSummary& theirs, Time now);
  void Want(const route::RouteKey& key, std::uint64_t theirs, Time now);
  // Tells a part in more detail, unless that was just told.
  void Tell(const std::string& prefix, Time now);
  // Reads some of the unread parts. Returns false while there are more.
  [[nodiscard]] bool ReadParts();
  void See(Time now);
  void GiveUp(const route::RouteKey& key, const Wanted& wanted, Time now);
  [[nodiscard]] std::uint64_t OurDigest(const route::RouteKey& key);

  AgentId self_;
  store::RouteStore& store_;
  MirrorOptions options_;
  ServersThere servers_;
  std::map<AgentId, Other> others_;
  Parts parts_{};
  std::bitset<kParts> unread_;  // parts that are unread, or of which something was stored since
  std::size_t looked_at_ = 0;
  Time look_due_{};
  Time see_due_{};
  std::optional<Time> said_at_;
  bool say_soon_ = false;
  // This is the next part to compare of those that differ, which take turns.
  std::size_t first_compared_ = 0;
  std::map<route::RouteKey, std::uint64_t> wanted_;  // routes, with the others' digest of each
  std::map<route::RouteKey, Wanted> under_way_;
  NewestMap<route::RouteKey, Asked> asked_{4096};
  NewestMap<std::string, Time> told_{1024};  // parts
  std::vector<Message> out_;
  std::uint64_t asked_count_ = 0;
};

// Two servers hold the same of a revision if this digest is the same; 0 says that nothing is held.
[[nodiscard]] std::uint64_t MirrorDigest(const route::RouteInfo& info);

}  // namespace trailcast::exchange
