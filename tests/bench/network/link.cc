// A line between two sites that delays and loses, for kernels that have no netem.
#include <fcntl.h>
#include <linux/if_tun.h>
#include <net/if.h>
#include <poll.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <deque>
#include <random>
#include <utility>
#include <vector>

#include "services/program/stop_signal.h"
#include "tests/bench/network/network_bench.h"

namespace trailcast::bench {
namespace {

using Clock = std::chrono::steady_clock;

Result<void> Checked(bool done, const char* what) {
  if (done) return {};
  const int error = errno;
  return Fail(ErrorCode::kUnavailable, "{}: {}", what, strerror(error));
}

// This is one end of the network interface "wan", which disappears with the process.
class End {
 public:
  End() = default;
  ~End() {
    if (handle_ >= 0) close(handle_);
  }
  End(const End&) = delete;
  End& operator=(const End&) = delete;

  // In the network of the process `pid`, where this thread then is.
  [[nodiscard]] Result<void> Open(int pid) {
    const int network = open(fmt::format("/proc/{}/ns/net", pid).c_str(), O_RDONLY | O_CLOEXEC);
    if (auto ok = Checked(network >= 0, "looking for a network"); !ok) return ok;
    const bool entered = setns(network, CLONE_NEWNET) == 0;
    if (auto ok = Checked(entered, "entering a network"); !ok) return ok;
    close(network);
    handle_ = open("/dev/net/tun", O_RDWR | O_NONBLOCK | O_CLOEXEC);
    if (auto ok = Checked(handle_ >= 0, "opening /dev/net/tun"); !ok) return ok;
    ifreq wanted{};
    wanted.ifr_flags = IFF_TUN | IFF_NO_PI;
    std::strncpy(wanted.ifr_name, "wan", IFNAMSIZ - 1);
    return Checked(ioctl(handle_, TUNSETIFF, &wanted) == 0, "making the interface 'wan'");
  }
  [[nodiscard]] int handle() const { return handle_; }

 private:
  int handle_ = -1;
};

// One direction.
class Direction {
 public:
  Direction(int from, int to, const LinkOptions& options, std::uint32_t seed)
      : from_(from), to_(to), options_(options), random_(seed) {}

  void Read(Clock::time_point now) {
    std::array<std::uint8_t, 65536> packet{};
    for (;;) {
      const ssize_t size = read(from_, packet.data(), packet.size());
      if (size <= 0) return;
      const bool lost = share_(random_) < options_.loss || under_way_.size() >= kMostUnderWay;
      if (lost) continue;
      under_way_.emplace_back(now + options_.delay,
                              std::vector(packet.begin(), packet.begin() + size));
    }
  }
  void Write(Clock::time_point now) {
    for (; !under_way_.empty() && under_way_.front().first <= now; under_way_.pop_front()) {
      const auto& packet = under_way_.front().second;
      // An interface that is down takes nothing: the packet is lost, as on any line.
      [[maybe_unused]] const ssize_t written = write(to_, packet.data(), packet.size());
    }
  }
  [[nodiscard]] Clock::duration Wait(Clock::time_point now) const {
    constexpr std::chrono::seconds kLongest{1};
    if (under_way_.empty()) return kLongest;
    return std::clamp<Clock::duration>(under_way_.front().first - now, Clock::duration(0),
                                       kLongest);
  }

 private:
  // A router's memory holds this much of a fast line.
  static constexpr std::size_t kMostUnderWay = 10'000;

  int from_;
  int to_;
  LinkOptions options_;
  std::mt19937 random_;
  std::uniform_real_distribution<double> share_{0.0, 1.0};
  std::deque<std::pair<Clock::time_point, std::vector<std::uint8_t>>> under_way_;
};

}  // namespace

Result<void> RunLink(const LinkOptions& options) {
  const program::StopSignal stop;
  End one;
  End other;
  if (auto opened = one.Open(options.from_pid); !opened) return opened;
  if (auto opened = other.Open(options.to_pid); !opened) return opened;
  Direction there(one.handle(), other.handle(), options, 1);
  Direction back(other.handle(), one.handle(), options, 2);
  fmt::print("ready\n");
  std::fflush(stdout);
  while (!program::StopSignal::requested()) {
    auto now = Clock::now();
    const auto wait = std::chrono::duration_cast<std::chrono::nanoseconds>(
        std::min(there.Wait(now), back.Wait(now)));
    const timespec longest{.tv_sec = wait.count() / 1'000'000'000,
                           .tv_nsec = wait.count() % 1'000'000'000};
    std::array<pollfd, 2> ends{{{one.handle(), POLLIN, 0}, {other.handle(), POLLIN, 0}}};
    (void)ppoll(ends.data(), ends.size(), &longest, nullptr);
    now = Clock::now();
    there.Read(now);
    back.Read(now);
    there.Write(now);
    back.Write(now);
  }
  return {};
}

}  // namespace trailcast::bench
