#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "services/dds/dds_exchange.h"
#include "services/dds/src/arrivals.h"
#include "services/dds/src/domain/joined.h"
#include "services/dds/src/domain/network_watch.h"
#include "services/dds/src/domain/server_names.h"
#include "services/dds/src/domain/star_or_mesh.h"
#include "services/dds/src/keys_watch.h"
#include "services/dds/src/stranger_watch.h"
#include "services/dds/src/version_watch.h"

namespace trailcast::dds {

// Makes an exchange a member of the network. It joins, and leaves and joins again when the network,
// the keys or the way to meet others change; and it reports who else is there. It belongs to the
// exchange's thread.
class Membership {
 public:
  using Clock = std::chrono::steady_clock;
  // These are the exchange's part.
  struct Hooks {
    std::function<Result<void>()> joined;  // opens what it listens to
    std::function<void()> says_good_bye;   // the way to the others is still there
    std::function<void()> leaves;
  };

  Membership(const DdsOptions& options, exchange::TopicUse use, Hooks hooks);

  // Joins, or waits for the network if that is wanted.
  [[nodiscard]] Result<void> Open();
  // Looks every second whether anything has changed.
  void KeepWatch();
  // Takes a newer list of revoked keys from a server. It is a member when this is called.
  void TakeRevocations();
  void Hear(const exchange::Message& message) { star_or_mesh_.Hear(message); }

  // Returns null while it is no member.
  [[nodiscard]] Joined* joined() { return joined_ ? &*joined_ : nullptr; }
  [[nodiscard]] std::string WhyNotJoined() const;
  // Returns the options with the keys that are in use.
  [[nodiscard]] const DdsOptions& options() const { return options_; }
  [[nodiscard]] const exchange::TopicUse& use() const { return use_; }
  [[nodiscard]] Arrivals& arrivals() { return arrivals_; }
  // Returns whether the writer's member, known by its keys, may send the message.
  [[nodiscard]] bool IsAuthentic(const Reader& reader, dds_instance_handle_t writer,
                                 exchange::Message& message);

 private:
  Result<void> OpenOrWait(Clock::time_point now);
  Result<void> Join();
  void TryToJoin(Clock::time_point now);
  void Leave();
  void LookAtNetwork(Clock::time_point now);
  void LookForServers(Clock::time_point now);
  void MeetOthers(Clock::time_point now);
  void LookAtPeers(Clock::time_point now);
  void TellOfNetwork(const std::string& line);
  void TellOfDiscovery(const std::string& line);
  void TellOfWarnings(Clock::time_point now);
  void ShowNetworkState();

  // These are for members with keys.
  void TakeUpNewKeys();
  void LeaveForNewKeys();
  void TellOfStrangers(Clock::time_point now);

  DdsOptions options_;
  exchange::TopicUse use_;
  Hooks hooks_;
  std::optional<Joined> joined_;

  NetworkWatch network_;
  ServerNames servers_;
  std::string line_;     // about the network, reported once it has joined
  std::string why_not_;  // why joining failed; empty if it did not
  Clock::time_point try_at_{};
  Clock::duration tries_again_;
  std::uint64_t joins_ = 0;
  StarOrMesh star_or_mesh_;
  Clock::time_point look_at_{};

  CycloneWarnings warnings_;
  std::optional<KeysWatch> keys_watch_;  // with keys only
  bool keys_changed_ = false;            // since it last joined
  StrangerWatch strangers_;
  VersionWatch versions_;
  Arrivals arrivals_;
};

}  // namespace trailcast::dds
