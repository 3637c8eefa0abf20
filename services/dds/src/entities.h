#pragma once

#include <dds/dds.h>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "services/base/result.h"

namespace trailcast::dds {

// Cyclone's entities as owners of their handles. Deleting an entity deletes what was made from it,
// so declare them in the order domain, participant, topics, readers and writers, wait set.

// kUnavailable for a timeout, kInvalidArgument for what was asked for, kInternal for the rest;
// names `doing` and Cyclone's reason.
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

// A domain of this process with its own configuration (Cyclone XML). Several may be open at once,
// and on the network be one and the same: DomainConfig names the external id.
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
  // `user_data` is told to everybody, and shown by DDS tools. `hidden`: but nothing else is, not
  // host and process, which Cyclone would tell.
  [[nodiscard]] static Result<Participant> Create(const Domain& domain,
                                                  const std::string& user_data,
                                                  bool hidden = false);
  // Tells of itself once more, now: who was not there may be now.
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
  // kUnavailable when a reader that does not keep up blocked it for the QoS's blocking time.
  [[nodiscard]] Result<void> Write(const void* sample);
  // The same, but sent when it fills a packet with others, or by Flush, Dispose or Unregister; in
  // a domain that writes in batches.
  [[nodiscard]] Result<void> Gather(const void* sample);
  void Flush();
  // The instance with this sample's key is gone: said to every reader.
  [[nodiscard]] Result<void> Dispose(const void* sample);
  // Nothing more is said of that instance: what was written still arrives.
  [[nodiscard]] Result<void> Unregister(const void* sample);
  // Tells readers once more what was written: who lacks some of it asks for it.
  void Remind();
  // kUnavailable if some reader has not got everything by then.
  [[nodiscard]] Result<void> WaitForAcks(std::chrono::milliseconds max_wait);
  // Readers that get what is written.
  [[nodiscard]] int matched() const;
  // The policy for which a reader was last refused; empty: none was.
  [[nodiscard]] std::string refused_policy() const;

 private:
  using Entity::Entity;
};

class Reader : public Entity {
 public:
  [[nodiscard]] static Result<Reader> Create(const Participant& participant, const Topic& topic,
                                             const Qos& qos);
  // Of one of Cyclone's own topics, DDS_BUILTIN_TOPIC_...
  [[nodiscard]] static Result<Reader> CreateBuiltin(const Participant& participant,
                                                    dds_entity_t topic);
  // Gives each sample received since the last call to `use`, whose pointer is valid during the call
  // only. With valid_data false only the key fields are set. At most `max` samples.
  [[nodiscard]] Result<void> Take(
      std::size_t max, const std::function<void(const void*, const dds_sample_info_t&)>& use);
  // Whether that writer is still there.
  [[nodiscard]] bool Matches(dds_instance_handle_t writer) const;
  // Writers from which it gets samples.
  [[nodiscard]] int matched() const;
  // The policy for which a writer was last refused; empty: none was.
  [[nodiscard]] std::string refused_policy() const;
  // Whose a writer is that a sample came from; nothing if that writer is gone.
  [[nodiscard]] std::optional<dds_guid_t> ParticipantOf(dds_instance_handle_t writer) const;
  // The partition of a writer that a sample came from; nothing if that writer is gone, or writes in
  // none or several.
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
