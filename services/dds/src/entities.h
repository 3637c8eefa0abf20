#pragma once

#include <dds/dds.h>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "services/base/result.h"

namespace trailcast::dds {

// These classes own Cyclone's entities. Deleting an entity deletes what was made from it, so
// declare them in the order domain, participant, topics, readers and writers, wait set.

// Returns kUnavailable for a timeout, kInvalidArgument for a bad request, kInternal for the rest.
// The message has `doing` and Cyclone's reason.
[[nodiscard]] Error DdsError(dds_return_t code, const std::string& doing);

class Entity {
 public:
  Entity() = default;
  explicit Entity(dds_entity_t handle) : handle_(handle) {}
  ~Entity() { Reset(); }
  Entity(Entity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
  Entity& operator=(Entity&& other) noexcept {
    Reset();
    handle_ = std::exchange(other.handle_, 0);
    return *this;
  }
  Entity(const Entity&) = delete;
  Entity& operator=(const Entity&) = delete;

  [[nodiscard]] dds_entity_t handle() const { return handle_; }

 private:
  void Reset() {
    if (handle_ > 0) dds_delete(handle_);
    handle_ = 0;
  }
  dds_entity_t handle_ = 0;
};

struct QosDeleter {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, QosDeleter>;
[[nodiscard]] Qos MakeQos();

// A domain of this process with its own configuration (Cyclone XML). Several may be open at once
// and be the same on the network, because DomainConfig names the external id.
class Domain : public Entity {
 public:
  [[nodiscard]] static Result<Domain> Create(const std::string& config_xml);
  [[nodiscard]] dds_domainid_t id() const { return id_; }

 private:
  Domain(dds_entity_t handle, dds_domainid_t id) : Entity(handle), id_(id) {}
  dds_domainid_t id_;
};

class Participant : public Entity {
 public:
  // `user_data` is announced to everybody, and DDS tools show it. With `hidden`, the host and the
  // process, which Cyclone would announce as well, are left out.
  [[nodiscard]] static Result<Participant> Create(const Domain& domain,
                                                  const std::string& user_data,
                                                  bool hidden = false);
  // Announces the participant again, for those who were not there before.
  [[nodiscard]] Result<void> Call();

 private:
  using Entity::Entity;
};

class Topic : public Entity {
 public:
  [[nodiscard]] static Result<Topic> Create(const Participant& participant,
                                            const dds_topic_descriptor_t& type,
                                            const std::string& name);

 private:
  using Entity::Entity;
};

class Writer : public Entity {
 public:
  [[nodiscard]] static Result<Writer> Create(const Participant& participant, const Topic& topic,
                                             const Qos& qos);
  // kUnavailable means that a slow reader blocked it for the QoS's blocking time.
  [[nodiscard]] Result<void> Write(const void* sample);
  // Does the same, but in a domain that writes in batches it sends only when a packet is full, or
  // with Flush, Dispose or Unregister.
  [[nodiscard]] Result<void> Gather(const void* sample);
  void Flush();
  // Tells every reader that the instance with this sample's key is gone.
  [[nodiscard]] Result<void> Dispose(const void* sample);
  // Ends writing of that instance; what was written still arrives.
  [[nodiscard]] Result<void> Unregister(const void* sample);
  // Tells readers once more that there are samples, so that those who lack some ask for them.
  void Remind();
  // kUnavailable means that some reader did not get everything in time.
  [[nodiscard]] Result<void> WaitForAcks(std::chrono::milliseconds max_wait);
  // Returns the number of connected readers.
  [[nodiscard]] int matched() const;
  // Returns the policy for which a reader was last refused, or an empty text.
  [[nodiscard]] std::string refused_policy() const;

 private:
  using Entity::Entity;
};

class Reader : public Entity {
 public:
  [[nodiscard]] static Result<Reader> Create(const Participant& participant, const Topic& topic,
                                             const Qos& qos);
  // Makes a reader of one of Cyclone's own topics, DDS_BUILTIN_TOPIC_...
  [[nodiscard]] static Result<Reader> CreateBuiltin(const Participant& participant,
                                                    dds_entity_t topic);
  // Calls `use` with each sample received since the last call, at most `max`. The pointer is valid
  // only during the call. If valid_data is false, only the key fields are set.
  [[nodiscard]] Result<void> Take(
      std::size_t max, const std::function<void(const void*, const dds_sample_info_t&)>& use);
  // Says whether that writer still exists.
  [[nodiscard]] bool Matches(dds_instance_handle_t writer) const;
  // Returns the number of connected writers.
  [[nodiscard]] int matched() const;
  // Returns the policy for which a writer was last refused, or an empty text.
  [[nodiscard]] std::string refused_policy() const;
  // Returns the participant of a sample's writer, or nothing if the writer is gone.
  [[nodiscard]] std::optional<dds_guid_t> ParticipantOf(dds_instance_handle_t writer) const;
  // Returns the partition of a sample's writer, or nothing if the writer is gone or does not write
  // in exactly one.
  [[nodiscard]] std::optional<std::string> PartitionOf(dds_instance_handle_t writer) const;

 private:
  using Entity::Entity;
};

// Waits until one of its readers has something to take.
class WaitSet : public Entity {
 public:
  [[nodiscard]] static Result<WaitSet> Create(const Participant& participant);
  [[nodiscard]] Result<void> Attach(const Reader& reader);
  [[nodiscard]] Result<void> Wait(std::chrono::milliseconds max_wait);

 private:
  using Entity::Entity;
};

}  // namespace trailcast::dds
