#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "services/dds/dds_exchange.h"
#include "services/dds/src/domain/cyclone_log.h"
#include "services/dds/src/domain/discovery_config.h"
#include "services/dds/src/domain/peers.h"
#include "services/dds/src/domain/scope.h"
#include "services/dds/src/domain/star_or_mesh.h"
#include "services/dds/src/entities.h"
#include "services/dds/src/revocation_topic.h"
#include "services/dds/src/senders.h"

namespace trailcast::dds {

// A writer or reader of a topic: for everybody (kEverybody), or in a scope.
struct Place {
  exchange::Topic topic;
  std::string scope = kEverybody;
  auto operator<=>(const Place&) const = default;
};

// What an exchange has open on the network; deleted from the end.
struct Joined {
  Meeting meeting;
  std::unique_ptr<CycloneLog> log;  // of a domain of its own, of which it has the last words, too
  std::shared_ptr<Domain> domain;
  Participant participant;
  Peers peers;
  WaitSet wait_set;
  std::map<exchange::Topic, Topic> topics{};
  std::map<Place, Writer> writers{};
  std::map<Place, Reader> readers{};
  std::optional<RevocationTopic> revocations{};  // with keys that allow it
  Senders senders{};                             // with keys
  std::optional<Reader> participants{};          // unless it is in a mesh for good
  std::set<dds_instance_handle_t> present{};     // of these, itself included

  // By the interface that has `address`, where neither the options nor Cyclone's configuration
  // names one. With keys: writers in the member's own partition and those below, readers in all. Of
  // topics to which one listens by route nothing is open at first. A route server takes the fixed
  // ports if it can: `meeting` says whether it has.
  [[nodiscard]] static Result<Joined> Open(const DdsOptions& options, const exchange::TopicUse& use,
                                           bool star, const std::string& address);
  // Who is connected at present.
  [[nodiscard]] StarOrMesh::Seen Look();

  // Opened now if it was not.
  [[nodiscard]] Result<Writer*> WriterIn(const Place& place, const DdsOptions& options);
  // Reads `topic` in these scopes and no others.
  [[nodiscard]] Result<void> Listen(exchange::Topic topic, const std::set<std::string>& scopes,
                                    const DdsOptions& options);
};

}  // namespace trailcast::dds
