#include "services/dds/src/domain/joined.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "services/dds/src/domain/cyclone_uri.h"
#include "services/dds/src/domain/domain_config.h"
#include "services/dds/src/domain/host_name.h"
#include "services/dds/src/domain/user_data.h"
#include "services/dds/src/qos_table.h"
#include "services/dds/src/wire.h"
#include "services/exchange/topics.h"

namespace trailcast::dds {
namespace {

std::string WayOf(const Meeting& meeting) {
  return fmt::format("{} {}", meeting.address, fmt::join(meeting.servers, " "));
}

Result<std::shared_ptr<Domain>> MakeDomain(const DdsOptions& options, const Meeting& meeting) {
  if (options.shared_domain) {
    auto domain = options.shared_domain->domain.lock();
    if (domain && options.shared_domain->by == WayOf(meeting)) return domain;
  }
  const auto config = DomainConfig(options, meeting, CycloneUri());
  if (!config) return tl::unexpected(config.error());
  auto made = Domain::Create(*config);
  if (!made) return tl::unexpected(made.error());
  auto domain = std::make_shared<Domain>(*std::move(made));
  if (options.shared_domain) *options.shared_domain = {domain, WayOf(meeting)};
  return domain;
}

// Members that share a domain do not hear each other.
Qos Apart(const DdsOptions& options, Qos qos) {
  if (options.shared_domain) dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PROCESS);
  return qos;
}

Result<Joined> OpenDomain(const DdsOptions& options, Meeting meeting) {
  if (options.keys) HideHostName();
  auto domain = MakeDomain(options, meeting);
  if (!domain && meeting.fixed_ports) {  // another process was quicker
    meeting.fixed_ports = false;
    domain = MakeDomain(options, meeting);
  }
  if (!domain) return tl::unexpected(domain.error());
  std::unique_ptr<CycloneLog> log;
  if (!options.shared_domain) log = std::make_unique<CycloneLog>((*domain)->id());
  const bool hidden = options.keys.has_value();
  const UserData data{hidden ? "" : options.self.value(), options.protocol_version};
  auto participant = Participant::Create(**domain, ToText(data), hidden);
  if (!participant) {
    Error error = participant.error();
    if (log && hidden) {
      error.message = fmt::format("{}: {}", error.message, fmt::join(log->Take(), "; "));
    }
    return tl::unexpected(error);
  }
  auto peers = Peers::Create(*participant, hidden);
  if (!peers) return tl::unexpected(peers.error());
  auto wait_set = WaitSet::Create(*participant);
  if (!wait_set) return tl::unexpected(wait_set.error());
  return Joined{.meeting = meeting,
                .log = std::move(log),
                .domain = *std::move(domain),
                .participant = *std::move(participant),
                .peers = *std::move(peers),
                .wait_set = *std::move(wait_set)};
}

Result<dds::Topic*> Find(Joined& joined, exchange::Topic topic) {
  if (const auto found = joined.topics.find(topic); found != joined.topics.end()) {
    return &found->second;
  }
  auto made = dds::Topic::Create(joined.participant, TypeOf(topic), exchange::NameOf(topic));
  if (!made) return tl::unexpected(made.error());
  return &joined.topics.emplace(topic, *std::move(made)).first->second;
}

Result<void> Read(Joined& joined, const Place& place, const DdsOptions& options, Qos qos) {
  const auto found = Find(joined, place.topic);
  if (!found) return tl::unexpected(found.error());
  auto reader = Reader::Create(joined.participant, **found, Apart(options, std::move(qos)));
  if (!reader) return Wrap(reader.error(), exchange::NameOf(place.topic));
  if (auto ok = joined.wait_set.Attach(*reader); !ok) {
    return Wrap(ok.error(), exchange::NameOf(place.topic));
  }
  joined.readers.emplace(place, *std::move(reader));
  return {};
}

Result<void> OpenTopics(Joined& joined, const DdsOptions& options, const exchange::TopicUse& use) {
  for (const exchange::Topic topic : use.write) {
    if (exchange::IsOfRoutes(topic) || !MayUse(options, topic)) continue;
    if (auto writer = joined.WriterIn({topic}, options); !writer) {
      return tl::unexpected(writer.error());
    }
  }
  for (const exchange::Topic topic : use.read) {
    if (!MayUse(options, topic)) continue;
    Qos qos = MakeQos(QosOf(topic), ReadersPartitions(options, topic));
    if (auto read = Read(joined, {topic}, options, std::move(qos)); !read) return read;
  }
  for (const exchange::Topic topic : use.overhear) {
    Qos qos = MakeOverhearingQos(QosOf(topic), ReadersPartitions(options, topic));
    if (auto read = Read(joined, {topic}, options, std::move(qos)); !read) return read;
  }
  return {};
}

}  // namespace

