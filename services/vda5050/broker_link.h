#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "services/base/result.h"

struct mosquitto;

namespace trailcast::vda5050 {

struct BrokerOptions {
  std::string host = "127.0.0.1";
  int port = 1883;
  std::string user{};
  std::string password{};
  std::string tls_ca{};           // PEM file of whom brokers' certificates are from; empty: no TLS
  std::string tls_certificate{};  // PEM files of this client's own; both or neither
  std::string tls_key{};
};

// A message of a topic. The broker keeps it if it is retained.
struct BrokerMessage {
  std::string topic{};
  std::string text{};
  int quality = 0;  // 0: at most once; 1: at least once
  bool retained = false;
};

// A client of an MQTT broker. The broker gives each client one last will, so each robot has a
// client of its own. It connects, and connects again after the broker was gone, on a thread of its
// own; other methods may be called by one other thread.
class BrokerLink {
 public:
  // More are dropped, the oldest first: strangers may send them.
  static constexpr std::size_t kMostWaiting = 64;

  // `will` is sent by the broker once this client is gone without a word. `subscribed` are the
  // topics that are heard. kInvalidArgument: the options are not usable.
  [[nodiscard]] static Result<std::unique_ptr<BrokerLink>> Open(
      const BrokerOptions& options, const std::string& client_id, BrokerMessage will,
      std::vector<std::string> subscribed);
  ~BrokerLink();
  BrokerLink(const BrokerLink&) = delete;
  BrokerLink& operator=(const BrokerLink&) = delete;

  struct Incoming {
    std::string topic{};
    std::string text{};  // empty if it has more bytes than are taken
    std::size_t bytes = 0;
  };
  // Returns what has come since the last call.
  [[nodiscard]] std::vector<Incoming> Take();
  [[nodiscard]] bool connected() const { return connected_; }
  // Returns how often it has connected.
  [[nodiscard]] std::uint64_t connections() const { return connections_; }
  // Sends it if it is connected; what cannot be sent is gone.
  void Publish(const BrokerMessage& message);
  // Sends a last message, waits for a moment that the broker has it, and disconnects: there is no
  // will then.
  void Close(const BrokerMessage& last);

 private:
  BrokerLink(const BrokerOptions& options, std::vector<std::string> subscribed);
  [[nodiscard]] Result<void> SetUp(const std::string& client_id, const BrokerMessage& will);
  [[nodiscard]] bool closed();
  void Run();
  void WaitBeforeNext();
  void Connected(int code);
  void Came(Incoming incoming);
  void Sent(int number);
  [[nodiscard]] std::string WhyNot(int code);
  void Tell(const std::string& trouble);

  const BrokerOptions options_;
  const std::vector<std::string> subscribed_;
  mosquitto* client_ = nullptr;
  std::atomic<bool> connected_{false};
  std::atomic<std::uint64_t> connections_{0};
  std::string trouble_{};  // as it was last logged; the thread's own, as is the next one
  std::string refusal_{};  // the broker's last words to a client that it does not let in

  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::deque<Incoming> incoming_{};
  int sent_ = 0;  // the last message that the broker has confirmed
  bool closed_ = false;

  std::thread thread_;
};

}  // namespace trailcast::vda5050
