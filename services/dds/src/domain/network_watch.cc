#include "services/dds/src/domain/network_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace trailcast::dds {
namespace {

bool IsUsable(const Interface& interface) { return interface.up && !interface.address.empty(); }

// An interface gives itself such an address if nobody assigns one (RFC 3927).
bool IsOfItsOwnMaking(const std::string& address) { return address.starts_with("169.254."); }

// The most important property comes first.
int Worth(const Interface& interface) {
  int worth = 0;
  for (const bool good : {interface.connected, interface.multicast,
                          !IsOfItsOwnMaking(interface.address), interface.hardware}) {
    worth = 2 * worth + (good ? 1 : 0);
  }
  return worth;
}

std::string Lack(const Interface& interface) {
  if (!interface.up) return "is down";
  return interface.ipv6 ? "has an IPv6 address alone, and DDS goes by IPv4 here"
                        : "has no IPv4 address";
}

}  // namespace

void NetworkWatch::Begin(const std::vector<Interface>& there, Time now) {
  chosen_ = Choose(there);
  trouble_ = chosen_.empty() ? WhyNone(there) : "";
  if (!chosen_.empty()) NoteJoin(now);
}

NetworkWatch::Step NetworkWatch::Look(const std::vector<Interface>& there, Time now) {
  std::vector<Interface> next = Choose(there);
  if (chosen_.empty()) trouble_ = WhyNone(there);
  if (next == chosen_) {
    next_.reset();
    return Step::kNone;
  }
  if (next_ != next) {
    next_ = next;
    next_since_ = now;
  }
  if (now - next_since_ < (next.empty() ? kSettles : Settles(now))) return Step::kNone;
  next_.reset();
  const std::string before = ToText(std::exchange(chosen_, std::move(next)));
  if (chosen_.empty()) {
    trouble_ = WhyNone(there);
    change_ = fmt::format("off the network, {} is gone: {}; waiting", before, trouble_);
    return Step::kLeave;
  }
  trouble_.clear();
  NoteJoin(now);
  change_ = fmt::format("on the network by {}", ToText(chosen_));
  if (!before.empty()) change_ += fmt::format(" instead of {}", before);
  return Step::kJoin;
}

std::vector<Interface> NetworkWatch::Choose(const std::vector<Interface>& there) const {
  std::vector<Interface> usable;
  std::copy_if(there.begin(), there.end(), std::back_inserter(usable), [&](const auto& each) {
    if (!IsUsable(each)) return false;
    if (by_ == By::kCyclone) return true;
    return wanted_.empty() ? !each.loopback : each.name == wanted_;
  });
  if (by_ == By::kCyclone || usable.empty()) return usable;
  auto best =
      wanted_.empty()
          ? std::max_element(usable.begin(), usable.end(),
                             [](const auto& a, const auto& b) { return Worth(a) < Worth(b); })
          : usable.begin();
  if (!chosen_.empty()) {
    const auto still = std::find(usable.begin(), usable.end(), chosen_.front());
    if (still != usable.end() && (!wanted_.empty() || Worth(*best) <= Worth(*still))) best = still;
  }
  return {*best};
}

std::string NetworkWatch::WhyNone(const std::vector<Interface>& there) const {
  std::string others;
  for (const Interface& each : there) {
    if (!wanted_.empty() && each.name == wanted_) {
      return fmt::format("the network interface '{}' {}", each.name, Lack(each));
    }
    if (!wanted_.empty()) {
      others += fmt::format("{}{}", others.empty() ? "" : ", ", each.name);
    } else if (!each.loopback) {
      others += fmt::format("{}{} {}", others.empty() ? "" : ", ", each.name, Lack(each));
    }
  }
  if (!wanted_.empty()) {
    return fmt::format("there is no network interface '{}', of: {}", wanted_, others);
  }
  return fmt::format(
      "no network interface is up and has an IPv4 address ({}); --network-interface lo meets the "
      "programs of this machine alone",
      others.empty() ? "there is none but the loopback" : others);
}

NetworkWatch::Clock::duration NetworkWatch::Settles(Time now) const {
  return joined_at_ && now - *joined_at_ < kCalm ? settles_ : kSettles;
}

void NetworkWatch::NoteJoin(Time now) {
  settles_ = std::min<Clock::duration>(2 * Settles(now), kSettlesAtMost);
  joined_at_ = now;
}

}  // namespace trailcast::dds
