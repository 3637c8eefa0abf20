// Robots on random networks with narrow places: what the server lets in, what the agents' desks
// make of it, and links that lose and delay what is said between them.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <deque>
#include <filesystem>
#include <random>

#include "agent/duty/src/rerouting.h"
#include "agent/link/mission_handler.h"
#include "route_server/network/replanning.h"
#include "route_server/network/zone_admission.h"
#include "services/fleet/network_client.h"
#include "tests/support/memory_store.h"
#include "tests/support/temp_dir.h"

namespace trailcast::agent {
namespace {

using mission::State;
using mission::Task;
using mission::WaitsFor;
using std::chrono::milliseconds;
using Time = std::chrono::steady_clock::time_point;

constexpr double kStep_s = 0.2;
constexpr double kKeeps_m = 1.5;
constexpr double kBay_m = 10.0;
constexpr double kInBay_m = 8.0;

// One in the world, as OnDuty drives it.
struct Walker {
  explicit Walker(std::string name) : agent(std::move(name)), handler(agent, {}) {}

  AgentId agent;
  MissionHandler handler;
  std::size_t route = 0;
  double along_m = 0.0;
  double speed_mps = 0.5;
  std::optional<Task> driven{};
  bool placed = true;  // it has found itself on its route
  Time finds_itself{};
  bool missed = false;
  std::optional<std::pair<State, WaitsFor>> told{};
  bool arrived = false;
  Time says_at{};
  std::deque<std::pair<Time, exchange::Message>> in{};
  std::deque<std::pair<Time, exchange::Message>> out{};
};

class LanesModel {
 public:
  explicit LanesModel(unsigned seed) : random_(seed) {
    corridors_ = 1 + seed % 3;
    for (std::size_t i = 0; i < corridors_; ++i) {
      lengths_m_.push_back(Between(60.0, 90.0));
      Put(2 * i, fmt::format("out{}", i), lengths_m_[i]);
      Put(2 * i + 1, fmt::format("back{}", i), lengths_m_[i]);
    }
    has_bay_ = seed % 4 < 2;
    if (has_bay_) Put(Bay(), Name(Bay()), kBay_m);
    Restart();
    for (std::size_t i = 0; i < corridors_; ++i) AddLanes(i);
    for (std::size_t i = 0; i < corridors_; ++i) AddJunctions(i);
    if (has_bay_) AddBay();
    loses_ = Between(0.0, 0.4);
    restarts_ = seed % 2 == 0;
    if (has_bay_) {
      AddRobot("in-bay", std::pair(Bay(), kInBay_m));
      AddRobot("to-bay", {}, std::pair(Bay(), kInBay_m));
    }
    const auto robots = static_cast<unsigned>(Between(2.0, 6.99));
    for (unsigned i = 0; i < robots; ++i) AddRobot(fmt::format("robot{}", i));
  }

  // Until all have arrived; what went wrong, if anything did.
  std::string Run() {
    for (int step = 0; step < 20'000; ++step) {
      now_ += milliseconds(200);
      Serve();
      for (auto& walker : walkers_) Step(*walker);
      if (const std::string trouble = TwoInOne(); !trouble.empty()) return trouble;
      if (std::all_of(walkers_.begin(), walkers_.end(), [](const auto& w) { return w->arrived; })) {
        return {};
      }
    }
    return "not all arrive: " + Told();
  }
  [[nodiscard]] std::size_t robots() const { return walkers_.size(); }
  [[nodiscard]] int waits() const { return waits_; }
  [[nodiscard]] double backed_m() const { return backed_m_; }

