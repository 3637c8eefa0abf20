#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "services/dds/src/domain/interfaces.h"

namespace trailcast::dds {

// Decides which network interface to use, and when to join again, as interfaces come, go and change
// their addresses. Cyclone itself looks at a machine's interfaces only once, when a domain is made.
// It stays on an interface as long as that exists and no better one does. It has no I/O and no
// clock.
class NetworkWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Clock = std::chrono::steady_clock;

  // A change has to last so long before anything is done about it.
  static constexpr std::chrono::seconds kSettles{1};
  // Interfaces flap. If the last join is less than kCalm ago, the time doubles, up to this.
  static constexpr std::chrono::seconds kSettlesAtMost{30};
  static constexpr std::chrono::seconds kCalm{60};

  enum class By : std::uint8_t {
    kOne,     // the named interface, or the best one
    kCyclone  // Cyclone's own configuration names some, so Cyclone chooses again whatever changes
  };
  // `wanted` is the interface's name. An empty one allows any but the loopback, which reaches
  // nobody else.
  explicit NetworkWatch(std::string wanted, By by = By::kOne)
      : wanted_(std::move(wanted)), by_(by) {}

  // Takes the interfaces at the beginning, which need not settle.
  void Begin(const std::vector<Interface>& there, Time now);

  enum class Step : std::uint8_t {
    kNone,
    kLeave,  // nothing can be used any more
    kJoin,   // leave the former choice, if any, and join by the present one
  };
  // Decides the next step; the caller asks every second or so.
  [[nodiscard]] Step Look(const std::vector<Interface>& there, Time now);

  // An empty list means that there is no interface to use; trouble() says why.
  [[nodiscard]] const std::vector<Interface>& chosen() const { return chosen_; }
  [[nodiscard]] const std::string& trouble() const { return trouble_; }
  // Describes the last step.
  [[nodiscard]] const std::string& change() const { return change_; }

 private:
  [[nodiscard]] std::vector<Interface> Choose(const std::vector<Interface>& there) const;
  [[nodiscard]] std::string WhyNone(const std::vector<Interface>& there) const;
  [[nodiscard]] Clock::duration Settles(Time now) const;
  void NoteJoin(Time now);

  std::string wanted_;
  By by_;
  std::vector<Interface> chosen_;
  std::optional<std::vector<Interface>> next_;  // to be chosen once it has settled
  Time next_since_{};
  std::optional<Time> joined_at_;
  Clock::duration settles_ = kSettles;
  std::string trouble_;
  std::string change_;
};

}  // namespace trailcast::dds
