#include "services/vda5050/broker_link.h"

#include <mosquitto.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <utility>

#include "services/base/text.h"
#include "services/vda5050/protocol.h"

namespace trailcast::vda5050 {
namespace {

using std::chrono::milliseconds;

constexpr int kKeepAlive_s = 10;
constexpr int kLoop_ms = 100;
constexpr int kLastLoops = 10;
constexpr milliseconds kConnectAgain{1000};
constexpr milliseconds kLastMessage{2000};

void InitialiseOnce() {
  static const int initialised = mosquitto_lib_init();
  (void)initialised;
}

Result<void> Check(int code, const char* doing) {
  if (code == MOSQ_ERR_SUCCESS) return {};
  return Fail(ErrorCode::kInvalidArgument, "MQTT: {}: {}", doing, mosquitto_strerror(code));
}

const char* OrNull(const std::string& text) { return text.empty() ? nullptr : text.c_str(); }

}  // namespace

Result<std::unique_ptr<BrokerLink>> BrokerLink::Open(const BrokerOptions& options,
                                                     const std::string& client_id,
                                                     BrokerMessage will,
                                                     std::vector<std::string> subscribed) {
  InitialiseOnce();
  std::unique_ptr<BrokerLink> link(new BrokerLink(options, std::move(subscribed)));
  if (auto set_up = link->SetUp(client_id, will); !set_up) return tl::unexpected(set_up.error());
  link->thread_ = std::thread([raw = link.get()] { raw->Run(); });
  return link;
}

BrokerLink::BrokerLink(const BrokerOptions& options, std::vector<std::string> subscribed)
    : options_(options), subscribed_(std::move(subscribed)) {}

Result<void> BrokerLink::SetUp(const std::string& client_id, const BrokerMessage& will) {
  client_ = mosquitto_new(client_id.c_str(), true, this);
  if (client_ == nullptr) {
    return Fail(ErrorCode::kInvalidArgument, "MQTT: '{}' is no client's id", client_id);
  }
  if (auto set = Check(mosquitto_threaded_set(client_, true), "threads"); !set) return set;
  if (auto set =
          Check(mosquitto_will_set(client_, will.topic.c_str(), static_cast<int>(will.text.size()),
                                   will.text.data(), will.quality, will.retained),
                "the last will");
      !set) {
    return set;
  }
  if (!options_.user.empty()) {
    if (auto set = Check(
            mosquitto_username_pw_set(client_, options_.user.c_str(), OrNull(options_.password)),
            "user and password");
        !set) {
      return set;
    }
  }
  if (!options_.tls_ca.empty()) {
    if (auto set = Check(
            mosquitto_tls_set(client_, options_.tls_ca.c_str(), nullptr,
                              OrNull(options_.tls_certificate), OrNull(options_.tls_key), nullptr),
            "TLS files");
        !set) {
      return set;
    }
  }
  mosquitto_connect_callback_set(client_, [](mosquitto*, void* self, int code) {
    static_cast<BrokerLink*>(self)->Connected(code);
  });
  mosquitto_disconnect_callback_set(client_, [](mosquitto*, void* self, int) {
    static_cast<BrokerLink*>(self)->connected_ = false;
  });
  mosquitto_publish_callback_set(client_, [](mosquitto*, void* self, int number) {
    static_cast<BrokerLink*>(self)->Sent(number);
  });
  mosquitto_message_callback_set(
      client_, [](mosquitto*, void* self, const mosquitto_message* message) {
        Incoming incoming;
        incoming.topic = message->topic;
        incoming.bytes = static_cast<std::size_t>(message->payloadlen);
        if (message->retain) {
          spdlog::warn("broker: a retained message on {} is not taken: what it asks for may be old",
                       PlainText(incoming.topic, 200));
          return;
        }
        if (incoming.bytes <= kMostBytes) {
          incoming.text.assign(static_cast<const char*>(message->payload), incoming.bytes);
        }
        static_cast<BrokerLink*>(self)->Came(std::move(incoming));
      });
  return {};
}

BrokerLink::~BrokerLink() {
  {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
  if (client_ != nullptr) mosquitto_destroy(client_);
}

bool BrokerLink::closed() {
  const std::scoped_lock lock(mutex_);
  return closed_;
}

void BrokerLink::Run() {
  // Over TLS the library connects only while it waits.
  const bool waits = !options_.tls_ca.empty();
  const auto connect = waits ? mosquitto_connect : mosquitto_connect_async;
  int code = connect(client_, options_.host.c_str(), options_.port, kKeepAlive_s);
  while (!closed()) {
    if (code == MOSQ_ERR_SUCCESS) {
      code = mosquitto_loop(client_, kLoop_ms, 1);
      continue;
    }
    connected_ = false;
    Tell(WhyNot(code));
    WaitBeforeNext();
    if (closed()) return;
    code = waits ? mosquitto_reconnect(client_) : mosquitto_reconnect_async(client_);
  }
  // The last message and the good-bye are still to be sent.
  for (int i = 0; i < kLastLoops && connected_ && code == MOSQ_ERR_SUCCESS; ++i) {
    code = mosquitto_loop(client_, kLoop_ms, 1);
  }
}

void BrokerLink::WaitBeforeNext() {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, kConnectAgain, [&] { return closed_; });
}

std::string BrokerLink::WhyNot(int code) {
  if (!refusal_.empty()) return std::exchange(refusal_, {});
  if (code == MOSQ_ERR_TLS) {
    return "TLS failed: the broker's certificate is not from whom --tls-ca names, or not for this "
           "HOST";
  }
  if (connections_ == 0 && code == MOSQ_ERR_CONN_LOST && options_.tls_ca.empty()) {
    return "it ends the connection at once: if it asks for TLS, give --tls-ca";
  }
  return mosquitto_strerror(code);
}

void BrokerLink::Tell(const std::string& trouble) {
  if (trouble == trouble_) return;
  trouble_ = trouble;
  spdlog::warn("broker: no connection to {}:{}: {}; trying again", options_.host, options_.port,
               trouble);
}

void BrokerLink::Connected(int code) {
  if (code != 0) {
    refusal_ = mosquitto_connack_string(code);
    return;
  }
  for (const std::string& topic : subscribed_) {
    (void)mosquitto_subscribe(client_, nullptr, topic.c_str(), 0);
  }
  if (!trouble_.empty()) spdlog::info("broker: connected to {}:{}", options_.host, options_.port);
  trouble_.clear();
  ++connections_;
  connected_ = true;
}

void BrokerLink::Came(Incoming incoming) {
  const std::scoped_lock lock(mutex_);
  if (incoming_.size() >= kMostWaiting) incoming_.pop_front();
  incoming_.push_back(std::move(incoming));
}

void BrokerLink::Sent(int number) {
  {
    const std::scoped_lock lock(mutex_);
    sent_ = number;
  }
  changed_.notify_all();
}

std::vector<BrokerLink::Incoming> BrokerLink::Take() {
  const std::scoped_lock lock(mutex_);
  std::vector<Incoming> taken(std::make_move_iterator(incoming_.begin()),
                              std::make_move_iterator(incoming_.end()));
  incoming_.clear();
  return taken;
}

void BrokerLink::Publish(const BrokerMessage& message) {
  if (!connected_) return;
  (void)mosquitto_publish(client_, nullptr, message.topic.c_str(),
                          static_cast<int>(message.text.size()), message.text.data(),
                          message.quality, message.retained);
}

void BrokerLink::Close(const BrokerMessage& last) {
  if (connected_) {
    int number = 0;
    const int code =
        mosquitto_publish(client_, &number, last.topic.c_str(), static_cast<int>(last.text.size()),
                          last.text.data(), last.quality, last.retained);
    std::unique_lock lock(mutex_);
    if (code == MOSQ_ERR_SUCCESS) {
      changed_.wait_for(lock, kLastMessage, [&] { return sent_ == number; });
    }
    lock.unlock();
    (void)mosquitto_disconnect(client_);
  }
  {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

}  // namespace trailcast::vda5050