 private:
  using Spot = std::pair<std::size_t, double>;
  double Between(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }
  static route::RouteKey Key(std::size_t route) {
    return test::KeyNumber(static_cast<unsigned>(route + 1), 1);
  }
  [[nodiscard]] std::size_t Bay() const { return 2 * corridors_; }
  std::string Name(std::size_t route) const {
    if (route == Bay()) return "bay";
    return fmt::format("{}{}", route % 2 == 0 ? "out" : "back", route / 2);
  }
  void Put(std::size_t route, const std::string& name, double length_m) {
    auto info =
        test::InfoOf(Key(route), test::PiecesOf(Key(route), 2), route::RouteState::kComplete);
    info.name = name;
    info.length_m = length_m;
    info.standing = route::Standing::kActive;
    ASSERT_TRUE(routes_.PutRoute(info));
  }
  void Restart() {
    keeper_.reset();
    replanning_.reset();
    network_.reset();
    missions_.reset();
    network_ =
        server::NetworkRegistry::Open(
            AgentId("server"), store::NetworkStore::Open(folder_ / "joints").value(), routes_)
            .value();
    missions_ = server::MissionRegistry::Open(
                    AgentId("server"), store::MissionStore::Open(folder_ / "missions").value())
                    .value();
    replanning_.emplace(*missions_, *network_);
    keeper_.emplace(*missions_, *network_);
    (void)keeper_->LookAtAll(now_);
  }
  void Edit(const std::string& words) {
    const auto reply = network_->Change({AgentId("desk"), ++requests_, words}, 1000);
    ASSERT_EQ(reply.error, "") << words;
  }
  // The way back leads through the same places.
  void AddLanes(std::size_t corridor) {
    const double length_m = lengths_m_[corridor];
    const int count = static_cast<int>(Between(1.0, 3.99));
    for (int i = 0; i < count; ++i) {
      const double from_m = std::round(Between(3.0, length_m - 16.0));
      const double to_m = from_m + std::round(Between(2.0, 8.0));
      Edit(fmt::format("narrow {} {:g}..{:g} {} {:g}..{:g}", Name(2 * corridor), from_m, to_m,
                       Name(2 * corridor + 1), length_m - to_m, length_m - from_m));
      lanes_.push_back({{{Name(2 * corridor), from_m, to_m},
                         {Name(2 * corridor + 1), length_m - to_m, length_m - from_m}}});
    }
  }
  bool IsNarrow(std::size_t route, double along_m) const {
    for (const network::Lane& lane : lanes_) {
      for (const network::Part& part : lane.parts) {
        if (part.route == Name(route) && along_m > part.from_m - 1.0 && along_m < part.to_m + 2.5) {
          return true;
        }
      }
    }
    return false;
  }
  std::pair<std::size_t, double> Somewhere() { return SomewhereIn(corridors_); }
  std::pair<std::size_t, double> SomewhereIn(std::size_t corridors) {
    while (true) {
      const auto route = static_cast<std::size_t>(Between(0.0, 2.0 * corridors - 0.01));
      const double along_m = std::round(Between(0.0, lengths_m_[route / 2]) * 10.0) / 10.0;
      if (!IsNarrow(route, along_m) && along_m <= lengths_m_[route / 2] - 0.5)
        return {route, along_m};
    }
  }
  void AddJunctions(std::size_t corridor) {
    const double length_m = lengths_m_[corridor];
    for (const auto& [from, to] : {std::pair(0, 1), std::pair(1, 0)}) {
      Edit(fmt::format("join {}@{:g} {}@0", Name(2 * corridor + from), std::floor(length_m),
                       Name(2 * corridor + to)));
    }
    if (corridors_ == 1) return;
    for (int i = 0; i < 4; ++i) {
      const auto [from, from_m] = Somewhere();
      const auto [to, to_m] = Somewhere();
      if (from != to) Edit(fmt::format("join {}@{} {}@{}", Name(from), from_m, Name(to), to_m));
    }
  }
  // A dead end, off a corridor and back to it, which robots leave backwards.
  void AddBay() {
    Edit(fmt::format("back bay 0..{:g}", kBay_m));
    Edit("limit bay cost 1000");  // no short cut through who stands there
    lanes_.push_back({{{"bay", 0.0, kBay_m}}});
    const auto [from, from_m] = SomewhereIn(1);
    const auto [to, to_m] = SomewhereIn(1);
    Edit(fmt::format("join {}@{} bay@0", Name(from), from_m));
    Edit(fmt::format("join bay@1 {}@{}", Name(to), to_m));
  }
  void AddRobot(const std::string& name, std::optional<Spot> begin = {},
                std::optional<Spot> end = {}) {
    for (int tries = 0; tries < 50; ++tries) {
      const auto [route, along_m] = begin ? *begin : Somewhere();
      const auto [to, to_m] = end ? *end : Somewhere();
      const bool free =
          std::none_of(walkers_.begin(), walkers_.end(), [&, at = route, at_m = along_m](auto& w) {
            return w->route == at && std::abs(w->along_m - at_m) < 3.0;
          });
      const std::string goal = fmt::format("{}@{}", Name(to), to_m);
      const auto way =
          network_->Answer({.client = AgentId("desk"),
                            .request = ++requests_,
                            .words = fmt::format("way {}@{} {}", Name(route), along_m, goal)});
      const auto orders = fleet::OrdersAlong(way.lines, goal);
      if (!free || !way.error.empty() || !orders || orders->empty()) continue;
      auto walker = std::make_unique<Walker>(name);
      walker->route = route;
      walker->along_m = along_m;
      walker->speed_mps = Between(0.2, 0.8);
      const mission::Mission mission{
          .agent = walker->agent, .id = "m-" + name, .client = AgentId("desk"), .orders = *orders};
      missions_->Handle(mission, now_, 1000);
      walker->handler.Handle(mission);
      walkers_.push_back(std::move(walker));
      return;
    }
  }

