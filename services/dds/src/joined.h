#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>

#include "services/dds/dds_exchange.h"
#include "services/dds/src/cyclone_log.h"
#include "services/dds/src/discovery_config.h"
#include "services/dds/src/entities.h"
#include "services/dds/src/peers.h"
#include "services/dds/src/star_or_mesh.h"
#include "services/security/member.h"

namespace trailcast::dds {

// What an exchange has open on the network; deleted from the end.
struct Joined {
  Meeting meeting;
  Domain domain;
  std::unique_ptr<CycloneLog> log;  // with keys
  Participant participant;
  std::optional<Peers> peers;  // with keys
  WaitSet wait_set;
  std::map<exchange::Topic, Topic> topics{};
  std::map<exchange::Topic, Writer> writers{};
  std::map<exchange::Topic, Reader> readers{};
  std::map<dds_instance_handle_t, security::Member> senders{};  // with keys: who writes what
  std::optional<Reader> participants{};                         // unless it is in a mesh for good
  std::set<dds_instance_handle_t> present{};                    // of these, itself included

  // With keys: writers in the member's own partition, readers in all. A route server takes the
  // fixed ports if it can: `meeting` says whether it has.
  [[nodiscard]] static Result<Joined> Open(const DdsOptions& options, const exchange::TopicUse& use,
                                           bool star);
  // Who is connected at present.
  [[nodiscard]] StarOrMesh::Seen Look();

  // Opened now if it was not.
  [[nodiscard]] Result<Writer*> WriterOf(exchange::Topic topic, const DdsOptions& options);
};

}  // namespace trailcast::dds
