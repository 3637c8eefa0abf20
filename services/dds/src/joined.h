#pragma once

#include <map>
#include <memory>
#include <optional>

#include "services/dds/dds_exchange.h"
#include "services/dds/src/cyclone_log.h"
#include "services/dds/src/entities.h"
#include "services/dds/src/peers.h"
#include "services/security/member.h"

namespace trailcast::dds {

// What an exchange has open on the network; deleted from the end.
struct Joined {
  Domain domain;
  std::unique_ptr<CycloneLog> log;  // with keys
  Participant participant;
  std::optional<Peers> peers;  // with keys
  WaitSet wait_set;
  std::map<exchange::Topic, Topic> topics{};
  std::map<exchange::Topic, Writer> writers{};
  std::map<exchange::Topic, Reader> readers{};
  std::map<dds_instance_handle_t, security::Member> senders{};  // with keys: who writes what

  // With keys: writers in the member's own partition, readers in all.
  [[nodiscard]] static Result<Joined> Open(const DdsOptions& options,
                                           const exchange::TopicUse& use);

  // Opened now if it was not.
  [[nodiscard]] Result<Writer*> WriterOf(exchange::Topic topic, const DdsOptions& options);
};

}  // namespace trailcast::dds
