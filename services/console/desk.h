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
#include "services/fleet/photo_client.h"
#include "services/http/metrics_text.h"

namespace trailcast::console {

class Errand;

// Returns the topics that the console reads and writes.
[[nodiscard]] exchange::TopicUse ConsoleTopics();
// Returns the topics of a console with an observer's keys, which commands no robot.
[[nodiscard]] exchange::TopicUse LookingTopics();

// This is the console's member of the fleet: a thread that owns the exchange, keeps the state, and
// carries out the requests of other threads. Its methods may be called from any thread, and wait
// for what they return.
class Desk {
 public:
  struct Options {
    std::chrono::milliseconds answer_within{3000};  // answers of robots to a command
    std::chrono::milliseconds reply_within{5000};   // replies to a mission or a question
    std::chrono::milliseconds ask_every{30'000};    // missions, while a page is open
    std::chrono::milliseconds looks_on{3000};       // a page counts as open for this long
    // This is the time by which robots are driven.
    std::function<Driving::Time()> driving_clock = &std::chrono::steady_clock::now;
    Alerts alerts{};  // alerts from before
    // This gets what is to be kept of alerts, on the desk's thread, and must not wait.
    std::function<void(std::string)> keep_alerts{};
    // This gets all alerts, and the last missions, several times a second, likewise.
    std::function<void(nlohmann::ordered_json alerts, nlohmann::ordered_json missions)> look{};
    std::function<void(http::MetricsText& text)> measure{};  // adds metrics, on any thread
  };
  // So many errands, apart from stops, are under way at once. More are refused.
  static constexpr std::size_t kMostErrands = 16;
  static constexpr std::size_t kMostStops = 64;
  static constexpr std::size_t kMostLooks = 8;  // cameras
  // The state is published at most so often.
  static constexpr std::chrono::milliseconds kNewsEvery{200};
  // Alerts are updated so often, whether or not a page is open.
  static constexpr std::chrono::milliseconds kSeeToEvery{500};

  Desk(AgentId self, std::unique_ptr<exchange::RouteExchange> exchange, Options options);
  Desk(AgentId self, std::unique_ptr<exchange::RouteExchange> exchange)
      : Desk(std::move(self), std::move(exchange), Options{}) {}
  ~Desk();
  Desk(const Desk&) = delete;
  Desk& operator=(const Desk&) = delete;

  // Commands robots, and returns what each answered, as fleet::TellRobots does. Fails with
  // kUnavailable if no robot was heard that it is for, or too much is asked at once. A stop has
  // room of its own and precedes all else.
  [[nodiscard]] Result<std::vector<fleet::RobotsWord>> Tell(exchange::NowOrder order,
                                                            const fleet::NowTarget& target,
                                                            const std::string& reason);
  // Sends a mission, whose client it sets, and returns what is known of it first, as
  // fleet::SendMission does. Fails with kNotFound if neither this console nor a server has ever
  // heard of such a robot; `also_unheard` sends it all the same.
  [[nodiscard]] Result<std::vector<mission::Report>> Send(mission::Mission mission,
                                                          bool also_unheard = false);
  // Returns all alerts that are kept, as openapi.yaml has them.
  [[nodiscard]] Result<nlohmann::ordered_json> AllAlerts();
  [[nodiscard]] bool keeps_alerts() const { return options_.keep_alerts != nullptr; }
  // Does as Alerts::Acknowledge.
  [[nodiscard]] Result<void> Acknowledge(const std::string& alert, const std::string& by);
  // Does as FleetState::Forget, and ends alerts about the robot.
  [[nodiscard]] Result<void> Forget(const AgentId& robot);
  // Passes on how a robot that teaches is to be driven, and waits for nothing.
  [[nodiscard]] Driving::Verdict Drive(const AgentId& robot, const Driving::Word& word) {
    return driving_.Hear(robot, word, options_.driving_clock());
  }
  // These return a page of what servers keep, the newest first.
  [[nodiscard]] Result<exchange::MissionReply> Missions(const mission::Query& query);
  [[nodiscard]] Result<exchange::MissionReply> Commands(const mission::Query& query);
  // Returns the routes that a server has, or finds.
  [[nodiscard]] Result<exchange::CatalogReply> Routes(const route::RouteQuery& query);
  // Returns the revisions that have changed. Fails with kConflict if a server refuses, and says
  // why.
  [[nodiscard]] Result<exchange::CatalogReply> Edit(const route::RouteEdit& edit);
  // Returns a page of a server's answer, from its line `first` on: to "way FROM TO" or, without
  // words, how routes are joined. Fails with kConflict if a server refuses, and says why.
  [[nodiscard]] Result<exchange::NetworkReply> Network(const std::string& words,
                                                       std::uint32_t first);
  // This is what all servers answer.
  struct AllAnswers {
    std::vector<exchange::NetworkReply> replies{};  // those that are no refusals
    std::vector<AgentId> silent{};                  // servers that are heard and have not answered
  };
  // Returns a page of each server's answer. It waits for the servers that are heard, but not for
  // long once one has answered. Fails with kConflict if those that answer refuse, and says why.
  [[nodiscard]] Result<AllAnswers> AskAll(const std::string& words, std::uint32_t first);
  // Asks servers to change that, in words, and returns what holds now. Fails with kConflict
  // likewise.
  [[nodiscard]] Result<exchange::NetworkReply> Join(const std::string& words);

