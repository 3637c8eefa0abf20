// These are `trailcast send` and `trailcast missions`.
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>

#include "services/base/time.h"
#include "services/base/unix_time.h"
#include "services/fleet/draw.h"
#include "services/fleet/history_figures.h"
#include "services/fleet/known_robot.h"
#include "services/fleet/mission_client.h"
#include "services/fleet/network_client.h"
#include "services/fleet/operator_peer.h"
#include "services/fleet/photo_wish.h"
#include "services/fleet/routes/catalog_client.h"
#include "services/mission/address.h"
#include "services/mission/orders.h"
#include "services/network/words.h"
#include "services/program/json.h"
#include "services/program/stop_signal.h"
#include "services/tool/commands/address_validator.h"
#include "services/tool/commands/command.h"
#include "services/tool/commands/photo_options.h"
#include "services/tool/commands/time_spans.h"

namespace trailcast::tool {
namespace {

using mission::State;

constexpr double kLongest_s = 365.0 * 86400.0;
constexpr std::chrono::milliseconds kLookAgain{1000};

struct SendOptions {
  std::string robot;  // or a group, or several (mission/address.h)
  std::vector<std::string> orders;
  std::string again;
  mission::PhotoWish again_photos{};  // of a mission to a place
  std::string id;
  std::string from;  // where `goto` begins; empty for where the robot stands
  PhotoOptions photos;
  double valid_s = 600.0;
  bool goes_on = false;
  bool unheard = false;
  bool wait = false;
  bool json = false;
  double timeout_s = 5.0;
};

// Robots say every second that they are there, so that this program, or a server that has started
// at the same time, has heard of all of them by then.
constexpr std::chrono::milliseconds kAllAreHeard{3000};

constexpr const char* kSendExamples =
    "Orders, one after the other:\n"
    "  follow ROUTE[@REVISION] [FROM..TO] [laps N] [speed F]\n"
    "                       metres along the route, either may be missing; F times the taught "
    "speed\n"
    "  follow ROUTE[@REVISION] backwards [FROM..TO] [speed F]\n"
    "                       in reverse gear, looking as the scout did, from its end, or FROM, down "
    "to\n"
    "                       its beginning, or TO, at half the taught speed: what is behind the "
    "robot\n"
    "                       it does not see\n"
    "  teach ROUTE [TAG ...]   a person drives until 'trailcast end robot1'\n"
    "  turn DEGREES           on the spot, by its wheels: to the left, below 0 to the right\n"
    "  wait SECONDS\n"
    "or, alone:\n"
    "  goto PLACE           ROUTE@METRES, or what it is called: the best way over the network of\n"
    "                       routes ('trailcast network'), as 'follow' after 'follow'; from where "
    "the\n"
    "                       robot last said that it stands, or --from; round what is closed, also\n"
    "                       meanwhile\n"
    "Examples:\n"
    "  trailcast send robot1 follow hall\n"
    "  trailcast send robot1 follow hall 3..10 speed 0.5 wait 20 follow yard laps 2\n"
    "  trailcast send robot1 follow dock backwards ..3   # out of a dead end\n"
    "  trailcast send robot1 teach yard wet gravel   # then drive it: its joystick, or the "
    "console\n"
    "  trailcast send robot1 follow hall --wait      # until it has arrived, or says why not\n"
    "  trailcast send robot1 follow hall --valid 2h  # however late it is back by then\n"
    "  trailcast send robot1 goto office@8           # round what is closed, or refused\n"
    "  trailcast send robot1 goto loading-bay\n"
    "  trailcast send robot1 --again 4f2a09c1d3e5b687  # what failed, once more\n"
    "  trailcast send robot1 follow hall --photo-every 5 --photo-at dock   # then: trailcast "
    "photos\n"
    "  trailcast send @cart follow hall              # whichever of cart-1, cart-2, .. is free "
    "first\n"
    "  trailcast send cart-1,cart-2,lift follow hall # all of them or none\n"
    "A robot does one mission at a time. A server keeps the others in a queue, and what a robot\n"
    "cannot hear yet; 'trailcast missions --open' shows them. The queue goes on by itself after a\n"
    "mission that arrived, and after any other once the robot is told to resume. 'trailcast "
    "cancel\n"
    "robot1' ends its mission and the queue; 'trailcast stop robot1' has it stand at once, and\n"
    "holds the queue until it is released and told to resume. Without a server, a robot that has "
    "a\n"
    "mission refuses another.\n"
    "Exit status: 0 taken, or kept by a server (with --wait: arrived); 1 refused, put off "
    "by servers, nobody\nanswered, or no such robot is known (with --wait: not arrived); 2 wrong "
    "usage, also of orders.";

// Says whether it is for one robot, whose name is known.
bool IsForOne(const SendOptions& options) {
  return options.robot.find(',') == std::string::npos && !mission::IsGroup(options.robot);
}

// Fills in the orders of the mission of that id, the newest of several.
Result<void> TakeOrders(fleet::OperatorPeer& peer, SendOptions& options) {
  const auto found = fleet::AskForMissions(*peer.exchange, peer.self, {.id = options.again}, 1,
                                           ToMilliseconds(options.timeout_s));
  if (!found) return tl::unexpected(found.error());
  if (found->empty()) {
    return Fail(ErrorCode::kNotFound,
                "no server keeps a mission '{}': 'trailcast missions' lists what there is",
                options.again);
  }
  const std::string& orders = found->front().mission.orders;
  const auto going = mission::GoingIn(orders);
  if (going) options.again_photos = going->photos;
  options.orders = going ? std::vector<std::string>{"goto", going->to} : std::vector{orders};
  return {};
}

// Returns the place to go to, if the robot is sent to one.
Result<std::optional<std::string>> GoalOf(const SendOptions& options) {
  if (options.orders.front() != "goto") {
    if (options.from.empty()) return std::nullopt;
    return Fail(ErrorCode::kInvalidArgument, "--from is for 'goto' alone");
  }
  if (options.orders.size() != 2) {
    return Fail(ErrorCode::kInvalidArgument,
                "'goto' is followed by one place and nothing else: goto office@8");
  }
  for (const std::string& place : {options.orders[1], options.from}) {
    if (place.empty()) continue;
    if (const auto is = network::ParseGoal(place); !is) return tl::unexpected(is.error());
  }
  return options.orders[1];
}

// Returns the orders by which a server finds each robot's path once it is about to begin. Fails if
// there is no such place.
Result<std::string> OrdersWithoutPath(const std::string& goal, const fleet::OperatorPeer& peer,
                                      const SendOptions& options) {
  if (goal != mission::kHomeWord) {
    const auto way =
        fleet::AskForWay(*peer.exchange, peer.self, goal, goal, ToMilliseconds(options.timeout_s));
    if (!way) return tl::unexpected(way.error());
  }
  return fmt::format("goto {} wait way", goal);
}

// Returns the path there as one mission's orders, or nothing if the robot is there already. It
// prints the path.
Result<std::string> OrdersTo(const std::string& goal, const fleet::OperatorPeer& peer,
                             const SendOptions& options) {
  const auto way = fleet::AskForWay(*peer.exchange, peer.self,
                                    options.from.empty() ? options.robot : options.from, goal,
                                    ToMilliseconds(options.timeout_s));
  if (!way) return tl::unexpected(way.error());
  if (!options.json) {
    fmt::print("{}", fleet::WayText(*way));
  } else if (way->empty()) {
    fmt::print("{}", program::Indented(fleet::WayJson(*way)));
  }
  return fleet::OrdersAlong(*way, goal);
}

// Returns the orders with the photos that it is to take.
Result<std::string> WithPhotos(const std::string& orders, fleet::OperatorPeer& peer,
                               const SendOptions& options) {
  auto wish = WishOf(options.photos, peer, options.timeout_s);
  if (!wish) return tl::unexpected(wish.error());
  return fleet::OrdersWithPhotos(orders, wish->any() ? *wish : options.again_photos);
}

// Checks the orders as far as that is possible without a server.
Result<void> CheckOrders(const SendOptions& options) {
  if (options.orders.empty() == options.again.empty()) {
    return Fail(ErrorCode::kInvalidArgument, "either ORDERS or --again MISSION is needed");
  }
  if (!options.from.empty() && !IsForOne(options)) {
    return Fail(ErrorCode::kInvalidArgument, "--from is for one robot alone");
  }
  if (!options.again.empty()) return {};
  const auto goal = GoalOf(options);
  if (!goal) return tl::unexpected(goal.error());
  if (*goal) return {};
  const auto tasks = mission::ParseOrders(fmt::format("{}", fmt::join(options.orders, " ")));
  if (!tasks) return tl::unexpected(tasks.error());
  return {};
}

int Send(const CLI::App& app, const program::CommonOptions& common, SendOptions options) {
  if (const auto understood = CheckOrders(options); !understood) {
    return ComplainOfUsage(app, understood.error());
  }
  const program::StopSignal stop;
  exchange::TopicUse use = exchange::SenderTopics();
  const auto and_also = [&](const exchange::TopicUse& more) {
    use.write.insert(use.write.end(), more.write.begin(), more.write.end());
    use.read.insert(use.read.end(), more.read.begin(), more.read.end());
  };
  and_also(exchange::HistoryTopics());
  const bool goes_to_a_place = !options.orders.empty() && options.orders.front() == "goto";
  if (goes_to_a_place || !options.again.empty() || !options.photos.at.empty())
    and_also(exchange::NetworkTopics());
  auto peer = fleet::JoinAsOperator(common, use);
  if (!peer) return program::Complain(app, peer.error());
  const auto addressed =
      mission::ParseAddress(options.robot);  // which its flag's validator has accepted
  for (const std::string& each : *addressed) {
    const auto unknown = options.unheard
                             ? std::nullopt
                             : fleet::FindUnknown(*peer->exchange, peer->self, each, kAllAreHeard);
    if (!unknown) continue;
    return program::Complain(app,
                             {unknown->code, unknown->message + "; --unheard has a server keep "
                                                                "it all the same"});
  }
  if (!options.again.empty()) {
    if (const auto taken = TakeOrders(*peer, options); !taken) {
      return program::Complain(app, taken.error());
    }
  }
  const auto goal = GoalOf(options);
  if (!goal) return program::Complain(app, goal.error());
  mission::Mission mission{.agent = AgentId(options.robot),
                           .id = options.id.empty() ? fleet::DrawMissionId() : options.id,
                           .client = peer->self,
                           .orders = fmt::format("{}", fmt::join(options.orders, " ")),
                           .valid_for_s = static_cast<std::uint32_t>(options.valid_s),
                           .goes_on = options.goes_on};
  if (*goal) {
    auto orders = IsForOne(options) ? OrdersTo(**goal, *peer, options)
                                    : OrdersWithoutPath(**goal, *peer, options);
    if (!orders) return program::Complain(app, orders.error());
    if (orders->empty()) return program::kExitOk;
    mission.orders = *std::move(orders);
  }
  auto with_photos = WithPhotos(mission.orders, *peer, options);
  if (!with_photos) return program::Complain(app, with_photos.error());
  mission.orders = *std::move(with_photos);
  fleet::SendWatch watch;
  watch.timeout = ToMilliseconds(options.timeout_s);
  watch.to_its_end = options.wait;
  watch.stop = [] { return program::StopSignal::requested(); };
  if (!options.json) {
    fmt::print("mission {}\n", mission.id);
    watch.news = [](const mission::Report& report) {
      fmt::print("{}\n", fleet::ReportText(report));
      std::fflush(stdout);
    };
  }
  const auto reports = fleet::SendMission(*peer->exchange, mission, watch);
  if (!reports) return program::Complain(app, reports.error());
  if (options.json) {
    auto all = program::Json::array();
    for (const mission::Report& report : *reports) all.push_back(fleet::ReportJson(report));
    fmt::print("{}", program::Indented(IsForOne(options) ? all.front() : all));
  }
  const bool well = std::all_of(reports->begin(), reports->end(), [&](const auto& report) {
    return report.state == State::kArrived || (!options.wait && !mission::HasEnded(report.state));
  });
  return well ? program::kExitOk : program::kExitFailure;
}

struct MissionsOptions {
  mission::Query query;
  std::vector<std::string> states;
  double newer_than_s = 0.0;
  std::size_t limit = 50;
  bool commands = false;
  bool open = false;
  std::string by;
  bool csv = false;
  bool watch = false;
  bool json = false;
  double timeout_s = 5.0;
};

// More than a server keeps.
constexpr std::size_t kAllMissions = 1'000'000;

constexpr const char* kMissionsExamples =
    "Examples:\n"
    "  trailcast missions                          # the newest first\n"
    "  trailcast missions --robot robot1 --watch   # and again whenever something has changed\n"
    "  trailcast missions --open                   # each robot's queue, in its order\n"
    "  trailcast missions --by week --csv          # kilometres, share that arrived, "
    "interventions\n"
    "  trailcast missions --commands               # who told whom to pause, stop, .. and when\n"
    "  trailcast missions --route hall --state failed --newer-than 7d --json";

// Returns the name as users type it: "under-way".
std::string TypedName(State state) {
  std::string name = mission::ToString(state);
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

std::map<std::string, State> States() {
  std::map<std::string, State> states;
  for (std::uint8_t i = 0; i < mission::kStates; ++i) {
    states.emplace(TypedName(static_cast<State>(i)), static_cast<State>(i));
  }
  return states;
}

mission::Query QueryOf(const MissionsOptions& options) {
  mission::Query query = options.query;
  for (const std::string& state : options.states) {
    query.states |= 1U << static_cast<unsigned>(States().at(state));
  }
  for (std::uint8_t i = 0; options.open && i < mission::kStates; ++i) {
    if (!mission::HasEnded(static_cast<State>(i))) query.states |= 1U << i;
  }
  if (options.newer_than_s > 0.0) {
    query.from_unix_ms = NowUnixMs() - static_cast<std::int64_t>(1e3 * options.newer_than_s);
  }
  return query;
}

// `text` is shown. `compared` leaves out the ages of a table, which change all the time.
struct Listing {
  std::string text;
  std::string compared;
};

Result<Listing> Look(fleet::OperatorPeer& peer, const MissionsOptions& options) {
  const auto timeout = ToMilliseconds(options.timeout_s);
  const auto listed = [&](const auto& records, auto table, auto json) -> Listing {
    std::string compared = program::Indented(json(records));
    return {options.json ? compared : table(records, NowUnixMs()), compared};
  };
  if (options.commands) {
    const auto commands =
        fleet::AskForCommands(*peer.exchange, peer.self, QueryOf(options), options.limit, timeout);
    if (!commands) return tl::unexpected(commands.error());
    return listed(*commands, fleet::CommandsTable, fleet::CommandsJson);
  }
  auto missions =
      fleet::AskForMissions(*peer.exchange, peer.self, QueryOf(options), options.limit, timeout);
  if (!missions) return tl::unexpected(missions.error());
  if (options.open) fleet::SortAsQueues(*missions);
  return listed(*missions, fleet::MissionsTable, fleet::MissionsJson);
}

// Asks how long routes are. A name that several routes have means the one that robots follow.
Result<std::map<std::string, double>> Measure(fleet::OperatorPeer& peer,
                                              const std::set<std::string>& routes,
                                              std::chrono::milliseconds timeout) {
  std::map<std::string, double> lengths_m;
  for (const std::string& route : routes) {
    route::RouteQuery query;
    query.name = route;
    const auto reply = fleet::AskCatalog(*peer.exchange, peer.self, query, timeout);
    if (!reply) return tl::unexpected(reply.error());
    for (const route::RouteInfo& info : reply->page.routes) {
      if (info.standing == route::Standing::kActive) lengths_m[route] = info.length_m;
    }
  }
  return lengths_m;
}

int Figure(const CLI::App& app, const program::CommonOptions& common,
           const MissionsOptions& options) {
  exchange::TopicUse use = exchange::HistoryTopics();
  const exchange::TopicUse catalog = exchange::ObserverTopics();
  use.write.insert(use.write.end(), catalog.write.begin(), catalog.write.end());
  use.read.insert(use.read.end(), catalog.read.begin(), catalog.read.end());
  auto peer = fleet::JoinAsOperator(common, use);
  if (!peer) return program::Complain(app, peer.error());
  const auto timeout = ToMilliseconds(options.timeout_s);
  const mission::Query query = QueryOf(options);
  const auto missions =
      fleet::AskForMissions(*peer->exchange, peer->self, query, kAllMissions, timeout);
  if (!missions) return program::Complain(app, missions.error());
  mission::Query of_commands;
  of_commands.from_unix_ms = query.from_unix_ms;
  const auto commands =
      fleet::AskForCommands(*peer->exchange, peer->self, of_commands, kAllMissions, timeout);
  if (!commands) return program::Complain(app, commands.error());
  const auto lengths_m = Measure(*peer, fleet::RoutesToMeasure(*missions), timeout);
  if (!lengths_m) return program::Complain(app, lengths_m.error());
  const fleet::FiguresBy by = *fleet::ReadFiguresBy(options.by);
  const auto figures = fleet::FiguresOf(*missions, *commands, *lengths_m, by);
  const std::string text = options.csv    ? fleet::FiguresCsv(figures, by)
                           : options.json ? program::Indented(fleet::FiguresJson(figures))
                                          : fleet::FiguresTable(figures, by);
  std::fputs(text.c_str(), stdout);
  return program::kExitOk;
}

int List(const CLI::App& app, const program::CommonOptions& common,
         const MissionsOptions& options) {
  const program::StopSignal stop;
  auto peer = fleet::JoinAsOperator(common, exchange::HistoryTopics());
  if (!peer) return program::Complain(app, peer.error());
  std::optional<std::string> shown;
  do {
    const auto now = Look(*peer, options);
    if (!now && !(options.watch && shown)) return program::Complain(app, now.error());
    if (!now) {
      fmt::print(stderr, "{}\n", now.error().message);
    } else if (now->compared != shown) {
      std::fputs(now->text.c_str(), stdout);
      std::fflush(stdout);
      shown = now->compared;
    }
    // Messages that come meanwhile are not needed.
    if (options.watch) (void)peer->exchange->Take(kLookAgain);
  } while (options.watch && !program::StopSignal::requested());
  return program::kExitOk;
}

Command AddSend(CLI::App& parent, const program::CommonOptions& common) {
  auto options = std::make_shared<SendOptions>();
  CLI::App* app = parent.add_subcommand("send", "Send an available robot along routes");
  app->footer(kSendExamples);
  app->add_option("ROBOT", options->robot,
                  "Its name, as --name of 'trailcast-agent serve'; '@GROUP' for whichever robot of "
                  "a group is free first, those that are numbered alike; several with commas "
                  "between them, which all get it or none")
      ->required()
      ->check(AddressValidator());
  auto* orders = app->add_option("ORDERS", options->orders, "What it is to do: see below");
  app->add_option("--again", options->again,
                  "In place of ORDERS: those of this mission, which 'trailcast missions' lists, of "
                  "any robot; to a place, by the best path from where this robot stands")
      ->check(program::NameValidator())
      ->excludes(orders);
  app->add_option("--id", options->id,
                  "The mission's name, by which it is done once however often it is sent; default: "
                  "drawn")
      ->check(program::NameValidator());
  app->add_option(
      "--from", options->from,
      "Where a robot stands that goes to a place, ROUTE@METRES or a name; default: where "
      "it last said so");
  AddPhotoOptions(*app, options->photos);
  app->add_option("--valid", options->valid_s,
                  "How long a server keeps it for a robot that is out of reach: 90s, 20min, 2h; 0: "
                  "for ever")
      ->transform(TimeSpan("TIME"))
      ->check(CLI::Range(0.0, kLongest_s))
      ->capture_default_str();
  app->add_flag("--goes-on", options->goes_on,
                "It goes on by itself after its agent has started again; without, it stands then "
                "until it is told to resume");
  app->add_flag("--unheard", options->unheard,
                "Also a robot that nobody has ever heard of: a server keeps it until it is there");
  app->add_flag("--wait", options->wait, "Until it has ended; tells what becomes of it meanwhile");
  app->add_flag("--json", options->json, "For programs: what is known of it in the end");
  app->add_option("--timeout", options->timeout_s, "Seconds to wait for an answer")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 3600.0));
  return {app, [app, options, &common] { return Send(*app, common, *options); }};
}

Command AddMissions(CLI::App& parent, const program::CommonOptions& common) {
  auto options = std::make_shared<MissionsOptions>();
  CLI::App* app =
      parent.add_subcommand("missions", "List what robots were sent to do, and what became of it");
  app->footer(kMissionsExamples);
  const auto name = [&](const char* flag, std::string& value, const char* help) {
    app->add_option(flag, value, help)->check(program::NameValidator());
  };
  name("--robot", options->query.agent, "Only of this one");
  name("--route", options->query.route, "Only with this route in their orders");
  name("--mission", options->query.id, "Only of this name");
  name("--sent-by", options->query.client, "Only sent by this operator");
  std::vector<std::string> states;
  for (const auto& [state, value] : States()) states.push_back(state);
  auto* state = app->add_option("--state", options->states, "Only these; several: any of them");
  state->check(CLI::IsMember(states))->take_all()->allow_extra_args(false);
  app->add_flag("--open", options->open,
                "Only those that have not ended: each robot's mission, and then its queue, in its "
                "order, with what each waits for")
      ->excludes(state);
  app->add_option("--newer-than", options->newer_than_s, "Only sent since: 90min, 12h, 7d; 0: any")
      ->transform(TimeSpan("AGE"));
  app->add_option("--limit", options->limit, "Missions to list at most")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  app->add_flag("--commands", options->commands,
                "Those that robots were given with pause, resume, cancel, stop, release and end");
  auto* watch = app->add_flag("--watch", options->watch,
                              "Again whenever something has changed, until Ctrl-C");
  auto* by = app->add_option("--by", options->by,
                             "In place of the list, figures by 'robot', 'route' or 'week': "
                             "missions that have ended, the share that arrived, the kilometres of "
                             "the orders that were done, and how often a person had to see to a "
                             "robot: it failed, or was paused, stopped or cancelled on its way");
  by->check(CLI::IsMember({"robot", "route", "week"}))->excludes(watch)->excludes("--commands");
  app->add_flag("--csv", options->csv, "With --by: for spreadsheets")->needs(by);
  app->add_flag("--json", options->json, "For programs");
  app->add_option("--timeout", options->timeout_s, "Seconds to wait for a server")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 3600.0));
  return {app, [app, options, &common] {
            return options->by.empty() ? List(*app, common, *options)
                                       : Figure(*app, common, *options);
          }};
}

}  // namespace

std::vector<Command> AddMissionCommands(CLI::App& parent, const program::CommonOptions& common) {
  return {AddSend(parent, common), AddMissions(parent, common)};
}

}  // namespace trailcast::tool
