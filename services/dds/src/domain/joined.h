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

// A topic's writer or reader, for everybody (kEverybody) or in a scope.
struct Place {
  exchange::Topic topic;
  std::string scope = kEverybody;
  auto operator<=>(const Place&) const = default;
};

// Everything that an exchange has open on the network. Members are destroyed from the last to the
// first.
struct Joined {
  Meeting meeting;
  std::unique_ptr<CycloneLog> log;  // of a domain of its own, including the domain's last lines
  std::shared_ptr<Domain> domain;
  Participant participant;
  Peers peers;
  WaitSet wait_set;
  std::map<exchange::Topic, Topic> topics{};
  std::map<Place, Writer> writers{};
  std::map<Place, Reader> readers{};
  std::optional<RevocationTopic> revocations{};  // if keys allow it
  Senders senders{};                             // with keys
  std::optional<Reader> participants{};          // unless it is always in a mesh
  std::set<dds_instance_handle_t> present{};     // participants at present, including itself

  // Opens everything on the interface that has the address of `meeting`, if neither the options nor
  // Cyclone's configuration name one. With keys, its writers are in the member's own partition and
  // those below, and its readers in all. Topics that are listened to by route have nothing open at
  // first. A route server takes the fixed ports if it can; the member `meeting` then tells whether
  // it has.
  [[nodiscard]] static Result<Joined> Open(const DdsOptions& options, const exchange::TopicUse& use,
                                           Meeting meeting);
  // Returns who is connected at present.
  [[nodiscard]] StarOrMesh::Seen Look();

  // Opens the writer now if it is not open yet.
  [[nodiscard]] Result<Writer*> WriterIn(const Place& place, const DdsOptions& options);
  // Reads `topic` in exactly these scopes.
  [[nodiscard]] Result<void> Listen(exchange::Topic topic, const std::set<std::string>& scopes,
                                    const DdsOptions& options);
};

}  // namespace trailcast::dds
