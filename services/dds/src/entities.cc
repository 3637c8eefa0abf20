#include "services/dds/src/entities.h"

#include <array>
#include <cassert>

namespace trailcast::dds {
namespace {

dds_duration_t ToDds(std::chrono::milliseconds duration) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(duration).count();
}

Result<void> Check(dds_return_t code, const char* doing) {
  if (code >= 0) return {};
  return tl::unexpected(DdsError(code, doing));
}

std::string PolicyName(std::uint32_t id) {
  switch (id) {
    case DDS_RELIABILITY_QOS_POLICY_ID:
      return "reliability";
    case DDS_DURABILITY_QOS_POLICY_ID:
      return "durability";
    case DDS_DEADLINE_QOS_POLICY_ID:
      return "deadline";
    case DDS_LIVELINESS_QOS_POLICY_ID:
      return "liveliness";
    default:
      return fmt::format("policy {}", id);
  }
}

using EndpointPtr =
    std::unique_ptr<dds_builtintopic_endpoint_t, void (*)(dds_builtintopic_endpoint_t*)>;

EndpointPtr FindWriter(dds_entity_t reader, dds_instance_handle_t writer) {
  return {dds_get_matched_publication_data(reader, writer), &dds_builtintopic_free_endpoint};
}

}  // namespace

Error DdsError(dds_return_t code, const std::string& doing) {
  ErrorCode kind = ErrorCode::kInternal;
  if (code == DDS_RETCODE_TIMEOUT || code == DDS_RETCODE_OUT_OF_RESOURCES) {
    kind = ErrorCode::kUnavailable;
  } else if (code == DDS_RETCODE_BAD_PARAMETER || code == DDS_RETCODE_INCONSISTENT_POLICY) {
    kind = ErrorCode::kInvalidArgument;
  }
  return {kind, fmt::format("DDS: {}: {}", doing, dds_strretcode(-code))};
}

Qos MakeQos() { return Qos(dds_create_qos()); }

Result<Domain> Domain::Create(const std::string& config_xml) {
  // The id matters only in this process (the network sees ExternalDomainId), so any free one will
  // do.
  constexpr dds_domainid_t kMaxDomains = 230;
  for (dds_domainid_t id = 0; id < kMaxDomains; ++id) {
    const dds_entity_t handle = dds_create_domain(id, config_xml.c_str());
    if (handle >= 0) return Domain(handle, id);
    if (handle != DDS_RETCODE_PRECONDITION_NOT_MET) {
      Error error = DdsError(handle, "creating a domain");
      error.message +=
          "; check the network interface's name and the XML (CYCLONEDDS_URI included); Cyclone's "
          "own message is on stderr";
      return tl::unexpected(error);
    }
  }
  return Fail(ErrorCode::kInternal, "DDS: this process has {} domains open already", kMaxDomains);
}

Result<Participant> Participant::Create(const Domain& domain, const std::string& user_data,
                                        bool hidden) {
  const Qos qos = MakeQos();
  if (hidden) {
    for (const char* property : {"__ProcessName", "__Pid", "__Hostname"}) {
      dds_qset_prop(qos.get(), property, "");  // Cyclone announces what is not set
    }
  }
  dds_qset_userdata(qos.get(), user_data.data(), user_data.size());
  const dds_entity_t handle = dds_create_participant(domain.id(), qos.get(), nullptr);
  if (handle < 0) return tl::unexpected(DdsError(handle, "creating a participant"));
  return Participant(handle);
}

Result<void> Participant::Call() {
  // Cyclone announces the participant again when its user data changes, so a space at their end
  // comes and goes.
  const Qos qos = MakeQos();
  void* data = nullptr;
  std::size_t size = 0;
  if (auto got = Check(dds_get_qos(handle(), qos.get()), "asking for the QoS"); !got) return got;
  std::string name;
  if (dds_qget_userdata(qos.get(), &data, &size) && data != nullptr) {
    name.assign(static_cast<const char*>(data), size);
    dds_free(data);
  }
  if (!name.empty() && name.back() == ' ') {
    name.pop_back();
  } else {
    name += ' ';
  }
  dds_qset_userdata(qos.get(), name.data(), name.size());
  return Check(dds_set_qos(handle(), qos.get()), "calling");
}

Result<Topic> Topic::Create(const Participant& participant, const dds_topic_descriptor_t& type,
                            const std::string& name) {
  const dds_entity_t handle =
      dds_create_topic(participant.handle(), &type, name.c_str(), nullptr, nullptr);
  if (handle < 0) return tl::unexpected(DdsError(handle, "creating topic " + name));
  return Topic(handle);
}

Result<Writer> Writer::Create(const Participant& participant, const Topic& topic, const Qos& qos) {
  const dds_entity_t handle =
      dds_create_writer(participant.handle(), topic.handle(), qos.get(), nullptr);
  if (handle < 0) return tl::unexpected(DdsError(handle, "creating a writer"));
  return Writer(handle);
}

Result<void> Writer::Write(const void* sample) {
  auto written = Gather(sample);
  Flush();
  return written;
}

Result<void> Writer::Gather(const void* sample) {
  return Check(dds_write(handle(), sample), "writing");
}

