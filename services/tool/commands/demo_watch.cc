#include "services/tool/commands/demo_watch.h"

#include <chrono>
#include <cstdio>
#include <utility>

#include "services/program/live_lines.h"
#include "services/program/stop_signal.h"

namespace trailcast::tool {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kTakeWait = std::chrono::milliseconds(100);
// After the last process has ended, its last status may still be on its way.
constexpr auto kLastWords = std::chrono::milliseconds(300);

class Watch {
 public:
  Watch(demo::DemoFleet& fleet, const std::vector<demo::DemoRobot>& robots,
        exchange::RouteExchange& exchange, WatchOptions options)
      : fleet_(fleet),
        robots_(robots),
        exchange_(exchange),
        options_(std::move(options)),
        live_(stdout) {}

  Watched Run() {
    const auto began = Clock::now();
    Watched result = Watched::kEnded;
    while (!fleet_.RobotsEnded()) {
      const double elapsed_s = std::chrono::duration<double>(Clock::now() - began).count();
      Take(kTakeWait);
      live_.Show(Lines(elapsed_s));
      if (program::StopSignal::requested()) return Watched::kInterrupted;
      if (const auto broken = fleet_.Broken()) {
        std::fputs((*broken + "\n").c_str(), stderr);
        return Watched::kBroken;
      }
      const auto over = options_.step(view_);
      if (!over) {
        std::fputs((over.error().message + "\n").c_str(), stderr);
        return Watched::kBroken;
      }
      if (*over) break;
      if (elapsed_s > options_.timeout_s) {
        result = Watched::kTooLong;
        break;
      }
    }
    Take(kLastWords);
    live_.Show(Lines(std::chrono::duration<double>(Clock::now() - began).count()), true);
    return result;
  }

 private:
  void Take(std::chrono::milliseconds max_wait) {
    const std::vector<exchange::Message> messages = exchange_.Take(max_wait);
    for (const exchange::Message& message : messages) view_.Handle(message);
    options_.hear(messages);
  }
  std::vector<std::string> Lines(double elapsed_s) const {
    std::vector<std::string> lines{options_.headline(elapsed_s)};
    for (const demo::DemoRobot& robot : robots_) {
      lines.push_back(demo::StatusLine(robot.name, robot.camera, view_.Find(AgentId(robot.name))));
    }
    return lines;
  }

  demo::DemoFleet& fleet_;
  const std::vector<demo::DemoRobot>& robots_;
  exchange::RouteExchange& exchange_;
  WatchOptions options_;
  demo::FleetView view_;
  program::LiveLines live_;
};

}  // namespace

Watched WatchFleet(demo::DemoFleet& fleet, const std::vector<demo::DemoRobot>& robots,
                   exchange::RouteExchange& exchange, WatchOptions options) {
  return Watch(fleet, robots, exchange, std::move(options)).Run();
}

}  // namespace trailcast::tool
