#include "services/dds/src/domain/peers.h"

#include <algorithm>
#include <cstring>

#include "services/dds/src/domain/user_data.h"

namespace trailcast::dds {
namespace {

constexpr std::size_t kMostAtOnce = 4096;

// Makes a stranger's text fit for a line of the log.
std::string Plain(const char* text) {
  constexpr std::size_t kMost = 100;
  std::string plain(text, strnlen(text, kMost));
  for (char& c : plain) {
    if (c < ' ' || c > '~') c = '?';
  }
  return plain;
}

std::string Property(const dds_qos_t* qos, const char* name) {
  char* value = nullptr;
  if (!dds_qget_prop(qos, name, &value) || value == nullptr) return "";
  std::string text = Plain(value);
  dds_free(value);
  return text;
}

UserData SaidData(const dds_qos_t* qos) {
  void* data = nullptr;
  std::size_t size = 0;
  if (!dds_qget_userdata(qos, &data, &size) || data == nullptr) return {};
  const std::string text = Plain(std::string(static_cast<const char*>(data), size).c_str());
  dds_free(data);
  return ParseUserData(text);
}

// Returns "10.0.0.7:41830" from "udp/239.255.0.1:7400@1,udp/10.0.0.7:41830@1". The other address is
// the group of all members.
std::string OwnAddress(const std::string& addresses) {
  const std::size_t from = addresses.rfind("udp/");
  if (from == std::string::npos) return addresses;
  return addresses.substr(from + 4, addresses.find('@', from) - from - 4);
}

// Returns "participant 1:2:3, calling itself 'robot-9', at 10.0.0.7:41830, host lab, process 812".
Peers::SaidOfItself Said(const dds_builtintopic_participant_t& participant) {
  std::string about = "participant " + ParticipantText(participant.key);
  const auto [name, version] = SaidData(participant.qos);
  if (!name.empty()) about += ", calling itself '" + name + "'";
  const std::string address = OwnAddress(Property(participant.qos, "__NetworkAddresses"));
  if (!address.empty()) about += ", at " + address;
  const std::string host = Property(participant.qos, "__Hostname");
  const std::string process = Property(participant.qos, "__Pid");
  if (!host.empty()) about += ", host " + host;
  if (!process.empty()) about += ", process " + process;
  return {std::move(about), !(name + host + process).empty(), name, version, address};
}

}  // namespace

std::string ParticipantText(const dds_guid_t& guid) {
  const auto word = [&](std::size_t i) {
    return (static_cast<std::uint32_t>(guid.v[4 * i]) << 24U) |
           (static_cast<std::uint32_t>(guid.v[4 * i + 1]) << 16U) |
           (static_cast<std::uint32_t>(guid.v[4 * i + 2]) << 8U) |
           static_cast<std::uint32_t>(guid.v[4 * i + 3]);
  };
  return fmt::format("{:x}:{:x}:{:x}", word(0), word(1), word(2));
}

Result<Peers> Peers::Create(const Participant& participant, bool with_proof) {
  dds_guid_t self{};
  if (const dds_return_t got = dds_get_guid(participant.handle(), &self); got < 0) {
    return tl::unexpected(DdsError(got, "asking for the own GUID"));
  }
  auto participants = Reader::CreateBuiltin(participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT);
  if (!participants) return tl::unexpected(participants.error());
  Peers peers(self, *std::move(participants));
  if (!with_proof) return peers;
  for (const dds_entity_t topic :
       {DDS_BUILTIN_TOPIC_DCPSPUBLICATION, DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION}) {
    auto endpoints = Reader::CreateBuiltin(participant, topic);
    if (!endpoints) return tl::unexpected(endpoints.error());
    peers.endpoints_.push_back(*std::move(endpoints));
  }
  return peers;
}

Result<void> Peers::Look(const Handlers& handlers) {
  const auto is_self = [&](const dds_guid_t& guid) {
    return std::equal(std::begin(guid.v), std::end(guid.v), std::begin(self_.v));
  };
  auto looked =
      participants_.Take(kMostAtOnce, [&](const void* sample, const dds_sample_info_t& info) {
        const auto& peer = *static_cast<const dds_builtintopic_participant_t*>(sample);
        if (is_self(peer.key)) return;
        if (info.instance_state != DDS_IST_ALIVE) {
          handlers.gone(ParticipantText(peer.key));
        } else if (info.valid_data) {
          handlers.seen(ParticipantText(peer.key), Said(peer));
        }
      });
  if (!looked) return looked;
  for (Reader& reader : endpoints_) {
    auto taken = reader.Take(kMostAtOnce, [&](const void* sample, const dds_sample_info_t& info) {
      const auto& endpoint = *static_cast<const dds_builtintopic_endpoint_t*>(sample);
      if (info.valid_data && !is_self(endpoint.participant_key)) {
        handlers.proven(ParticipantText(endpoint.participant_key));
      }
    });
    if (!taken) return taken;
  }
  return {};
}

}  // namespace trailcast::dds
