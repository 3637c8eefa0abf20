#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "services/base/result.h"
#include "services/console/driving.h"
#include "services/console/fleet_state.h"
#include "services/exchange/route_exchange.h"
#include "services/fleet/now_client.h"
#include "services/http/metrics_text.h"

namespace trailcast::console {

class Errand;

// What the console reads and writes.
[[nodiscard]] exchange::TopicUse ConsoleTopics();
// The same of one with the keys of an observer, that tells nobody what to do.
[[nodiscard]] exchange::TopicUse LookingTopics();

// The console's place in the fleet: a thread that owns the exchange, keeps the state, and does what
// others ask of it. Its methods may be called from any thread; they wait for what they return.
class Desk {
 public:
  struct Options {
    std::chrono::milliseconds answer_within{3000};  // robots
    std::chrono::milliseconds reply_within{5000};  // robots and servers, to a mission or a question
    std::chrono::milliseconds ask_every{30'000};   // for missions, while somebody looks: news of
                                                   // them are told unasked
    std::chrono::milliseconds looks_on{3000};      // who looked so lately
    Alerts alerts{};                               // of before
    // Given what is to be kept of them, on the desk's thread: it does not wait.
    std::function<void(std::string)> keep_alerts{};
  };
  // Asked at once beyond what stops robots: more are refused.
  static constexpr std::size_t kMostErrands = 16;
  static constexpr std::size_t kMostStops = 64;
  static constexpr std::size_t kMostLooks = 8;  // robots
  // The state is told at most so often.
  static constexpr std::chrono::milliseconds kNewsEvery{200};
  // Whether somebody has to see to something is looked at so often, whoever looks.
  static constexpr std::chrono::milliseconds kSeeToEvery{500};

  Desk(AgentId self, std::unique_ptr<exchange::RouteExchange> exchange, Options options);
  Desk(AgentId self, std::unique_ptr<exchange::RouteExchange> exchange)
      : Desk(std::move(self), std::move(exchange), Options{}) {}
  ~Desk();
  Desk(const Desk&) = delete;
  Desk& operator=(const Desk&) = delete;

  // What each robot answered, as fleet::TellRobots has it. kUnavailable: nobody was heard that is
  // meant, or too much is asked at once; a stop has room of its own and goes before all else.
  [[nodiscard]] Result<std::vector<fleet::RobotsWord>> Tell(exchange::NowOrder order,
                                                            const fleet::NowTarget& target,
                                                            const std::string& reason);
  // Its client is filled in. As fleet::SendMission: what is known of it first. kNotFound: neither
  // this console nor a server has ever heard of such a robot; `also_unheard` sends it all the same.
  [[nodiscard]] Result<mission::Report> Send(mission::Mission mission, bool also_unheard = false);
  // Alerts: all that are kept, as openapi.yaml has them, and whether they outlive the console.
  [[nodiscard]] Result<nlohmann::ordered_json> AllAlerts();
  [[nodiscard]] bool keeps_alerts() const { return options_.keep_alerts != nullptr; }
  // As Alerts::Acknowledge.
  [[nodiscard]] Result<void> Acknowledge(const std::string& alert, const std::string& by);
  // As FleetState::Forget; alerts about it end.
  [[nodiscard]] Result<void> Forget(const AgentId& robot);
  // Passes on how a robot that teaches is to be driven, and waits for nothing.
  [[nodiscard]] Driving::Verdict Drive(const AgentId& robot, const Driving::Word& word) {
    return driving_.Hear(robot, word, Clock::now());
  }
  // A page of what servers keep, the newest first.
  [[nodiscard]] Result<exchange::MissionReply> Missions(const mission::Query& query);
  [[nodiscard]] Result<exchange::MissionReply> Commands(const mission::Query& query);
  // What a server has, or finds, of routes.
  [[nodiscard]] Result<exchange::CatalogReply> Routes(const route::RouteQuery& query);
  // The revisions that have changed. kConflict: a server says why it changes nothing.
  [[nodiscard]] Result<exchange::CatalogReply> Edit(const route::RouteEdit& edit);
  // A page of what a server answers, from its line `first` on: to "way FROM TO", or, to no words,
  // how routes are joined. kConflict: a server says why not.
  [[nodiscard]] Result<exchange::NetworkReply> Network(const std::string& words,
                                                       std::uint32_t first);
  // Has servers change that, in words; what is so now. kConflict likewise.
  [[nodiscard]] Result<exchange::NetworkReply> Join(const std::string& words);

