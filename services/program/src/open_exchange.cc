#include "services/program/open_exchange.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "services/base/process_name.h"
#include "services/dds/dds_exchange.h"
#include "services/program/heartbeat.h"
#include "services/security/member_keys.h"

namespace trailcast::program {
namespace {

constexpr std::chrono::hours kSoon{7 * 24};

// A topic that older keys do not name, one of each kind.
struct NewerTopic {
  exchange::Topic topic;
  const char* what;
};
constexpr NewerTopic kNewerTopics[] = {
    {exchange::Topic::kNow, "operators told robots to pause or to stop"},
    {exchange::Topic::kMissionReplies, "it could be asked what became of missions"},
    {exchange::Topic::kMissions, "robots were sent on missions"},
    {exchange::Topic::kDrives, "robots that teach were driven by operators"},
    {exchange::Topic::kSnapshotRequests, "operators looked through robots' cameras"},
    {exchange::Topic::kNetworkReplies, "routes were joined"},
    {exchange::Topic::kFollowed, "robots told servers where they lose their path"},
    {exchange::Topic::kReachRequests, "members were asked whom they hear"},
    {exchange::Topic::kStores, "servers told each other what they hold"},
    {exchange::Topic::kPhotoRequests, "robots took photos on missions"},
};

Result<security::MemberKeys> Keys(const CommonOptions& options, const exchange::TopicUse& use) {
  const auto now = std::chrono::system_clock::now();
  auto keys = security::LoadMemberKeys(options.security, now);
  if (!keys) return keys;
  if (const std::string beyond = security::BeyondRights(keys->member.role, use); !beyond.empty()) {
    return Fail(ErrorCode::kInvalidArgument,
                "the keys in {} are of the role '{}', which does not allow this ({}): use the keys "
                "of a member whose role does ('trailcast keys add --help')",
                options.security, security::NameOf(keys->member.role), beyond);
  }
  if (WithoutProcess(options.name) != keys->name) {
    return Fail(ErrorCode::kInvalidArgument,
                "the keys in {} are those of '{}', not of '{}': leave --name out, or give the keys "
                "of that member",
                options.security, keys->name, options.name);
  }
  if (keys->expires < now + kSoon) {
    spdlog::warn("the keys in {} expire on {}: 'trailcast keys renew {}' where the authority is",
                 options.security, security::ToText(keys->expires), keys->name);
  }
  if (!keys->scoped) {
    spdlog::warn(
        "the keys in {} are from before segments went only to those who fetch their route: what "
        "this program sends goes to all who fetch any; 'trailcast keys renew {}' where the "
        "authority is",
        options.security, keys->name);
  }
  if (!keys->revocations) {
    spdlog::warn(
        "the keys in {} are from before route servers spread the list of revoked keys: {}; "
        "'trailcast keys renew {}' where the authority is",
        options.security,
        keys->member.role == security::Role::kServer
            ? "this one does not, and hears of none"
            : "copy revoked.pem there by hand after each 'trailcast keys revoke'",
        keys->name);
  }
  for (const auto& [topic, what] : kNewerTopics) {
    if (!keys->lacks.contains(topic)) continue;
    spdlog::warn(
        "the keys in {} are from before {}: this program takes no part in that; 'trailcast keys "
        "renew {}' where the authority is",
        options.security, what, keys->name);
  }
  return keys;
}

dds::Discovery DiscoveryOf(const std::string& word) {
  if (word == "mesh") return dds::Discovery::kMesh;
  return word == "star" ? dds::Discovery::kStar : dds::Discovery::kAuto;
}

bool IsServer(const exchange::TopicUse& use) { return use.Writes(exchange::Topic::kReceipts); }
bool IsAgent(const exchange::TopicUse& use) { return use.Writes(exchange::Topic::kAgents); }

}  // namespace

Result<std::unique_ptr<exchange::RouteExchange>> OpenExchange(
    const CommonOptions& options, const exchange::TopicUse& use,
    std::shared_ptr<exchange::NetworkState> network) {
  dds::DdsOptions dds;
  dds.domain_id = static_cast<std::uint32_t>(options.domain);
  dds.discovery_tag = options.dds_tag;
  dds.network_interface = options.network_interface;
  dds.self = AgentId(options.name);
  dds.serves = IsServer(use);
  dds.discovery = dds.serves ? dds::Discovery::kMesh : DiscoveryOf(options.discovery);
  dds.server_addresses = options.server_addresses;
  dds.network_state = network ? std::move(network) : std::make_shared<exchange::NetworkState>();
  dds.waits_for_network = IsAgent(use);
  // A command that ends in a moment has no log to watch.
  if (IsAgent(use)) {
    dds.tell_of_network = [](const std::string& line) { spdlog::warn("{}", line); };
    dds.tell_of_discovery = [](const std::string& line) { spdlog::info("{}", line); };
  }
  dds.tell_of_version = [](const std::string& line) { spdlog::warn("{}", line); };
  if (!options.security.empty()) {
    auto keys = Keys(options, use);
    if (!keys) return Wrap(keys.error(), "--security");
    dds.keys = *std::move(keys);
    if (IsAgent(use))
      dds.tell_of_stranger = [](const std::string& line) { spdlog::warn("{}", line); };
  }
  auto opened = dds::OpenDdsExchange(dds, use);
  if (!opened) return Wrap(opened.error(), "joining the network");
  if (options.heartbeat.empty()) return opened;
  return WithHeartbeat(*std::move(opened), options.heartbeat, dds.network_state);
}

bool KeysAllow(const CommonOptions& options, const exchange::TopicUse& use) {
  if (options.security.empty()) return true;
  const auto keys = security::LoadMemberKeys(options.security, std::chrono::system_clock::now());
  return !keys || security::BeyondRights(keys->member.role, use).empty();
}

}  // namespace trailcast::program
