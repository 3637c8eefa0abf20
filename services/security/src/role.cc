#include "services/security/role.h"

#include <algorithm>
#include <array>
#include <vector>

#include "services/exchange/topics.h"

namespace trailcast::security {
namespace {

using exchange::Topic;
using exchange::TopicUse;

constexpr std::array kRoles{Role::kScout, Role::kFollower, Role::kServer, Role::kOperator,
                            Role::kObserver};

void Add(std::vector<Topic>& topics, const std::vector<Topic>& more) {
  for (const Topic topic : more) {
    if (std::find(topics.begin(), topics.end(), topic) == topics.end()) topics.push_back(topic);
  }
}

// Merges rights, for which the number of writers and the quality of reading do not matter.
TopicUse Together(TopicUse use, const TopicUse& more) {
  Add(use.write, more.write);
  Add(use.write, more.write_rarely);
  Add(use.read, more.read);
  Add(use.read, more.overhear);
  Add(use.read, more.listen);
  return use;
}

// Everybody may see which agents exist. Robots and servers announce themselves, and servers
// announce all others. Each answers when asked whom it hears.
TopicUse SeesAgents() {
  return {.write = {Topic::kReachReports},
          .read = {Topic::kAgents, Topic::kFleet, Topic::kReachRequests}};
}

void AppendBeyond(const std::vector<Topic>& wanted, const std::vector<Topic>& granted,
                  const char* doing, std::string& text) {
  for (const Topic topic : wanted) {
    if (std::find(granted.begin(), granted.end(), topic) != granted.end()) continue;
    if (!text.empty()) text += ", ";
    text += std::string(doing) + " " + exchange::NameOf(topic);
  }
}

}  // namespace

std::span<const Role> AllRoles() { return kRoles; }

const char* NameOf(Role role) {
  switch (role) {
    case Role::kScout:
      return "scout";
    case Role::kFollower:
      return "follower";
    case Role::kServer:
      return "server";
    case Role::kOperator:
      return "operator";
    case Role::kObserver:
      return "observer";
  }
  return "unknown role";
}

std::optional<Role> FindRole(std::string_view name) {
  const auto found =
      std::find_if(kRoles.begin(), kRoles.end(), [&](Role role) { return name == NameOf(role); });
  return found == kRoles.end() ? std::nullopt : std::optional<Role>(*found);
}

TopicUse RightsOf(Role role) {
  switch (role) {
    case Role::kScout:
      return Together(Together(SeesAgents(), exchange::TeachingTopics()), exchange::OnDutyTopics());
    case Role::kFollower:
      return Together(SeesAgents(), exchange::OnDutyTopics());
    case Role::kServer:
      return Together(SeesAgents(), exchange::ServerTopics());
    case Role::kOperator: {
      TopicUse use = Together(exchange::OperatorTopics(), exchange::FollowerTopics());
      use = Together(std::move(use), exchange::DispatcherTopics());
      use = Together(std::move(use), exchange::SenderTopics());
      use = Together(std::move(use), exchange::HistoryTopics());
      use = Together(std::move(use), exchange::ScoutTopics());
      use = Together(std::move(use), exchange::DriverTopics());
      use = Together(std::move(use), exchange::SnapshotTopics());
      use = Together(std::move(use), exchange::NetworkTopics());
      use = Together(std::move(use), exchange::PhotoTopics());
      use = Together(std::move(use), exchange::JoinerTopics());
      use = Together(std::move(use), exchange::ReachTopics());
      std::erase(use.write, Topic::kAgents);  // operators are not agents
      return use;
    }
    case Role::kObserver:
      return Together(
          Together(
              Together(Together(Together(exchange::ObserverTopics(), exchange::HistoryTopics()),
                                exchange::SnapshotTopics()),
                       exchange::NetworkTopics()),
              exchange::ReachTopics()),
          exchange::PhotoTopics());
  }
  return {};
}

std::string BeyondRights(Role role, const TopicUse& use) {
  const TopicUse rights = RightsOf(role);
  std::string beyond;
  AppendBeyond(use.write, rights.write, "write", beyond);
  AppendBeyond(use.write_rarely, rights.write, "write", beyond);
  AppendBeyond(use.read, rights.read, "read", beyond);
  AppendBeyond(use.overhear, rights.read, "read", beyond);
  AppendBeyond(use.listen, rights.read, "read", beyond);
  return beyond;
}

}  // namespace trailcast::security
