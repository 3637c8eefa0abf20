#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "services/dds/src/domain/interfaces.h"

namespace trailcast::dds {

// Cyclone looks at a machine's interfaces once, when a domain is made. Decides, as they come, go
// and change their addresses, by which of them to be on the network, and when to join it anew.
// Stays where it is as long as that is there and nothing better is. No I/O, no clock.
class NetworkWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Clock = std::chrono::steady_clock;

  // So long a change has to last before anything is done about it.
  static constexpr std::chrono::seconds kSettles{1};
  // Twice as long each time, up to this, for who joined less than kCalm ago: interfaces flap.
  static constexpr std::chrono::seconds kSettlesAtMost{30};
  static constexpr std::chrono::seconds kCalm{60};

  enum class By : std::uint8_t {
    kOne,     // the one that is named, or the best there is
    kCyclone  // Cyclone's own configuration names some: whatever changes, it chooses anew
  };
  // `wanted`: the interface's name; empty: any but the loopback, which leads to nobody.
  explicit NetworkWatch(std::string wanted, By by = By::kOne)
      : wanted_(std::move(wanted)), by_(by) {}

  // What there is at the beginning, which need not settle.
  void Begin(const std::vector<Interface>& there, Time now);

  enum class Step : std::uint8_t {
    kNone,
    kLeave,  // nothing is chosen any more
    kJoin,   // by what is chosen now, having left what was chosen before
  };
  // To be asked every second or so.
  [[nodiscard]] Step Look(const std::vector<Interface>& there, Time now);

  // Empty: there is nothing to join by, and trouble() says why.
  [[nodiscard]] const std::vector<Interface>& chosen() const { return chosen_; }
  [[nodiscard]] const std::string& trouble() const { return trouble_; }
  // The last step in words.
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
