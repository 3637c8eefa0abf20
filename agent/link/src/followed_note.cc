#include "agent/link/followed_note.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "services/exchange/bounds.h"
#include "services/exchange/publish.h"

namespace trailcast::agent {
namespace {

using exchange::FollowedSections;

enum class OnPath { kSure, kUnsure, kLost, kNotSaid };

OnPath OnPathIn(const ReplayStep& step) {
  if (Waits(step.state) || step.saw_nothing || !step.robot_trouble.empty() ||
      !step.robot_waits_for.empty()) {
    return OnPath::kNotSaid;
  }
  switch (step.trust) {
    case Trust::kSure:
    case Trust::kDistant:
      return OnPath::kSure;
    case Trust::kUnsure:
    case Trust::kBlind:
    case Trust::kSeeking:
      return OnPath::kUnsure;
    case Trust::kLooking:
    case Trust::kLost:
      return OnPath::kLost;
    case Trust::kCovered:
      break;
  }
  return OnPath::kNotSaid;
}

// A robot a little beyond the end of a route is on its last section.
std::uint32_t NumberAt(double along_m, const route::RouteInfo& route) {
  double number = std::floor(std::max(0.0, along_m) / exchange::kFollowedSection_m);
  if (route.state == route::RouteState::kComplete && route.length_m > 0.0) {
    const double sections = std::ceil(route.length_m / exchange::kFollowedSection_m);
    number = std::min(number, sections - 1.0);
  }
  return static_cast<std::uint32_t>(number);
}

}  // namespace

void FollowedNote::Begin() {
  visit_.reset();
  on_path_ = false;
}

void FollowedNote::Note(const ReplayStep& step, const route::RouteInfo& route) {
  if (step.state == ReplayState::kArrived) {
    Leave();
    return Begin();
  }
  const OnPath on_path = OnPathIn(step);
  if (!step.along_m || on_path == OnPath::kNotSaid) {
    on_path_ = false;
    return;
  }
  on_path_ = on_path_ || on_path == OnPath::kSure;
  if (!on_path_) return;

  const Where where{route.key, NumberAt(*step.along_m, route)};
  const bool came = !visit_ || visit_->where.first != where.first ||
                    where.second > visit_->where.second ||
                    *step.along_m < visit_->furthest_m - kBack_m;
  if (came) {
    Leave();
    visit_ = {.where = where, .furthest_m = *step.along_m};
  }
  visit_->furthest_m = std::max(visit_->furthest_m, *step.along_m);
  if (on_path != OnPath::kLost) return;
  if (!visit_->lost) Add(visit_->where, {.passed = 1, .lost = 1});
  visit_->lost = true;
  on_path_ = false;
}

// A robot that only stood in a section did not pass it.
void FollowedNote::Leave() {
  if (visit_ && !visit_->lost) Add(visit_->where, {.passed = 1, .lost = 0});
  visit_.reset();
}

void FollowedNote::Add(const Where& where, Count more) {
  constexpr std::uint32_t kMost = exchange::kMaxTimesPassed;
  Count& count = counts_.Touch(where);
  if (count.passed + more.passed > kMost) return;
  count.passed += more.passed;
  count.lost += more.lost;
}

void FollowedNote::Tell(exchange::RouteExchange& to) {
  const auto told = [this](const exchange::Message& message, bool sent) {
    if (!sent) NotSent(message);
  };
  if (auto sent = exchange::PublishAll(to, Take(), told); !sent) {
    spdlog::debug("{}", sent.error().message);
  }
}

void FollowedNote::TellIfDue(exchange::RouteExchange& to, Clock::time_point now) {
  if (now < due_) return;
  due_ = now + kEvery;
  Tell(to);
}

std::vector<exchange::Message> FollowedNote::Take() {
  std::map<route::RouteKey, FollowedSections> told;
  std::vector<exchange::Message> messages;
  for (const auto& [where, count] : counts_) {
    FollowedSections& of = told[where.first];
    of.agent = agent_;
    of.key = where.first;
    of.sections.push_back({where.second, count.passed, count.lost});
    if (of.sections.size() < exchange::kMaxSectionsTold) continue;
    messages.emplace_back(std::move(of));
    told.erase(where.first);
  }
  for (auto& [key, of] : told) messages.emplace_back(std::move(of));
  counts_ = NewestMap<Where, Count>(kMostSections);
  return messages;
}

void FollowedNote::NotSent(const exchange::Message& message) {
  const auto* told = std::get_if<FollowedSections>(&message);
  if (told == nullptr) return;
  for (const FollowedSections::Section& each : told->sections) {
    Add({told->key, each.number}, {.passed = each.passed, .lost = each.lost});
  }
}

}  // namespace trailcast::agent
