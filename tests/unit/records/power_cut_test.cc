// These test what a loss of power, or a disk that fails for a moment, leaves of a server's own
// files.
#include <gtest/gtest.h>

#include <algorithm>

#include "services/records/age_store.h"
#include "services/records/history_store.h"
#include "services/records/mission_store.h"
#include "services/records/network_store.h"
#include "tests/support/pieces.h"
#include "tests/support/unlucky_disk.h"

namespace trailcast::store {
namespace {

constexpr std::int64_t kNow = 1'700'000'000'000;

// As far as it has a value, which is not looked at.
template <typename Value>
Result<void> Done(const Result<Value>& result) {
  return result.map([](const auto&) {});
}

mission::Mission MissionFor(const std::string& id) {
  return {.agent = AgentId("robot1"), .id = id, .client = AgentId("desk"), .orders = "follow hall"};
}

std::optional<mission::Record> RecordOf(MissionStore& store, const std::string& id) {
  const auto page = store.Find({.id = id});
  if (!page || page->missions.size() != 1) return std::nullopt;
  return page->missions.front();
}

test::Told<MissionStore> Sent(const std::string& id) {
  return {[id](MissionStore& store) {
            const mission::Mission mission = MissionFor(id);
            return Done(store.Add({&mission, 1}, kNow).front());
          },
          [id](MissionStore& store) { return RecordOf(store, id).has_value(); }};
}

test::Told<MissionStore> UnderWay(const std::string& id) {
  return {[id, send = Sent(id).tell](MissionStore& store) {
            return send(store).and_then([&] {
              const mission::Report report{.agent = AgentId("robot1"),
                                           .mission = id,
                                           .change = 3,
                                           .state = mission::State::kUnderWay};
              return Done(store.Change({&report, 1}, kNow));
            });
          },
          [id](MissionStore& store) {
            const auto record = RecordOf(store, id);
            return record && record->last.state == mission::State::kUnderWay;
          }};
}

TEST(PowerCut, NothingThatAMissionStoreHasTakenIsLost) {
  const mission::NowCommand stop{.client = AgentId("desk"), .number = 7, .reason = "rain"};
  const test::Told<MissionStore> stopped{[=](MissionStore& store) { return store.Add(stop, kNow); },
                                         [=](MissionStore& store) {
                                           const auto page = store.FindCommands({});
                                           return page && page->commands.size() == 1 &&
                                                  page->commands[0].command == stop;
                                         }};
  const test::Told<MissionStore> answered{
      [=](MissionStore& store) {
        return store.Add(stop, kNow).and_then([&] {
          return store.Add(mission::NowAnswer{
              .agent = AgentId("robot1"), .client = stop.client, .number = stop.number});
        });
      },
      [](MissionStore& store) {
        const auto page = store.FindCommands({});
        return page && page->commands.size() == 1 && page->commands[0].answers.size() == 1;
      }};
  test::ExpectThatNothingTakenIsLost<MissionStore>(
      [](const std::filesystem::path& file) { return MissionStore::Open(file); },
      {Sent("m1"), UnderWay("m1"), UnderWay("m2"), Sent("m3"), stopped, answered});
}

TEST(PowerCut, NothingThatIsKnownOfSchedulesAndHeldQueuesIsLost) {
  using Schedule = MissionStore::Schedule;
  const auto has = [](MissionStore& store, const std::string& name, std::int64_t last_unix_ms) {
    const auto all = store.Schedules();
    return all && std::any_of(all->begin(), all->end(), [&](const Schedule& each) {
             return each.name == name && each.last_unix_ms >= last_unix_ms &&
                    each.sent.size() == (each.last_unix_ms > 0 ? 1U : 0U);
           });
  };
  const auto scheduled = [&](std::int64_t last_unix_ms) {
    Schedule round{.name = "round", .words = "round to robot1 ..", .by = "desk"};
    round.last_unix_ms = last_unix_ms;
    if (last_unix_ms > 0) round.sent = {{AgentId("robot1"), "round-1", ""}};
    return test::Told<MissionStore>{
        [round](MissionStore& store) { return store.Put(round); },
        [has, last_unix_ms](MissionStore& store) { return has(store, "round", last_unix_ms); }};
  };
  const test::Told<MissionStore> forgotten{
      [](MissionStore& store) {
        return store.Put(Schedule{.name = "gone"}).and_then([&] {
          return store.ForgetSchedule("gone");
        });
      },
      [has](MissionStore& store) { return !has(store, "gone", 0); }};
  const test::Told<MissionStore> held{
      [](MissionStore& store) {
        return store.Put(MissionStore::Hold{AgentId("robot1"), "stopped", kNow});
      },
      [](MissionStore& store) {
        const auto holds = store.Holds();
        return holds && holds->size() == 1;
      }};
  test::ExpectThatNothingTakenIsLost<MissionStore>(
      [](const std::filesystem::path& file) { return MissionStore::Open(file); },
      {scheduled(0), held, scheduled(kNow), forgotten});
}

TEST(PowerCut, NothingThatANetworksStoreHasTakenIsLost) {
  const auto junction = [](double from_m) {
    const network::Junction made{{"hall", from_m}, {"yard", 0.0}, true};
    return test::Told<NetworkStore>{
        [made](NetworkStore& store) { return store.Put(made, "desk", kNow); },
        [made](NetworkStore& store) {
          const auto junctions = store.Junctions();
          return junctions && std::count(junctions->begin(), junctions->end(), made) == 1;
        }};
  };
  const test::Told<NetworkStore> closed{
      [](NetworkStore& store) {
        return store.Replace(
            "hall", {{.route = "hall", .from_m = 3.0, .to_m = 7.0, .closed = true}}, "desk", kNow);
      },
      [](NetworkStore& store) {
        const auto conditions = store.Conditions();
        return conditions && conditions->size() == 1;
      }};
  const test::Told<NetworkStore> named{
      [](NetworkStore& store) {
        return store.Put(network::NamedPlace{"office", {"hall", 8.0}}, "desk", kNow);
      },
      [](NetworkStore& store) {
        const auto names = store.Names();
        return names && names->size() == 1;
      }};
  const ProposedJunction found{{{{"hall", 5.0}, {"attic", 1.0}, false}, 0.9}};
  const test::Told<NetworkStore> proposed{[found](NetworkStore& store) {
                                            return store.Put({&found, 1}, "server", kNow);
                                          },
                                          [found](NetworkStore& store) {
                                            const auto proposals = store.Proposals();
                                            return proposals && *proposals == std::vector{found};
                                          }};
  const test::Told<NetworkStore> zone{
      [](NetworkStore& store) {
        return store.Put(network::Lane{{{"hall", 2.0, 4.0}}}, "desk", kNow)
            .and_then([&](std::int64_t number) {
              return store.Hold({&number, 1}, AgentId("robot1"));
            });
      },
      [](NetworkStore& store) {
        const auto lanes = store.Lanes();
        return lanes && std::any_of(lanes->begin(), lanes->end(), [](const KeptLane& lane) {
                 return lane.holders.contains(AgentId("robot1"));
               });
      }};
  const FollowedSection section{test::KeyNumber(1), 3, 5.0, 1.0, kNow};
  const test::Told<NetworkStore> followed{[section](NetworkStore& store) {
                                            return store.Put({&section, 1});
                                          },
                                          [section](NetworkStore& store) {
                                            const auto sections = store.Followed();
                                            return sections && *sections == std::vector{section};
                                          }};
  test::ExpectThatNothingTakenIsLost<NetworkStore>(
      [](const std::filesystem::path& file) { return NetworkStore::Open(file); },
      {junction(1.0), closed, junction(2.0), named, proposed, zone, followed});
}

TEST(PowerCut, NothingThatAHistoryHasTakenIsLost) {
  const auto changed = [](const std::string& what) {
    const network::Change change{kNow, "desk", what};
    return test::Told<HistoryStore>{
        [change](HistoryStore& store) {
          const route::RouteKey key = test::KeyNumber(1);
          return store.Note(
              std::vector{change},
              std::vector{test::InfoOf(key, test::PiecesOf(key, 1), route::RouteState::kComplete)});
        },
        [change](HistoryStore& store) {
          const auto changes = store.Since(0, 0, 100);
          const auto noted = store.Noted(test::KeyNumber(1));
          return changes && std::count(changes->begin(), changes->end(), change) == 1 && noted &&
                 *noted;
        }};
  };
  const test::Told<HistoryStore> kept_since{
      [](HistoryStore& store) { return Done(store.KeptSince(kNow)); },
      [](HistoryStore& store) { return store.KeptSince(2 * kNow) == kNow; }};
  test::ExpectThatNothingTakenIsLost<HistoryStore>(
      [](const std::filesystem::path& file) { return HistoryStore::Open(file); },
      {kept_since, changed("open hall"), changed("close hall"), changed("activated hall@2")});
}

TEST(PowerCut, NothingThatIsKnownOfAgesIsLost) {
  using std::chrono::hours;
  const auto aged = [](unsigned number) {
    const AgeStore::Marked revision{test::KeyNumber(number), kNow};
    return test::Told<AgeStore>{
        [revision](AgeStore& store) {
          return Done(store.AgesOf({revision})).and_then([&] { return store.Pass(hours(1)); });
        },
        [revision](AgeStore& store) {
          const auto ages = store.AgesOf({revision});
          return ages && ages->front() >= hours(1);
        }};
  };
  const test::Told<AgeStore> deleted{[](AgeStore& store) { return Done(store.Allow(100, 100)); },
                                     [](AgeStore& store) { return store.Allow(1, 100) == 0U; }};
  test::ExpectThatNothingTakenIsLost<AgeStore>(
      [](const std::filesystem::path& file) { return AgeStore::Open(file); },
      {aged(1), aged(2), deleted, aged(3)});
}

}  // namespace
}  // namespace trailcast::store
