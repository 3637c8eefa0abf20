#include "services/dds/src/revocation_topic.h"

#include <algorithm>
#include <utility>

#include "services/dds/src/qos_table.h"
#include "services/security/documents.h"
#include "trailcast.h"

namespace trailcast::dds {
namespace {

std::string TextIn(const trailcast_wire_RevocationList& wire) {
  const std::size_t size =
      std::min<std::size_t>(wire.text._length, security::kMaxRevocationListBytes + 1);
  return {reinterpret_cast<const char*>(wire.text._buffer), size};
}

}  // namespace

Result<RevocationTopic> RevocationTopic::Open(const Participant& participant, WaitSet& wait_set,
                                              const security::MemberKeys& keys) {
  auto topic =
      Topic::Create(participant, trailcast_wire_RevocationList_desc, security::kRevocationsTopic);
  if (!topic) return tl::unexpected(topic.error());
  auto reader = Reader::Create(participant, *topic, MakeQos(kRevocationsQos, {"*"}));
  if (!reader) return Wrap(reader.error(), security::kRevocationsTopic);
  if (auto ok = wait_set.Attach(*reader); !ok) return tl::unexpected(ok.error());
  RevocationTopic opened(*std::move(topic), *std::move(reader));
  if (keys.member.role == security::Role::kServer) {
    if (auto ok = opened.Write(participant, keys); !ok) {
      return Wrap(ok.error(), security::kRevocationsTopic);
    }
  }
  return opened;
}

Result<void> RevocationTopic::Write(const Participant& participant,
                                    const security::MemberKeys& keys) {
  auto writer = Writer::Create(participant, topic_,
                               MakeQos(kRevocationsQos, {security::PartitionOf(keys.member)}));
  if (!writer) return tl::unexpected(writer.error());
  writer_ = *std::move(writer);
  std::string server = keys.member.id;
  std::string text = keys.revoked.text;
  const trailcast_wire_RevocationList wire{
      .server = server.data(),
      .text = {._maximum = static_cast<std::uint32_t>(text.size()),
               ._length = static_cast<std::uint32_t>(text.size()),
               ._buffer = reinterpret_cast<std::uint8_t*>(text.data()),
               ._release = false}};
  return writer_->Write(&wire);
}

std::vector<RevocationTopic::Offer> RevocationTopic::Take() {
  constexpr std::size_t kMost = 64;  // servers
  std::vector<Offer> offers;
  // Anything that cannot be taken now will be taken the next time.
  (void)reader_.Take(kMost, [&](const void* sample, const dds_sample_info_t& info) {
    if (!info.valid_data) return;
    offers.push_back({reader_.PartitionOf(info.publication_handle).value_or("a server that went"),
                      TextIn(*static_cast<const trailcast_wire_RevocationList*>(sample))});
  });
  return offers;
}

}  // namespace trailcast::dds
