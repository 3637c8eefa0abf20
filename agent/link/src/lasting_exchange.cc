#include "agent/link/lasting_exchange.h"

#include <utility>
#include <variant>

#include "services/exchange/topics.h"

namespace trailcast::agent {

using exchange::Message;
using std::chrono::milliseconds;

class LastingExchange::Visitor : public exchange::RouteExchange {
 public:
  explicit Visitor(LastingExchange& host) : host_(host), at_first_(host.Remembered()) {}
  // Nobody needs the visit's topics any more. One that cannot be left costs a little traffic.
  ~Visitor() override {
    (void)host_.exchange_->Listen(exchange::Topic::kSegments, {});
    (void)host_.exchange_->Listen(exchange::Topic::kNeighbours, {});
  }
  Visitor(const Visitor&) = delete;
  Visitor& operator=(const Visitor&) = delete;

  Result<void> Publish(const Message& message) override {
    if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) {
      host_.tending_.saw_status(*status);
    }
    return host_.exchange_->Publish(message);
  }
  void Gather() override { host_.exchange_->Gather(); }
  void Flush() override { host_.exchange_->Flush(); }
  std::vector<Message> Take(milliseconds max_wait) override {
    if (!at_first_.empty()) return std::exchange(at_first_, {});
    return host_.Take(max_wait);
  }
  Result<void> Listen(exchange::Topic topic, const std::set<route::RouteKey>& routes) override {
    return host_.exchange_->Listen(topic, routes);
  }
  [[nodiscard]] std::uint64_t dropped() const override { return host_.exchange_->dropped(); }

 private:
  LastingExchange& host_;
  std::vector<Message> at_first_;
};

std::vector<Message> LastingExchange::Take(milliseconds max_wait) {
  std::vector<Message> messages = exchange_->Take(max_wait);
  for (const Message& message : messages) {
    Remember(message);
    tending_.hear(message);
  }
  tending_.say(*exchange_);
  return messages;
}

std::unique_ptr<exchange::RouteExchange> LastingExchange::Visit() {
  return std::make_unique<Visitor>(*this);
}

void LastingExchange::Remember(const Message& message) {
  if (const auto* gone = std::get_if<exchange::AgentGone>(&message)) {
    exchange::AgentStatus status;
    status.agent = gone->agent;
    status.instance = gone->instance;
    remembered_.Erase(exchange::InstanceOf(status));
    return;
  }
  const std::string instance = exchange::InstanceOf(message);
  if (!instance.empty()) remembered_.Touch(instance) = message;
}

std::vector<Message> LastingExchange::Remembered() const {
  std::vector<Message> messages;
  for (const auto& [instance, message] : remembered_) messages.push_back(message);
  return messages;
}

}  // namespace trailcast::agent