Result<Joined> Joined::Open(const DdsOptions& options, const exchange::TopicUse& use,
                            Meeting meeting) {
  meeting.fixed_ports = options.serves && FixedPortsAreFree(options.domain_id);
  meeting.sends_much =
      std::count(use.write.begin(), use.write.end(), exchange::Topic::kSegments) > 0;
  auto joined = OpenDomain(options, std::move(meeting));
  if (!joined) return joined;
  if (options.discovery != Discovery::kMesh) {
    auto others = Reader::CreateBuiltin(joined->participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT);
    if (!others) return tl::unexpected(others.error());
    joined->participants = *std::move(others);
  }
  if (auto opened = OpenTopics(*joined, options, use); !opened) {
    return tl::unexpected(opened.error());
  }
  if (options.keys && options.keys->revocations) {
    auto topic = RevocationTopic::Open(joined->participant, joined->wait_set, *options.keys);
    if (!topic) return tl::unexpected(topic.error());
    joined->revocations = *std::move(topic);
  }
  return joined;
}

StarOrMesh::Seen Joined::Look() {
  constexpr std::size_t kMostAtOnce = 1024;
  if (participants) {
    // Anything that cannot be read now will be read the next time.
    (void)participants->Take(kMostAtOnce, [&](const void*, const dds_sample_info_t& info) {
      if (info.instance_state == DDS_IST_ALIVE) {
        present.insert(info.instance_handle);
      } else {
        present.erase(info.instance_handle);
      }
    });
  }
  StarOrMesh::Seen seen{.server = false, .anybody = present.size() > 1};
  // Only servers write these.
  for (const exchange::Topic topic :
       {exchange::Topic::kReceipts, exchange::Topic::kCatalogReplies}) {
    const auto reader = readers.find({topic});
    seen.server = seen.server || (reader != readers.end() && reader->second.matched() > 0);
  }
  return seen;
}

Result<Writer*> Joined::WriterIn(const Place& place, const DdsOptions& options) {
  if (const auto found = writers.find(place); found != writers.end()) return &found->second;
  const auto found = Find(*this, place.topic);
  if (!found) return tl::unexpected(found.error());
  const Qos qos =
      Apart(options, MakeQos(QosOf(place.topic), {WritersPartition(options, place.scope)}));
  auto writer = Writer::Create(participant, **found, qos);
  if (!writer) return Wrap(writer.error(), exchange::NameOf(place.topic));
  return &writers.emplace(place, *std::move(writer)).first->second;
}

Result<void> Joined::Listen(exchange::Topic topic, const std::set<std::string>& scopes,
                            const DdsOptions& options) {
  std::erase_if(readers, [&](const auto& entry) {
    const Place& place = entry.first;
    return place.topic == topic && place.scope != kEverybody && !scopes.contains(place.scope);
  });
  for (const std::string& scope : scopes) {
    if (readers.contains({topic, scope})) continue;
    Qos qos = MakeQos(QosOf(topic), ListenersPartitions(options, scope));
    if (auto read = Read(*this, {topic, scope}, options, std::move(qos)); !read) return read;
  }
  return {};
}

}  // namespace trailcast::dds
