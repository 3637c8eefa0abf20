#include "services/security/author.h"

#include "services/base/process_name.h"

namespace trailcast::security {
namespace {

using exchange::AgentRole;

// Returns whom a message names as its author.
struct AuthorIn {
  AgentId operator()(const exchange::RouteAnnouncement& m) { return m.holder; }
  AgentId operator()(const exchange::SegmentBatch& m) { return m.sender; }
  AgentId operator()(const exchange::SegmentRequest& m) { return m.requester; }
  AgentId operator()(const exchange::Receipt& m) { return m.server; }
  AgentId operator()(const exchange::CatalogRequest& m) { return m.client; }
  AgentId operator()(const exchange::CatalogReply& m) { return m.server; }
  AgentId operator()(const exchange::AgentStatus& m) { return m.agent; }
  AgentId operator()(const exchange::RouteEditRequest& m) { return m.client; }
  AgentId operator()(const exchange::Fleet& m) { return m.server; }
  AgentId operator()(const exchange::RouteFollowers& m) { return m.server; }
  AgentId operator()(const exchange::NowCommand& m) { return m.client; }
  AgentId operator()(const exchange::NowAnswer& m) { return m.agent; }
  AgentId operator()(const mission::Mission& m) { return m.client; }
  AgentId operator()(const mission::Report& m) { return m.agent; }
  AgentId operator()(const exchange::MissionRequest& m) { return m.client; }
  AgentId operator()(const exchange::MissionReply& m) { return m.server; }
  AgentId operator()(const exchange::DriveCommand& m) { return m.client; }
  AgentId operator()(const exchange::SnapshotRequest& m) { return m.client; }
  AgentId operator()(const exchange::Snapshot& m) { return m.agent; }
  AgentId operator()(const exchange::NetworkEdit& m) { return m.client; }
  AgentId operator()(const exchange::NetworkRequest& m) { return m.client; }
  AgentId operator()(const exchange::NetworkReply& m) { return m.server; }
  AgentId operator()(const exchange::FollowedSections& m) { return m.agent; }
  AgentId operator()(const exchange::ReachRequest& m) { return m.client; }
  AgentId operator()(const exchange::ReachReport& m) { return m.agent; }
  AgentId operator()(const exchange::StoreSummary& m) { return m.server; }
  AgentId operator()(const exchange::PhotoPiece& m) { return m.holder; }
  AgentId operator()(const exchange::PhotoRequest& m) { return m.client; }
  AgentId operator()(const exchange::AgentGone& m) { return m.agent; }
};

// A scout may follow as well.
bool MayCallItself(Role role, AgentRole said) {
  switch (said) {
    case AgentRole::kServer:
      return role == Role::kServer;
    case AgentRole::kScout:
      return role == Role::kScout;
    case AgentRole::kFollower:
      return role == Role::kFollower || role == Role::kScout;
    case AgentRole::kOperator:
      return role == Role::kOperator;
  }
  return false;
}

Result<void> CheckTaught(const exchange::RouteAnnouncement& announcement) {
  const route::RouteInfo& info = announcement.info;
  if (info.scout != announcement.holder) {
    return Fail(ErrorCode::kInvalidArgument, "announces a route that '{}' taught",
                info.scout.value());
  }
  if (info.edition != 0 || info.standing != route::Standing::kStaged) {
    return Fail(ErrorCode::kInvalidArgument, "announces labels, which only operators change");
  }
  return {};
}

// Servers pass on operators' commands to robots, and the robots' answers.
bool IsRelayed(const exchange::Message& message) {
  return std::visit(
      [](const auto& m) {
        if constexpr (requires { m.relayed; }) return m.relayed;
        return false;
      },
      message);
}

}  // namespace

Result<void> CheckAuthor(const exchange::Message& message, const Member& sender,
                         const std::string& name_key) {
  if (IsRelayed(message)) {
    if (sender.role == Role::kServer) return {};
    return Fail(ErrorCode::kInvalidArgument, "passes on what others say, which only servers do");
  }
  const std::string author = std::visit(AuthorIn(), message).value();
  if (MemberIdOf(name_key, WithoutProcess(author)) != sender.id) {
    return Fail(ErrorCode::kInvalidArgument, "speaks in the name of '{}'", author);
  }
  if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) {
    if (!MayCallItself(sender.role, status->role)) {
      return Fail(ErrorCode::kInvalidArgument, "'{}' claims another role than its own", author);
    }
  }
  const auto* announcement = std::get_if<exchange::RouteAnnouncement>(&message);
  if (announcement != nullptr && sender.role == Role::kScout) return CheckTaught(*announcement);
  return {};
}

}  // namespace trailcast::security
