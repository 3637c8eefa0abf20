#include "services/dds/src/senders.h"

#include "services/security/author.h"

namespace trailcast::dds {
namespace {

exchange::SegmentBatch::Trust TrustIn(security::Role role) {
  using Trust = exchange::SegmentBatch::Trust;
  if (role == security::Role::kFollower) return Trust::kProof;
  return role == security::Role::kScout ? Trust::kOwnRoutes : Trust::kAll;
}

}  // namespace

const security::Member* Senders::Of(const Reader& reader, dds_instance_handle_t writer) {
  constexpr std::size_t kMostRemembered = 10'000;
  if (const auto found = members_.find(writer); found != members_.end()) return &found->second;
  const auto partition = reader.PartitionOf(writer);
  const auto member = partition ? security::ParsePartition(*partition) : std::nullopt;
  if (!member) return nullptr;
  if (members_.size() >= kMostRemembered) members_.erase(members_.begin());
  return &members_.emplace(writer, *member).first->second;
}

Result<void> CheckSender(const security::Member& sender, const std::string& name_key,
                         exchange::Message& message) {
  if (auto own = security::CheckAuthor(message, sender, name_key); !own) return own;
  if (auto* batch = std::get_if<exchange::SegmentBatch>(&message)) {
    batch->trust = TrustIn(sender.role);
  }
  return {};
}

}  // namespace trailcast::dds
