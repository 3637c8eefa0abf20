#pragma once

#include <chrono>
#include <cstdint>
#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace peer {

// These are the QoS columns of a topic's row in docs/reference/protocol.md. All topics are
// reliable.
struct TopicQos {
  bool transient_local = false;
  int keep_last = 0;  // 0 keeps all
  int lease_s = 0;    // automatic liveliness; 0 is none
};
inline constexpr TopicQos kAnnounced{.transient_local = true, .keep_last = 1};
inline constexpr TopicQos kAgents{.transient_local = true, .keep_last = 1, .lease_s = 3};
inline constexpr TopicQos kAsked{.keep_last = 16};
inline constexpr TopicQos kStreamed{};

// This is a participant of a DDS domain on the loopback interface, and nowhere else.
class Bus {
 public:
  explicit Bus(std::uint32_t domain);
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  // Writers last as long as the bus. The type is registered under the name that the IDL gives it.
  eprosima::fastdds::dds::DataWriter* Write(const std::string& topic,
                                            eprosima::fastdds::dds::TypeSupport type,
                                            const TopicQos& qos);
  eprosima::fastdds::dds::DataReader* Read(const std::string& topic,
                                           eprosima::fastdds::dds::TypeSupport type,
                                           const TopicQos& qos);
  void Close(eprosima::fastdds::dds::DataReader* reader);
  // Waits until one of the readers has something to take, or for so long.
  void Wait(std::chrono::milliseconds max_wait);

 private:
  eprosima::fastdds::dds::Topic* TopicOf(const std::string& name,
                                         const eprosima::fastdds::dds::TypeSupport& type);

  eprosima::fastdds::dds::DomainParticipant* participant_ = nullptr;
  eprosima::fastdds::dds::Publisher* publisher_ = nullptr;
  eprosima::fastdds::dds::Subscriber* subscriber_ = nullptr;
  eprosima::fastdds::dds::WaitSet wait_set_;
};

// This is a topic's writer for samples of its type. `PubSub` is the generated class beside the
// type.
template <typename PubSub>
class Outlet {
 public:
  Outlet(Bus& bus, const std::string& topic, const TopicQos& qos)
      : topic_(topic),
        writer_(bus.Write(topic, eprosima::fastdds::dds::TypeSupport(new PubSub()), qos)) {}

  void Put(typename PubSub::type sample) {
    if (!writer_->write(&sample)) throw std::runtime_error("cannot write to " + topic_);
  }
  // Returns whether the topic has a reader, and every known reader has all that was put.
  bool IsHeard() {
    eprosima::fastdds::dds::PublicationMatchedStatus matched;
    writer_->get_publication_matched_status(matched);
    return matched.current_count > 0 && writer_->wait_for_acknowledgments({0, 1}) ==
                                            eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
  }

 private:
  std::string topic_;
  eprosima::fastdds::dds::DataWriter* writer_;
};

// This is a topic's reader.
template <typename PubSub>
class Inlet {
 public:
  Inlet(Bus& bus, const std::string& topic, const TopicQos& qos)
      : bus_(bus),
        reader_(bus.Read(topic, eprosima::fastdds::dds::TypeSupport(new PubSub()), qos)) {}
  ~Inlet() { bus_.Close(reader_); }
  Inlet(const Inlet&) = delete;
  Inlet& operator=(const Inlet&) = delete;

  // Returns what came since the last call.
  std::vector<typename PubSub::type> Take() {
    std::vector<typename PubSub::type> samples;
    typename PubSub::type sample;
    eprosima::fastdds::dds::SampleInfo info;
    while (reader_->take_next_sample(&sample, &info) ==
           eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
      if (info.valid_data) samples.push_back(sample);
    }
    return samples;
  }

 private:
  Bus& bus_;
  eprosima::fastdds::dds::DataReader* reader_;
};

}  // namespace peer
