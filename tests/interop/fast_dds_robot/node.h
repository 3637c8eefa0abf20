#pragma once

#include <cstdint>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <string>

namespace robot {

namespace dds = eprosima::fastdds::dds;

// This is how a ROS 2 node over Fast DDS is on the network by its environment (rmw_fastrtps).
enum class Setting {
  kDefault,         // all interfaces, multicast, shared memory
  kLocalhostOnly,   // ROS_LOCALHOST_ONLY=1
  kLocalhostRange,  // ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST
  kDataSharing,     // RMW_FASTRTPS_USE_QOS_FROM_XML=1, and profiles that share data where they can
};

// This is a participant with topics as ROS 2 names them and with the QoS of its sensor drivers:
// reliable, volatile, the last ones kept. It throws std::runtime_error.
class Node {
 public:
  Node(std::uint32_t domain, Setting setting);
  ~Node();
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  // `topic` is as in ROS 2, "/robot1/odom".
  dds::DataWriter* Write(const std::string& topic, dds::TypeSupport type);
  dds::DataReader* Read(const std::string& topic, dds::TypeSupport type);

 private:
  dds::Topic* TopicOf(const std::string& name, const dds::TypeSupport& type);

  Setting setting_;
  dds::DomainParticipant* participant_ = nullptr;
  dds::Publisher* publisher_ = nullptr;
  dds::Subscriber* subscriber_ = nullptr;
};

}  // namespace robot
