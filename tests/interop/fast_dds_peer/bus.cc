#include "bus.h"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <memory>

#include "program.h"

namespace peer {
namespace {

namespace dds = eprosima::fastdds::dds;
using eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
using fast_dds::Made;

// Writers and readers have this in common. Samples may be of any size, with as much memory as each
// needs.
template <typename EndpointQos>
EndpointQos QosOf(EndpointQos qos, const TopicQos& row) {
  qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind =
      row.transient_local ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = row.keep_last == 0 ? dds::KEEP_ALL_HISTORY_QOS : dds::KEEP_LAST_HISTORY_QOS;
  if (row.keep_last > 0) qos.history().depth = row.keep_last;
  if (row.lease_s > 0) {
    qos.liveliness().kind = dds::AUTOMATIC_LIVELINESS_QOS;
    qos.liveliness().lease_duration = {row.lease_s, 0};
    qos.liveliness().announcement_period = {1, 0};
  }
  qos.endpoint().history_memory_policy = PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  return qos;
}

}  // namespace

Bus::Bus(std::uint32_t domain) {
  auto loopback = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  loopback->interfaceWhiteList.emplace_back("127.0.0.1");
  dds::DomainParticipantQos qos = dds::PARTICIPANT_QOS_DEFAULT;
  qos.name("fast-dds");
  qos.transport().use_builtin_transports = false;  // no shared memory
  qos.transport().user_transports.push_back(loopback);
  participant_ =
      Made(dds::DomainParticipantFactory::get_instance()->create_participant(domain, qos),
           "participant");
  publisher_ = Made(participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT), "publisher");
  // Segments come in the partitions of scopes (docs/reference/protocol.md), all else in the default
  // one.
  dds::SubscriberQos everything = dds::SUBSCRIBER_QOS_DEFAULT;
  everything.partition().push_back("");
  everything.partition().push_back("*");
  subscriber_ = Made(participant_->create_subscriber(everything), "subscriber");
}

Bus::~Bus() {
  participant_->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

dds::Topic* Bus::TopicOf(const std::string& name, const dds::TypeSupport& type) {
  if (auto* known = participant_->lookup_topicdescription(name)) {
    return dynamic_cast<dds::Topic*>(known);
  }
  if (type.register_type(participant_) != eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
    throw std::runtime_error("Fast DDS does not register " + type.get_type_name());
  }
  return Made(participant_->create_topic(name, type.get_type_name(), dds::TOPIC_QOS_DEFAULT),
              "topic " + name);
}

dds::DataWriter* Bus::Write(const std::string& topic, dds::TypeSupport type, const TopicQos& qos) {
  return Made(
      publisher_->create_datawriter(TopicOf(topic, type), QosOf(dds::DATAWRITER_QOS_DEFAULT, qos)),
      "writer of " + topic);
}

dds::DataReader* Bus::Read(const std::string& topic, dds::TypeSupport type, const TopicQos& qos) {
  auto* reader = Made(
      subscriber_->create_datareader(TopicOf(topic, type), QosOf(dds::DATAREADER_QOS_DEFAULT, qos)),
      "reader of " + topic);
  reader->get_statuscondition().set_enabled_statuses(dds::StatusMask::data_available());
  wait_set_.attach_condition(reader->get_statuscondition());
  return reader;
}

void Bus::Close(dds::DataReader* reader) {
  wait_set_.detach_condition(reader->get_statuscondition());
  subscriber_->delete_datareader(reader);
}

void Bus::Wait(std::chrono::milliseconds max_wait) {
  dds::ConditionSeq active;
  const auto ms = static_cast<std::uint32_t>(max_wait.count());
  wait_set_.wait(active, {static_cast<std::int32_t>(ms / 1000), ms % 1000 * 1'000'000});
}

}  // namespace peer