  // All that is measured, for Prometheus.
  [[nodiscard]] Result<http::MetricsText> Measure();
  // What a robot's camera sees now; those who look through the same one at once share the picture.
  // Null: it did not answer. kUnavailable: too many are looked through at once.
  [[nodiscard]] Result<std::shared_ptr<const exchange::Glance>> Look(const AgentId& robot);

  struct News {
    std::uint64_t number = 0;  // counts up from 1
    std::shared_ptr<const nlohmann::ordered_json> state{};
  };
  // The latest, once that is newer than `number`; null when nothing has changed within `most`, or
  // the desk is closed. Who asks looks: only while somebody does is there news, and are servers
  // asked.
  [[nodiscard]] std::shared_ptr<const News> See(std::uint64_t number,
                                                std::chrono::milliseconds most);

  // Nothing is taken on any more, and whoever waits is let go.
  void Close();
  [[nodiscard]] bool closed();
  // Why its thread has ended by itself, which closes it; nothing: it has not.
  [[nodiscard]] std::optional<Error> failed();

 private:
  using Clock = std::chrono::steady_clock;
  using Seen = Result<std::shared_ptr<const exchange::Glance>>;

  [[nodiscard]] std::optional<Error> Unknown(const AgentId& robot);
  [[nodiscard]] Result<exchange::MissionReply> AskHistory(exchange::MissionRequest request);
  void Run();
  void ServeUntilClosed();
  template <typename AnErrand>
  [[nodiscard]] auto CarryOut(std::shared_ptr<AnErrand> errand, bool is_stop,
                              std::chrono::milliseconds timeout);
  // False: it is one too many.
  [[nodiscard]] bool Take(std::shared_ptr<Errand> errand, bool is_stop);
  // Not valid: it is one too many.
  [[nodiscard]] std::shared_future<Seen> LookUnderWay(const AgentId& robot);
  void Begin();
  void Say(Clock::time_point now);
  void Hear(const exchange::Message& message, Clock::time_point now);
  [[nodiscard]] bool SomebodyLooks(Clock::time_point now);
  void AskServers(Clock::time_point now);
  void SeeTo(Clock::time_point now);
  void NoteAlerts(Clock::time_point now);
  void ShowNews(Clock::time_point now);

  const AgentId self_;
  const Options options_;

  // The thread's own.
  std::unique_ptr<exchange::RouteExchange> exchange_;
  FleetState state_;
  Alerts alerts_;
  std::uint64_t alerts_kept_ = 0;
  Clock::time_point see_to_at_{};
  std::vector<std::shared_ptr<Errand>> errands_;
  Clock::time_point asked_at_{};
  Clock::time_point ask_at_{};
  Clock::time_point show_at_{};

  Driving driving_;

  std::mutex mutex_;  // guards what follows
  bool closed_ = false;
  std::optional<Error> failed_;
  std::deque<std::shared_ptr<Errand>> stops_;
  std::deque<std::shared_ptr<Errand>> others_;
  std::size_t under_way_ = 0;  // of the others, those that wait included
  std::uint64_t refused_ = 0;
  std::map<AgentId, std::shared_future<Seen>> looks_;
  std::uint64_t news_count_ = 0;
  std::shared_ptr<const News> news_;  // null while nobody looks
  int looking_ = 0;                   // who waits in See now
  Clock::time_point looked_at_{};
  std::condition_variable changed_;

  std::thread thread_;
};

}  // namespace trailcast::console
