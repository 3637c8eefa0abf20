#include "node.h"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <memory>
#include <stdexcept>

#include "program.h"

namespace robot {
namespace {

namespace rtps = eprosima::fastdds::rtps;
using eprosima::fastrtps::rtps::IPLocator;
using eprosima::fastrtps::rtps::Locator_t;
using fast_dds::Made;

constexpr std::uint32_t kMostRobots = 32;  // that are looked for on this computer
constexpr int kDepth = 5;

dds::DomainParticipantQos QosOf(Setting setting) {
  dds::DomainParticipantQos qos = dds::PARTICIPANT_QOS_DEFAULT;
  qos.name("/");
  if (setting == Setting::kDefault || setting == Setting::kDataSharing) return qos;
  auto udp = std::make_shared<rtps::UDPv4TransportDescriptor>();
  if (setting == Setting::kLocalhostOnly) udp->interfaceWhiteList.emplace_back("127.0.0.1");
  if (setting == Setting::kLocalhostRange) {
    udp->maxInitialPeersRange = kMostRobots;
    auto& builtin = qos.wire_protocol().builtin;
    // A unicast address of its own keeps the multicast one from being listened to.
    builtin.metatrafficUnicastLocatorList.push_back(Locator_t());
    Locator_t localhost;
    IPLocator::setIPv4(localhost, "127.0.0.1");
    builtin.initialPeersList.push_back(localhost);
  }
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(std::make_shared<rtps::SharedMemTransportDescriptor>());
  qos.transport().user_transports.push_back(udp);
  return qos;
}

template <typename EndpointQos>
EndpointQos SensorQos(EndpointQos qos, Setting setting) {
  qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind = dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = kDepth;
  if (setting == Setting::kDataSharing) {
    qos.data_sharing().automatic();
  } else {
    qos.data_sharing().off();
  }
  qos.endpoint().history_memory_policy =
      eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  return qos;
}

}  // namespace

Node::Node(std::uint32_t domain, Setting setting) : setting_(setting) {
  participant_ = Made(
      dds::DomainParticipantFactory::get_instance()->create_participant(domain, QosOf(setting)),
      "participant");
  publisher_ = Made(participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT), "publisher");
  subscriber_ = Made(participant_->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT), "subscriber");
}

Node::~Node() {
  participant_->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

dds::Topic* Node::TopicOf(const std::string& name, const dds::TypeSupport& type) {
  if (type.register_type(participant_) != eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
    throw std::runtime_error("Fast DDS does not register " + type.get_type_name());
  }
  return Made(participant_->create_topic("rt" + name, type.get_type_name(), dds::TOPIC_QOS_DEFAULT),
              "topic " + name);
}

dds::DataWriter* Node::Write(const std::string& topic, dds::TypeSupport type) {
  auto qos = SensorQos(dds::DATAWRITER_QOS_DEFAULT, setting_);
  qos.publish_mode().kind = dds::ASYNCHRONOUS_PUBLISH_MODE;  // a picture is many fragments
  return Made(publisher_->create_datawriter(TopicOf(topic, type), qos), "writer of " + topic);
}

dds::DataReader* Node::Read(const std::string& topic, dds::TypeSupport type) {
  return Made(subscriber_->create_datareader(TopicOf(topic, type),
                                             SensorQos(dds::DATAREADER_QOS_DEFAULT, setting_)),
              "reader of " + topic);
}

}  // namespace robot