  // Lost, or heard a little later; what was said before is heard before.
  void Pass(std::deque<std::pair<Time, exchange::Message>>& link, exchange::Message message) {
    if (Between(0.0, 1.0) < loses_) return;
    Time at = now_ + milliseconds(static_cast<int>(Between(0.0, 800.0)));
    if (!link.empty()) at = std::max(at, link.back().first);
    link.emplace_back(at, std::move(message));
  }
  void Serve() {
    if (restarts_ && Between(0.0, 1.0) < 0.002) {
      for (auto& walker : walkers_) walker->out.clear();
      Restart();
    }
    for (auto& walker : walkers_) {
      while (!walker->out.empty() && walker->out.front().first <= now_) {
        const exchange::Message message = std::move(walker->out.front().second);
        walker->out.pop_front();
        missions_->Handle(message, now_, 1000);
        const auto* status = std::get_if<exchange::AgentStatus>(&message);
        if (status == nullptr) continue;
        network_->Hear(*status);
        (void)replanning_->Look(status->agent, now_);
        for (const std::string& line : keeper_->Look(status->agent, now_)) {
          waits_ += line.find("waits for") != std::string::npos ? 1 : 0;
          log_ += line + "\n";
        }
      }
    }
    for (exchange::Message& message : missions_->Tick(now_, 1000)) {
      const auto* mission = std::get_if<mission::Mission>(&message);
      const auto* report = std::get_if<mission::Report>(&message);
      for (auto& walker : walkers_) {
        const bool is_its = (mission != nullptr && mission->agent == walker->agent) ||
                            (report != nullptr && report->agent == walker->agent);
        if (is_its) Pass(walker->in, message);
      }
    }
  }

  // In words that say nothing.
  void Tell(Walker& walker, State state, WaitsFor waits_for = WaitsFor::kNothing) {
    if (walker.told == std::pair(state, waits_for)) return;
    walker.told.emplace(state, waits_for);
    walker.handler.Tell(state, "xyzzy", waits_for);
  }
  void Reroute(Walker& walker) {
    walker.missed = false;
    walker.told.reset();
    if (!walker.driven) return;
    const auto& tasks = walker.handler.current()->tasks;
    const Rerouting other = FindOnPath(
        tasks, *walker.driven, walker.placed ? std::optional(walker.along_m) : std::nullopt);
    walker.handler.GoOnAt(other.task);
    if (other.kind == Rerouting::Kind::kGoesOn) {
      walker.driven = tasks[other.task];
      return;
    }
    walker.missed = other.kind == Rerouting::Kind::kMissed;
    if (!walker.missed && walker.placed && tasks[other.task].kind == Task::Kind::kFollow &&
        tasks[other.task].route.route == walker.driven->route.route) {
      walker.handler.BeginAt(walker.along_m);
    }
    walker.driven.reset();
  }
  void Step(Walker& walker) {
    while (!walker.in.empty() && walker.in.front().first <= now_) {
      walker.handler.Handle(walker.in.front().second);
      walker.in.pop_front();
      if (walker.handler.TakeAmended()) Reroute(walker);
    }
    if (walker.handler.current()) Work(walker);
    for (exchange::Message& message : walker.handler.Due(now_, true)) {
      Pass(walker.out, std::move(message));
    }
    if (now_ < walker.says_at) return;
    walker.says_at = now_ + milliseconds(1000);
    exchange::AgentStatus status;
    status.agent = walker.agent;
    status.instance = 1;
    status.role = exchange::AgentRole::kFollower;
    status.mode = walker.driven ? exchange::AgentMode::kReplaying : exchange::AgentMode::kWaiting;
    if (walker.placed && walker.handler.current()) {
      status.place = {Key(walker.route), walker.along_m};
      status.speed_mps = walker.driven ? walker.speed_mps : 0.0;
    }
    Pass(walker.out, status);
  }
  void Work(Walker& walker) {
    const auto& current = *walker.handler.current();
    const Task& task = current.tasks[current.task];
    if (walker.missed || task.kind != Task::Kind::kFollow) {
      walker.driven.reset();
      return Tell(walker, State::kFetching,
                  walker.missed || task.kind == Task::Kind::kWaitWay ? WaitsFor::kWay
                  : task.kind == Task::Kind::kWaitLane               ? WaitsFor::kLane
                                                                     : WaitsFor::kNothing);
    }
    if (!walker.driven) {
      walker.driven = task;
      for (std::size_t i = 0; i <= Bay(); ++i) {
        if (Name(i) != task.route.route) continue;
        if (i != walker.route) walker.along_m = task.from_m;
        walker.route = i;
      }
      walker.placed = false;
      walker.finds_itself = now_ + milliseconds(static_cast<int>(Between(400.0, 2500.0)));
    }
    if (now_ < walker.finds_itself) return;
    walker.placed = true;
    Tell(walker, State::kUnderWay);
    const double sign = walker.driven->backwards ? -1.0 : 1.0;
    double room_m = std::min(walker.speed_mps * kStep_s,
                             std::max(0.0, sign * (walker.driven->to_m - walker.along_m)));
    for (const auto& other : walkers_) {
      const bool counts = other.get() != &walker && !other->arrived && other->route == walker.route;
      const double ahead_m = sign * (other->along_m - walker.along_m);
      const bool is_ahead = ahead_m > 0.0 || (ahead_m == 0.0 && other->agent < walker.agent);
      if (counts && is_ahead) room_m = std::min(room_m, std::max(0.0, ahead_m - kKeeps_m));
    }
    walker.along_m += sign * room_m;
    if (sign < 0.0) backed_m_ += room_m;
    if (sign * (walker.driven->to_m - walker.along_m) > 1e-6) return;
    walker.driven.reset();
    walker.told.reset();
    walker.handler.NoteDone();
    if (walker.handler.current()->task >= walker.handler.current()->tasks.size()) {
      walker.handler.Tell(State::kArrived);
      walker.arrived = true;
    }
  }

