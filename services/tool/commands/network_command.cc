// This is `trailcast network`.
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "services/base/time.h"
#include "services/fleet/network_client.h"
#include "services/fleet/operator_peer.h"
#include "services/network/words.h"
#include "services/program/json.h"
#include "services/tool/commands/command.h"
#include "services/tool/network_picture.h"

namespace trailcast::tool {
namespace {

struct NetworkOptions {
  std::vector<std::string> words;
  bool json = false;
  std::string plot;
  double timeout_s = 5.0;
};

constexpr const char* kNetworkExamples =
    "Words; without any, it lists the routes that are joined, junctions, what is closed, names,\n"
    "and proposed junctions:\n"
    "  join PLACE PLACE [both] [offset AHEAD,LEFT] [heading DEGREES]\n"
    "                       robots may change over from the first place to the second; both: and\n"
    "                       back; how the second lies there, where it is known. From 60 degrees "
    "on\n"
    "                       a robot turns there on the spot: to a route that was taught the other\n"
    "                       way, heading 180\n"
    "  part PLACE PLACE     no more, neither way\n"
    "  close ROUTE [FROM..TO]   no robot is sent along it by 'goto', and those under way to a\n"
    "                       place go round it, or stand and wait; open ROUTE [FROM..TO]\n"
    "  back ROUTE [FROM..TO]    robots may be sent backwards along it, too, a few metres, hardly\n"
    "                       bent, out of a dead end: it is narrow there from now on; ahead ROUTE\n"
    "                       [FROM..TO]: no more\n"
    "  limit ROUTE [FROM..TO] [speed F] [cost F]\n"
    "                       at most F times the taught speed; a metre counts as F when paths are\n"
    "                       compared; with neither, no limit any more\n"
    "  narrow ROUTE FROM..TO [ROUTE FROM..TO ...]\n"
    "                       robots cannot pass each other there: those that go to a place are let\n"
    "                       in one at a time, and wait before it. The sections are one place; a\n"
    "                       lane that is driven both ways was taught as two routes: name both\n"
    "  wide ROUTE [FROM..TO]    they can, on the whole of each such place\n"
    "  vacate ROUTE [FROM..TO]  whoever has one, or a dock, is not there any more: you have "
    "looked\n"
    "  name NAME PLACE [home] [dock]\n"
    "                       'goto NAME' leads there; forget NAME. 'goto home' leads to the "
    "nearest\n"
    "                       place that is a home; at a dock robots charge, one at a time\n"
    "  charge below PERCENT [until PERCENT]\n"
    "                       a robot with less battery goes to a free dock once its mission has\n"
    "                       ended, and goes on with its queue at the second, else at 90; charge\n"
    "                       never: none is sent, which is the default\n"
    "  proposals            only the junctions that the server proposes: places where two routes\n"
    "                       meet, looking the same way, by what scouts saw, and how sure it is\n"
    "  confirm PLACE PLACE  the junction proposed there is made; confirm all [above F]\n"
    "  refuse PLACE PLACE   it is not, nor proposed again for these revisions; refuse all [below "
    "F]\n"
    "  way FROM TO          the path that costs least, between PLACEs or named ones; FROM may be "
    "a\n"
    "                       robot, as it stands. Where robots lost their path lately a metre\n"
    "                       counts as more, and 'trailcast network' lists that\n"
    "  passing PLACE        the routes that pass there, by junctions and proposed ones, and where "
    "on\n"
    "                       each that is; PLACE, or what one is called\n"
    "A PLACE is ROUTE@METRES along it: hall@12.5; FROM..TO are metres, either may be missing.\n"
    "Examples:\n"
    "  trailcast network join hall@12 office@0\n"
    "  trailcast network join ring@31.4 ring@0     # its end is where it began\n"
    "  trailcast network confirm hall@12 office@0.4\n"
    "  trailcast network confirm all above 0.9     # as 'trailcast-server --junctions-auto' does\n"
    "  trailcast network join hall@20 home@0.5 heading 180\n"
    "  trailcast network back dock 0..3\n"
    "  trailcast network close hall 3..7\n"
    "  trailcast network narrow hall 3..7 back 10..14\n"
    "  trailcast network name loading-bay office@8\n"
    "  trailcast network name parking hall@0.5 home\n"
    "  trailcast network name dock1 hall@2 dock\n"
    "  trailcast network charge below 20 until 90\n"
    "  trailcast network way hall@2 loading-bay    # its sections, and how long it is\n"
    "  trailcast network way robot1 office@8 --json\n"
    "  trailcast network passing hall@12.3         # office@0.3  join hall@12 office@0\n"
    "  trailcast network --plot network.png\n"
    "A route is followed in the direction in which it was taught, and backwards where robots may.\n"
    "A junction or a name is of the revisions that robots follow when it is made; while another "
    "is\n"
    "followed, it is not used.\n"
    "Exit status: 0 done; 1 no way, or not done, and why; 2 wrong usage.";

bool AsksForProposals(const NetworkOptions& options) {
  return options.words.size() == 1 && options.words.front() == "proposals";
}

bool AsksForAll(const NetworkOptions& options) {
  return options.words.empty() || AsksForProposals(options);
}

bool AsksWhatPasses(const NetworkOptions& options) {
  return !options.words.empty() && options.words.front() == "passing";
}

bool Asks(const NetworkOptions& options) {
  return AsksForAll(options) || options.words.front() == "way" || AsksWhatPasses(options);
}

// Tells what an edit has changed.
std::string ChangedText(const std::string& edit, const std::vector<std::string>& lines) {
  const bool settles = edit == "confirm" || edit == "refuse";
  if (lines.empty()) {
    return settles ? "none is proposed that is so sure\n"
                   : "nothing is closed, limited or driven backwards there now\n";
  }
  const bool ends = edit == "part" || edit == "forget" || edit == "refuse" || edit == "wide";
  return (ends ? "no more: " : "") + fleet::NetworkText(lines);
}

// Checks the place of a `passing` question.
Result<void> CheckPlace(const NetworkOptions& options) {
  if (options.words.size() == 2)
    return network::ParseGoal(options.words[1]).map([](const auto&) {});
  return Fail(ErrorCode::kInvalidArgument,
              "'passing' takes one place: ROUTE@METRES, as hall@12.3, or what one is called");
}

// Names have no spaces, since a name with one counts as several words.
Result<void> OneWordEach(const std::vector<std::string>& words) {
  for (std::size_t i = 1; i < words.size(); ++i) {
    std::string name = words[i];
    if (name.find(' ') == std::string::npos) continue;
    std::replace(name.begin(), name.end(), ' ', '-');
    return Fail(ErrorCode::kInvalidArgument,
                "'{}' has a space: a name is 1 to 64 letters, digits, '_', '.' and '-', as '{}'",
                words[i], name);
  }
  return {};
}

int Print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  return program::kExitOk;
}
int PrintJson(const program::Json& json) { return Print(program::Indented(json)); }

int Run(const CLI::App& app, const program::CommonOptions& common, const NetworkOptions& options) {
  const std::string words = fmt::format("{}", fmt::join(options.words, " "));
  if (const auto one = OneWordEach(options.words); !one) {
    return ComplainOfUsage(app, one.error());
  }
  // Words that no server would understand are refused before any server is asked.
  if (!Asks(options)) {
    if (const auto edit = network::ParseEdit(words); !edit) {
      return ComplainOfUsage(app, edit.error());
    }
  } else if (AsksWhatPasses(options)) {
    if (const auto place = CheckPlace(options); !place) {
      return ComplainOfUsage(app, place.error());
    }
  } else if (!AsksForAll(options)) {
    if (const auto question = network::ParseQuestion(words); !question) {
      return ComplainOfUsage(app, question.error());
    }
  }
  if (!options.plot.empty() && !words.empty()) {
    return ComplainOfUsage(
        app, {ErrorCode::kInvalidArgument, "--plot draws all there is: no words beside it"});
  }
  const auto peer = fleet::JoinAsOperator(
      common, Asks(options) ? exchange::NetworkTopics() : exchange::JoinerTopics());
  if (!peer) return program::Complain(app, peer.error());
  const auto timeout = ToMilliseconds(options.timeout_s);
  if (AsksForAll(options)) {
    auto lines = fleet::AskForNetwork(*peer->exchange, peer->self, timeout);
    if (!lines) return program::Complain(app, lines.error());
    if (AsksForProposals(options)) {
      std::erase_if(*lines,
                    [](const std::string& line) { return !network::ParseListed(line).proposal; });
      if (lines->empty() && !options.json) return Print("no junctions are proposed\n");
    }
    if (!options.plot.empty()) {
      const auto written = PictureOf(*lines).and_then([&](const plot::NetworkPicture& picture) {
        return plot::DrawNetwork(picture).Write(options.plot);
      });
      if (!written) return program::Complain(app, written.error());
    }
    return options.json ? PrintJson(fleet::NetworkJson(*lines)) : Print(fleet::NetworkText(*lines));
  }
  if (AsksWhatPasses(options)) {
    const auto passing =
        fleet::AskWhatPasses(*peer->exchange, peer->self, options.words[1], timeout);
    if (!passing) return program::Complain(app, passing.error());
    return options.json ? PrintJson(fleet::PassingJson(*passing))
                        : Print(fleet::PassingText(*passing));
  }
  if (Asks(options)) {
    const auto way =
        fleet::AskForWay(*peer->exchange, peer->self, options.words[1], options.words[2], timeout);
    if (!way) return program::Complain(app, way.error());
    return options.json ? PrintJson(fleet::WayJson(*way)) : Print(fleet::WayText(*way));
  }
  const auto lines = fleet::AskToJoin(*peer->exchange, peer->self, words, timeout);
  if (!lines) return program::Complain(app, lines.error());
  if (options.json) return PrintJson(fleet::NetworkJson(*lines));
  return Print(ChangedText(options.words.front(), *lines));
}

}  // namespace

Command AddNetworkCommand(CLI::App& parent, const program::CommonOptions& common) {
  auto options = std::make_shared<NetworkOptions>();
  CLI::App* app = parent.add_subcommand(
      "network", "How routes are joined or might be, what is closed, and which way leads where");
  app->footer(kNetworkExamples);
  app->add_option("WORDS", options->words, "What to change, or to ask: see below");
  app->add_flag("--json", options->json, "For programs");
  app->add_option("--plot", options->plot,
                  "Where a picture of it goes (PNG, or SVG by its name): routes as straight lines, "
                  "metres to scale, junctions, what is closed, narrow or limited, names");
  app->add_option("--timeout", options->timeout_s, "Seconds to wait for a server")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 3600.0));
  return {app, [app, options, &common] { return Run(*app, common, *options); }};
}

}  // namespace trailcast::tool
