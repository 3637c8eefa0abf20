#include "services/exchange/in_process_exchange.h"

#include <algorithm>
#include <array>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>

#include "services/exchange/batches.h"
#include "services/exchange/bounds.h"
#include "services/exchange/topics.h"

namespace trailcast::exchange {
namespace {

// This holds what an exchange has received and not yet taken, with a queue for each topic, as DDS
// has readers.
class Inbox {
 public:
  void Push(Topic topic, const std::string& instance, const Message& message) {
    auto& queue = queues_[static_cast<std::size_t>(topic)];
    // With keep-last 1 the newer sample replaces one that was not taken in time.
    if (!instance.empty()) {
      std::erase_if(queue, [&](const Entry& entry) { return entry.instance == instance; });
    }
    queue.push_back({instance, message});
  }

  [[nodiscard]] bool empty() const {
    return std::all_of(queues_.begin(), queues_.end(), [](const auto& q) { return q.empty(); });
  }

  std::vector<Message> TakeAll() {
    std::vector<Message> messages;
    for (auto& queue : queues_) {
      for (Entry& entry : queue) messages.push_back(std::move(entry.message));
      queue.clear();
    }
    return messages;
  }

 private:
  struct Entry {
    std::string instance;
    Message message;
  };
  std::array<std::deque<Entry>, kTopics> queues_;
};

struct Member {
  [[nodiscard]] bool Hears(Topic topic, const Message& message) const {
    if (use.Hears(topic)) return true;
    const route::RouteKey* route = RouteOf(message);
    return use.Listens(topic) && route != nullptr && listening.contains({topic, *route});
  }

  TopicUse use;
  std::set<std::pair<Topic, route::RouteKey>> listening;
  Inbox inbox;
  std::map<std::string, Message>
      // These are its samples on transient-local topics, by instance.
      latest;
};

}  // namespace

struct InProcessBus::State {
  std::mutex mutex;
  std::condition_variable arrived;
  std::vector<Member*> members;  // the exchanges own them

  void Join(Member& member) {
    const std::scoped_lock lock(mutex);
    for (const Member* other : members) {
      for (const auto& [instance, message] : other->latest) {
        const Topic topic = *TopicOf(message);
        if (member.use.Reads(topic)) member.inbox.Push(topic, instance, message);
      }
    }
    members.push_back(&member);
  }

  void Leave(const Member& member) {
    const std::scoped_lock lock(mutex);
    std::erase(members, &member);
    for (const auto& [instance, message] : member.latest) {
      const auto* status = std::get_if<AgentStatus>(&message);
      if (status == nullptr) continue;
      const AgentGone gone{status->agent, status->instance};
      // The instance is not the status's. As over DDS, a last status that was not taken yet comes
      // before the end.
      Send(member, Topic::kAgents, "", gone);
    }
    arrived.notify_all();
  }

  // The caller holds the mutex.
  void Send(const Member& sender, Topic topic, const std::string& instance,
            const Message& message) {
    for (Member* member : members) {
      if (member != &sender && member->Hears(topic, message)) {
        member->inbox.Push(topic, instance, message);
      }
    }
  }
};

namespace {

class InProcessExchange : public RouteExchange {
 public:
  InProcessExchange(std::shared_ptr<InProcessBus::State> bus, const TopicUse& use)
      : bus_(std::move(bus)), self_{.use = use, .listening = {}, .inbox = {}, .latest = {}} {
    bus_->Join(self_);
  }
  ~InProcessExchange() override { bus_->Leave(self_); }
  InProcessExchange(const InProcessExchange&) = delete;
  InProcessExchange& operator=(const InProcessExchange&) = delete;

  Result<void> Publish(const Message& message) override {
    const std::optional<Topic> topic = TopicOf(message);
    if (!topic || !self_.use.Writes(*topic)) {
      return Fail(ErrorCode::kInvalidArgument, "{} was not opened for writing",
                  topic ? NameOf(*topic) : "AgentGone is no topic and");
    }
    if (auto ok = CheckBounds(message); !ok) return ok;
    const std::string instance = InstanceOf(message);
    const std::scoped_lock lock(bus_->mutex);
    if (!instance.empty()) self_.latest.insert_or_assign(instance, message);
    if (const auto* batch = std::get_if<SegmentBatch>(&message)) {
      for (const SegmentBatch& part : SplitBatch(*batch)) bus_->Send(self_, *topic, "", part);
    } else {
      bus_->Send(self_, *topic, instance, message);
    }
    bus_->arrived.notify_all();
    return {};
  }

  std::vector<Message> Take(std::chrono::milliseconds max_wait) override {
    std::unique_lock lock(bus_->mutex);
    bus_->arrived.wait_for(lock, max_wait, [this] { return !self_.inbox.empty(); });
    return self_.inbox.TakeAll();
  }

  Result<void> Listen(Topic topic, const std::set<route::RouteKey>& routes) override {
    const std::scoped_lock lock(bus_->mutex);
    std::erase_if(self_.listening, [&](const auto& each) { return each.first == topic; });
    for (const route::RouteKey& route : routes) self_.listening.emplace(topic, route);
    return {};
  }

  // Publish checks bounds, so nothing out of bounds ever arrives.
  [[nodiscard]] std::uint64_t dropped() const override { return 0; }

 private:
  std::shared_ptr<InProcessBus::State> bus_;
  Member self_;
};

}  // namespace

InProcessBus::InProcessBus() : state_(std::make_shared<State>()) {}
InProcessBus::~InProcessBus() = default;

std::unique_ptr<RouteExchange> InProcessBus::Open(const TopicUse& use) {
  return std::make_unique<InProcessExchange>(state_, use);
}

}  // namespace trailcast::exchange