  // Where robots are in truth.
  std::string TwoInOne() const {
    for (const network::Lane& lane : lanes_) {
      std::vector<std::string> in;
      for (const auto& walker : walkers_) {
        for (const network::Part& part : lane.parts) {
          const bool is_in = !walker->arrived && Name(walker->route) == part.route &&
                             walker->along_m > part.from_m && walker->along_m < part.to_m;
          if (is_in) in.push_back(walker->agent.value());
        }
      }
      if (in.size() > 1) {
        return fmt::format("{} are in {}: {}", fmt::join(in, " and "), network::ToText(lane),
                           Told());
      }
    }
    return {};
  }
  std::string Told() const {
    std::string told;
    for (const auto& walker : walkers_) {
      const auto& current = walker->handler.current();
      told += fmt::format("\n{} at {}@{:.2f}{}: {}", walker->agent.value(), Name(walker->route),
                          walker->along_m, walker->missed ? " missed" : "",
                          current ? current->mission.orders : "arrived");
      const auto* record = missions_->CurrentOf(walker->agent);
      if (record != nullptr) {
        told += fmt::format("\n   server: {}, {} {}", record->mission.orders,
                            mission::ToString(record->last.state), record->last.detail);
      }
    }
    const auto all = network_->Answer({.client = AgentId("desk"), .request = 1});
    for (const std::string& line : all.lines) told += "\n  " + line;
    return told + "\n" + log_.substr(log_.size() - std::min<std::size_t>(log_.size(), 3000));
  }

  std::mt19937 random_;
  test::TempDir folder_;
  test::MemoryStore routes_;
  std::unique_ptr<server::NetworkRegistry> network_;
  std::unique_ptr<server::MissionRegistry> missions_;
  std::optional<server::Replanning> replanning_;
  std::optional<server::ZoneAdmission> keeper_;
  std::size_t corridors_ = 1;
  std::vector<double> lengths_m_;
  std::vector<network::Lane> lanes_;
  double loses_ = 0.0;
  bool restarts_ = false;
  bool has_bay_ = false;
  double backed_m_ = 0.0;
  std::vector<std::unique_ptr<Walker>> walkers_;
  Time now_{std::chrono::seconds(1000)};
  std::uint64_t requests_ = 100;
  int waits_ = 0;
  std::string log_;
};

TEST(LanesModelTest, NeverTwoAreInOneNarrowPlaceAndAllArrive) {
  // A network syncs what it stores some hundred times, which would take a disk minutes.
  if (std::filesystem::is_directory("/dev/shm")) setenv("TMPDIR", "/dev/shm", 1);
  std::size_t robots = 0;
  int waits = 0;
  double backed_m = 0.0;
  for (unsigned seed = 1; seed <= 120; ++seed) {
    LanesModel model(seed);
    const std::string trouble = model.Run();
    ASSERT_EQ(trouble, "") << "seed " << seed;
    robots += model.robots();
    waits += model.waits();
    backed_m += model.backed_m();
  }
  EXPECT_GT(robots, 240U);
  EXPECT_GT(waits, 40) << "they never met";
  EXPECT_GT(backed_m, 200.0) << "none left its bay";
}

}  // namespace
}  // namespace trailcast::agent