  // Returns all metrics, for Prometheus.
  [[nodiscard]] Result<http::MetricsText> Measure();
  // Returns what a robot's camera sees now. Callers that look through the same camera at once share
  // the picture. Returns null if the robot did not answer. Fails with kUnavailable if too many
  // cameras are looked through at once.
  [[nodiscard]] Result<std::shared_ptr<const exchange::Snapshot>> Look(const AgentId& robot);

  // Returns a photo's JPEG, piece by piece from its server.
  [[nodiscard]] Result<std::vector<std::uint8_t>> Photo(const fleet::KnownPhoto& known);

  struct News {
    std::uint64_t number = 0;  // counts up from 1
    std::shared_ptr<const nlohmann::ordered_json> state{};
  };
  // Returns the latest state once it is newer than `number`, or null if nothing has changed within
  // `most` or the desk is closed. A caller counts as an open page: without one there is no news,
  // and no server is asked.
  [[nodiscard]] std::shared_ptr<const News> See(std::uint64_t number,
                                                std::chrono::milliseconds most);

  // Accepts nothing more, and releases all callers that wait.
  void Close();
  [[nodiscard]] bool closed();
  // Returns why the thread has ended by itself, which closes the desk, or nothing if it has not.
  [[nodiscard]] std::optional<Error> failed();

 private:
  using Clock = std::chrono::steady_clock;
  using Seen = Result<std::shared_ptr<const exchange::Snapshot>>;

  [[nodiscard]] std::optional<Error> Unknown(const AgentId& robot);
  [[nodiscard]] Result<exchange::MissionReply> AskHistory(exchange::MissionRequest request);
  void Run();
  void ServeUntilClosed();
  template <typename AnErrand>
  [[nodiscard]] auto CarryOut(std::shared_ptr<AnErrand> errand, bool is_stop,
                              std::chrono::milliseconds timeout);
  // Returns false if it is one too many.
  [[nodiscard]] bool Take(std::shared_ptr<Errand> errand, bool is_stop);
  // Returns an invalid future if it is one too many.
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

  // These belong to the thread.
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
  std::size_t under_way_ = 0;  // all errands but stops, including those that wait
  std::uint64_t refused_ = 0;
  std::map<AgentId, std::shared_future<Seen>> looks_;
  std::uint64_t news_count_ = 0;
  std::shared_ptr<const News> news_;  // null while no page is open
  int looking_ = 0;                   // callers that wait in See now
  Clock::time_point looked_at_{};
  std::condition_variable changed_;

  std::thread thread_;
};

}  // namespace trailcast::console