void Writer::Flush() { dds_write_flush(handle()); }

Result<void> Writer::Dispose(const void* sample) {
  auto disposed = Check(dds_dispose(handle(), sample), "disposing");
  Flush();
  return disposed;
}

Result<void> Writer::Unregister(const void* sample) {
  auto unregistered = Check(dds_unregister_instance(handle(), sample), "unregistering");
  Flush();
  return unregistered;
}

// Cyclone does this by sending a heartbeat.
void Writer::Remind() { dds_assert_liveliness(handle()); }

Result<void> Writer::WaitForAcks(std::chrono::milliseconds max_wait) {
  return Check(dds_wait_for_acks(handle(), ToDds(max_wait)), "waiting for acknowledgements");
}

int Writer::matched() const {
  dds_publication_matched_status_t status{};
  dds_get_publication_matched_status(handle(), &status);
  return static_cast<int>(status.current_count);
}

std::string Writer::refused_policy() const {
  dds_offered_incompatible_qos_status_t status{};
  dds_get_offered_incompatible_qos_status(handle(), &status);
  return status.total_count == 0 ? std::string() : PolicyName(status.last_policy_id);
}

Result<Reader> Reader::Create(const Participant& participant, const Topic& topic, const Qos& qos) {
  const dds_entity_t handle =
      dds_create_reader(participant.handle(), topic.handle(), qos.get(), nullptr);
  if (handle < 0) return tl::unexpected(DdsError(handle, "creating a reader"));
  return Reader(handle);
}

Result<Reader> Reader::CreateBuiltin(const Participant& participant, dds_entity_t topic) {
  const dds_entity_t handle = dds_create_reader(participant.handle(), topic, nullptr, nullptr);
  if (handle < 0) return tl::unexpected(DdsError(handle, "reading what Cyclone discovers"));
  return Reader(handle);
}

std::optional<dds_guid_t> Reader::ParticipantOf(dds_instance_handle_t writer) const {
  const EndpointPtr found = FindWriter(handle(), writer);
  return found ? std::optional(found->participant_key) : std::nullopt;
}

std::optional<std::string> Reader::PartitionOf(dds_instance_handle_t writer) const {
  const EndpointPtr found = FindWriter(handle(), writer);
  if (!found) return std::nullopt;
  std::uint32_t count = 0;
  char** names = nullptr;
  if (!dds_qget_partition(found->qos, &count, &names)) return std::nullopt;
  std::optional<std::string> partition;
  if (count == 1) partition = names[0];
  for (std::uint32_t i = 0; i < count; ++i) dds_free(names[i]);
  dds_free(static_cast<void*>(names));
  return partition;
}

Result<void> Reader::Take(std::size_t max,
                          const std::function<void(const void*, const dds_sample_info_t&)>& use) {
  constexpr std::size_t kAtOnce = 64;
  for (std::size_t taken = 0; taken < max;) {
    std::array<void*, kAtOnce> samples{};  // null means that Cyclone lends the samples
    std::array<dds_sample_info_t, kAtOnce> infos{};
    const dds_return_t count = dds_take(handle(), samples.data(), infos.data(), kAtOnce, kAtOnce);
    if (count < 0) return Check(count, "taking");
    if (count == 0) return {};
    const auto received = static_cast<std::size_t>(count);
    for (std::size_t i = 0; i < received; ++i) use(samples[i], infos[i]);
    if (auto ok = Check(dds_return_loan(handle(), samples.data(), count), "returning samples");
        !ok) {
      return ok;
    }
    taken += received;
  }
  return {};
}

bool Reader::Matches(dds_instance_handle_t writer) const {
  dds_builtintopic_endpoint_t* const found = dds_get_matched_publication_data(handle(), writer);
  if (found == nullptr) return false;
  dds_builtintopic_free_endpoint(found);
  return true;
}

int Reader::matched() const {
  dds_subscription_matched_status_t status{};
  dds_get_subscription_matched_status(handle(), &status);
  return static_cast<int>(status.current_count);
}

std::string Reader::refused_policy() const {
  dds_requested_incompatible_qos_status_t status{};
  dds_get_requested_incompatible_qos_status(handle(), &status);
  return status.total_count == 0 ? std::string() : PolicyName(status.last_policy_id);
}

Result<WaitSet> WaitSet::Create(const Participant& participant) {
  const dds_entity_t handle = dds_create_waitset(participant.handle());
  if (handle < 0) return tl::unexpected(DdsError(handle, "creating a wait set"));
  return WaitSet(handle);
}

Result<void> WaitSet::Attach(const Reader& reader) {
  // The condition belongs to the reader and is deleted with it.
  const dds_entity_t condition = dds_create_readcondition(reader.handle(), DDS_ANY_STATE);
  if (condition < 0) return tl::unexpected(DdsError(condition, "creating a read condition"));
  return Check(dds_waitset_attach(handle(), condition, condition), "attaching to a wait set");
}

Result<void> WaitSet::Wait(std::chrono::milliseconds max_wait) {
  return Check(dds_waitset_wait(handle(), nullptr, 0, ToDds(max_wait)), "waiting");
}

}  // namespace trailcast::dds
