#include "tests/soak/casualties.h"

#include <fmt/format.h>

#include <csignal>
#include <utility>

namespace trailcast::soak {
namespace {

constexpr int kFirstHost = 10;  // beyond those of the fleet

}  // namespace

Casualties::Casualties(test::NetworkLab& lab, const std::filesystem::path& folder) : lab_(lab) {
  int host = kFirstHost;
  for (const auto& [fate, name] :
       {std::pair(Fate::kKilled, "to-be-killed"), std::pair(Fate::kStopped, "to-be-stopped"),
        std::pair(Fate::kCutOff, "to-be-cut-off")}) {
    casualties_.push_back({fate, std::make_unique<Member>(lab, host++, name, folder)});
  }
}

void Casualties::Begin(std::string route, std::filesystem::path stores) {
  route_ = std::move(route);
  stores_ = std::move(stores);
  started_ = false;
  for (Casualty& casualty : casualties_) casualty.struck = false;
}

void Casualties::Handle(const exchange::Message& message) {
  if (const auto* announced = std::get_if<exchange::RouteAnnouncement>(&message)) {
    const bool here = announced->info.name == route_ && announced->info.segment_count > 0;
    if (here && announced->holder != announced->info.scout && !started_) Start();
  } else if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) {
    for (Casualty& casualty : casualties_) {
      if (status->agent.value() != casualty.member->name()) continue;
      if (status->route == route_ && status->segments > 0 && !casualty.struck) Strike(casualty);
    }
  }
}

void Casualties::Start() {
  started_ = true;
  for (const Casualty& casualty : casualties_) {
    const auto store = stores_ / (casualty.member->name() + ".db");
    casualty.member->Start("trailcast-agent",
                           {"--store", store.string(), "fetch", "--route", route_});
  }
}

void Casualties::Strike(Casualty& casualty) {
  if (!casualty.member->running()) return;
  switch (casualty.fate) {
    case Fate::kKilled:
      casualty.member->Kill();
      break;
    case Fate::kStopped:
      casualty.member->Signal(SIGSTOP);
      break;
    case Fate::kCutOff:
      lab_.Cut(casualty.member->host());
      break;
  }
  casualty.struck = true;
  ++struck_;
}

void Casualties::End() {
  for (Casualty& casualty : casualties_) {
    if (!casualty.struck) {
      failures_.push_back(fmt::format("{}: {} was not seen at work:\n{}", route_,
                                      casualty.member->name(), casualty.member->LastWords()));
    }
    if (casualty.member->running()) casualty.member->Kill();
    casualty.member->Forget();
    if (casualty.struck && casualty.fate == Fate::kCutOff) lab_.Join(casualty.member->host());
  }
}

}  // namespace trailcast::soak
