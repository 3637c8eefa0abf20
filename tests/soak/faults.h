#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/soak/fleet.h"

namespace trailcast::soak {

enum class FaultKind { kKill, kCut, kPause, kLoss, kFullDisk, kAddress, kClock };

struct FaultType {
  FaultKind kind;
  Role victim;  // the server for kLoss and kFullDisk
  [[nodiscard]] std::string Text() const;
};

// This deals all types of faults repeatedly, in an order drawn by the seed, so that every type
// comes up as often as the others.
class FaultDeck {
 public:
  explicit FaultDeck(std::uint64_t seed);
  // Returns the next one that `possible` accepts. Types that are passed over keep their turn.
  template <typename Possible>
  std::optional<FaultType> Draw(const Possible& possible) {
    if (left_.empty()) Shuffle();
    for (auto at = left_.begin(); at != left_.end(); ++at) {
      if (!possible(*at)) continue;
      const FaultType drawn = *at;
      left_.erase(at);
      return drawn;
    }
    return std::nullopt;
  }
  // Removes this type.
  void Leave(FaultKind kind, Role victim);
  // Draws from a uniform distribution.
  double Number(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }

 private:
  void Shuffle();
  std::mt19937_64 random_;
  std::vector<FaultType> types_;
  std::deque<FaultType> left_;
};

// This carries them out, one after the other: a fault begins, lasts a while and is repaired, and
// the next one waits until every process that runs has been heard again.
class Faults {
 public:
  Faults(std::uint64_t seed, Fleet& fleet) : deck_(seed), fleet_(fleet) {}

  // Kills the server no more.
  void SpareServer();
  [[nodiscard]] bool spares_server() const { return spare_server_; }
  // This inspects what the process left, before it is started again.
  void OnServerKilled(std::function<void()> look) { on_server_killed_ = std::move(look); }
  // No new fault begins while this is held.
  void Hold(bool held) { held_ = held; }
  // Returns whether there is no fault, and no process recovers from one.
  [[nodiscard]] bool calm() const { return stage_ == Stage::kCalm; }

  void Tick(Clock::time_point now);

  struct Recovery {
    std::string from;
    double seconds = 0.0;
  };
  [[nodiscard]] const std::vector<Recovery>& recoveries() const { return recoveries_; }
  // Returns what never recovered.
  [[nodiscard]] std::vector<std::string> TakeFailures() { return std::exchange(failures_, {}); }

 private:
  enum class Stage { kCalm, kWrong, kRecovering };

  void Begin(Clock::time_point now);
  void Mend(Clock::time_point now);
  void LookForRecovery(Clock::time_point now);
  [[nodiscard]] Clock::time_point In(Clock::time_point now, double from_s, double to_s);

  FaultDeck deck_;
  Fleet& fleet_;
  std::function<void()> on_server_killed_;
  bool spare_server_ = false;
  bool held_ = false;
  Stage stage_ = Stage::kCalm;
  Clock::time_point next_at_ = Clock::now();
  Clock::time_point mended_at_{};
  FaultType fault_{};
  Member* victim_ = nullptr;
  std::vector<Recovery> recoveries_;
  std::vector<std::string> failures_;
};

}  // namespace trailcast::soak
