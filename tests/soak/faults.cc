#include "tests/soak/faults.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <csignal>

namespace trailcast::soak {
namespace {

// A fleet that needs longer than this to find itself again after a fault has failed. On an idle
// machine it takes a tenth of that; the rest is for machines at work on other things.
constexpr std::chrono::seconds kRecoverWithin{120};

// Longer than the server keeps what was retired.
constexpr std::chrono::hours kClockStep{40 * 24};

constexpr std::array kTypes{
    FaultType{FaultKind::kKill, Role::kServer},     FaultType{FaultKind::kKill, Role::kScout},
    FaultType{FaultKind::kKill, Role::kFollower},   FaultType{FaultKind::kCut, Role::kServer},
    FaultType{FaultKind::kCut, Role::kScout},       FaultType{FaultKind::kCut, Role::kFollower},
    FaultType{FaultKind::kPause, Role::kServer},    FaultType{FaultKind::kPause, Role::kScout},
    FaultType{FaultKind::kPause, Role::kFollower},  FaultType{FaultKind::kLoss, Role::kServer},
    FaultType{FaultKind::kFullDisk, Role::kServer}, FaultType{FaultKind::kAddress, Role::kServer},
    FaultType{FaultKind::kAddress, Role::kScout},   FaultType{FaultKind::kAddress, Role::kFollower},
    FaultType{FaultKind::kClock, Role::kServer},    FaultType{FaultKind::kClock, Role::kScout},
    FaultType{FaultKind::kClock, Role::kFollower},
};

// How long each lasts. The lease of a DDS participant, 10 s, lies within those of cuts and pauses.
struct Span {
  double from_s;
  double to_s;
};
Span SpanOf(FaultKind kind) {
  switch (kind) {
    case FaultKind::kKill:
      return {0.3, 3.0};
    case FaultKind::kCut:
      return {2.0, 15.0};
    case FaultKind::kPause:
      return {1.0, 14.0};
    case FaultKind::kLoss:
      return {5.0, 15.0};
    case FaultKind::kFullDisk:
      return {3.0, 8.0};
    case FaultKind::kAddress:
      return {1.0, 8.0};
    case FaultKind::kClock:
      return {3.0, 15.0};
  }
  return {};
}

}  // namespace

std::string FaultType::Text() const {
  static constexpr std::array kVictims{"server", "scout", "follower"};
  const char* who = kVictims.at(static_cast<std::size_t>(victim));
  switch (kind) {
    case FaultKind::kKill:
      return fmt::format("{} killed", who);
    case FaultKind::kCut:
      return fmt::format("{} cut off", who);
    case FaultKind::kPause:
      return fmt::format("{} paused", who);
    case FaultKind::kLoss:
      return "packets lost everywhere";
    case FaultKind::kFullDisk:
      return "server's disk full";
    case FaultKind::kAddress:
      return fmt::format("{} given another address", who);
    case FaultKind::kClock:
      return fmt::format("{}'s clock stepped, and stepped back", who);
  }
  return "";
}

FaultDeck::FaultDeck(std::uint64_t seed) : random_(seed), types_(kTypes.begin(), kTypes.end()) {}

void FaultDeck::Leave(FaultKind kind, Role victim) {
  const auto is_it = [&](const FaultType& type) {
    return type.kind == kind && type.victim == victim;
  };
  std::erase_if(types_, is_it);
  std::erase_if(left_, is_it);
}

void FaultDeck::Shuffle() {
  left_.assign(types_.begin(), types_.end());
  std::shuffle(left_.begin(), left_.end(), random_);
}

void Faults::SpareServer() {
  spare_server_ = true;
  deck_.Leave(FaultKind::kKill, Role::kServer);
}

void Faults::Tick(Clock::time_point now) {
  if (stage_ == Stage::kRecovering) return LookForRecovery(now);
  if (now < next_at_) return;
  if (stage_ == Stage::kWrong) return Mend(now);
  if (!held_) Begin(now);
}

Clock::time_point Faults::In(Clock::time_point now, double from_s, double to_s) {
  return now + std::chrono::duration_cast<Clock::duration>(
                   std::chrono::duration<double>(deck_.Number(from_s, to_s)));
}

void Faults::Begin(Clock::time_point now) {
  const auto drawn =
      deck_.Draw([this](const FaultType& type) { return !fleet_.Running(type.victim).empty(); });
  if (!drawn) return;
  fault_ = *drawn;
  const std::vector<Member*> running = fleet_.Running(fault_.victim);
  const double share = deck_.Number(0.0, 1.0);
  victim_ = running.at(static_cast<std::size_t>(share * static_cast<double>(running.size())));
  constexpr double kLeastLoss = 0.05;
  constexpr double kMoreLoss = 0.15;
  constexpr double kForward = 0.5;
  switch (fault_.kind) {
    case FaultKind::kKill:
      victim_->Kill();
      if (fault_.victim == Role::kServer && on_server_killed_) on_server_killed_();
      break;
    case FaultKind::kCut:
      fleet_.Cut(*victim_);
      break;
    case FaultKind::kPause:
      victim_->Signal(SIGSTOP);
      break;
    case FaultKind::kLoss:
      fleet_.Lose(kLeastLoss + kMoreLoss * share);
      break;
    case FaultKind::kFullDisk:
      fleet_.FillDisk();
      break;
    case FaultKind::kAddress:
      victim_->LoseAddress();
      break;
    case FaultKind::kClock:
      victim_->SetClockAhead(share < kForward ? kClockStep : -kClockStep);
      break;
  }
  stage_ = Stage::kWrong;
  const Span span = SpanOf(fault_.kind);
  next_at_ = In(now, span.from_s, span.to_s);
}

void Faults::Mend(Clock::time_point now) {
  switch (fault_.kind) {
    case FaultKind::kKill:
      fleet_.Resume(fault_.victim, *victim_);
      break;
    case FaultKind::kCut:
      fleet_.Join(*victim_);
      break;
    case FaultKind::kPause:
      if (victim_->running()) victim_->Signal(SIGCONT);
      break;
    case FaultKind::kLoss:
      fleet_.Lose(0.0);
      break;
    case FaultKind::kFullDisk:
      fleet_.ClearDisk();
      break;
    case FaultKind::kAddress:
      victim_->TakeOtherAddress();
      break;
    case FaultKind::kClock:
      victim_->SetClockAhead(std::chrono::hours(0));
      break;
  }
  stage_ = Stage::kRecovering;
  mended_at_ = now;
}

void Faults::LookForRecovery(Clock::time_point now) {
  const std::vector<std::string> silent = fleet_.SilentSince(mended_at_);
  const bool late = now > mended_at_ + kRecoverWithin;
  if (!silent.empty() && !late) return;
  if (late) {
    failures_.push_back(fmt::format("{} s after '{}' nothing is heard of {}",
                                    kRecoverWithin.count(), fault_.Text(),
                                    fmt::join(silent, ", ")));
  }
  recoveries_.push_back({fault_.Text(), std::chrono::duration<double>(now - mended_at_).count()});
  stage_ = Stage::kCalm;
  constexpr double kShortest_s = 0.5;
  constexpr double kLongest_s = 4.0;
  next_at_ = In(now, kShortest_s, kLongest_s);
}

}  // namespace trailcast::soak
