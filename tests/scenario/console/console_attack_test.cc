// Robots are stopped from the console while strangers attack its log-in.
#include <arpa/inet.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/socket.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <thread>
#include <vector>

#include "tests/scenario/console/console_users.h"

namespace trailcast::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr int kAddresses = 16;

std::string StrangersAddress(int number) {
  return "127.0.1." + std::to_string(1 + number % kAddresses);
}

// Connections from many addresses, half of which say nothing, and half a byte now and then. For
// each that is hung up on another one comes.
class Idlers {
 public:
  Idlers(int port, int number) : port_(port), sockets_(number, -1), thread_([this] { Run(); }) {}
  ~Idlers() {
    over_ = true;
    thread_.join();
    for (const int socket : sockets_) {
      if (socket >= 0) close(socket);
    }
  }
  Idlers(const Idlers&) = delete;
  Idlers& operator=(const Idlers&) = delete;

  [[nodiscard]] int came() const { return came_; }

 private:
  static constexpr int kMostAtOnce = 50;

  void Run() {
    for (int turn = 0; !over_; ++turn) {
      int at_once = 0;
      for (std::size_t i = 0; i < sockets_.size(); ++i) {
        int& socket = sockets_[i];
        if (socket < 0) {
          if (at_once++ < kMostAtOnce) socket = Connect(static_cast<int>(i));
          continue;
        }
        const bool speaks = i % 2 == 0 && turn % 50 == 0;
        if (speaks) (void)send(socket, "\x16", 1, MSG_NOSIGNAL | MSG_DONTWAIT);
        char byte = 0;
        const ssize_t got = recv(socket, &byte, 1, MSG_DONTWAIT);
        if (got > 0 || (got < 0 && (errno == EAGAIN || errno == ENOTCONN))) continue;
        close(socket);
        socket = -1;
      }
      std::this_thread::sleep_for(milliseconds(20));
    }
  }
  int Connect(int number) {
    const int made = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (made < 0) return made;
    sockaddr_in from{};
    from.sin_family = AF_INET;
    inet_pton(AF_INET, StrangersAddress(number).c_str(), &from.sin_addr);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(port_));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    (void)bind(made, reinterpret_cast<sockaddr*>(&from), sizeof(from));
    (void)connect(made, reinterpret_cast<sockaddr*>(&to), sizeof(to));
    ++came_;
    return made;
  }

  const int port_;
  std::vector<int> sockets_;
  std::atomic<bool> over_{false};
  std::atomic<int> came_{0};
  std::thread thread_;
};

class ConsoleAttackTest : public ConsoleUsersTest {
 protected:
  void SetUp() override {
    ConsoleUsersTest::SetUp();
    rlimit files{};
    getrlimit(RLIMIT_NOFILE, &files);
    files.rlim_cur = files.rlim_max;
    setrlimit(RLIMIT_NOFILE, &files);
    robot_ = Robot("robot1", {"--picture-rate", "5"});
    agent_ = Serve("robot1");
    ASSERT_TRUE(agent_->WaitForOutput("available as 'robot1'")) << agent_->output();
    AddUser("anna", "operate");
    StartWithTls();
  }
  // Until the robot has answered; whoever is hung up on presses again.
  milliseconds Tell(const httplib::Headers& annas, const std::string& order) {
    const auto began = steady_clock::now();
    EXPECT_TRUE(WaitUntil([&] { return Post("/api/robots/robot1/" + order, annas).status == 200; }))
        << order << console_->output();
    return std::chrono::duration_cast<milliseconds>(steady_clock::now() - began);
  }
  // How long stops took, in rising order.
  std::vector<milliseconds> Stops(const httplib::Headers& annas) {
    const char* wanted = std::getenv("TRAILCAST_STOPS");
    std::vector<milliseconds> took(wanted == nullptr ? 20 : std::max(1, std::atoi(wanted)));
    for (milliseconds& each : took) {
      each = Tell(annas, "stop");
      (void)Tell(annas, "release");
    }
    std::sort(took.begin(), took.end());
    return took;
  }
  static milliseconds Median(const std::vector<milliseconds>& took) {
    return took[took.size() / 2];
  }
  static void Print(const char* what, const std::vector<milliseconds>& took) {
    const auto p99 = took[std::min(took.size() - 1, took.size() * 99 / 100)];
    std::printf("%s: of %zu stops the median took %d ms, p99 %d ms, the longest %d ms\n", what,
                took.size(), static_cast<int>(Median(took).count()), static_cast<int>(p99.count()),
                static_cast<int>(took.back().count()));
  }
};

TEST_F(ConsoleAttackTest, StopsReachTheRobotWhileTheLogInIsAttacked) {
  const auto annas = As("anna");
  (void)Tell(annas, "release");  // robot and console have met
  Print("alone", Stops(annas));
  std::vector<milliseconds> took;
  {
    std::atomic<bool> over{false};
    std::atomic<int> guesses{0};
    std::vector<std::thread> strangers;
    for (int i = 0; i < 6; ++i) {
      strangers.emplace_back([&, i] {
        for (int n = 0; !over; ++n) {
          const auto client = Client();
          client->set_interface(StrangersAddress(n));
          const json body{{"user", i == 0 ? "anna" : "name" + std::to_string(n)},
                          {"password", std::to_string(n)}};
          if (client->Post("/api/log-in", body.dump(), "application/json")) ++guesses;
        }
      });
    }
    EXPECT_TRUE(WaitUntil([&] { return guesses > 20; }));
    took = Stops(annas);
    over = true;
    for (std::thread& stranger : strangers) stranger.join();
    Print("while passwords are guessed", took);
    std::printf("%d guesses were answered\n", guesses.load());
  }
  EXPECT_LT(Median(took), std::chrono::seconds(2));
  {
    const Idlers idlers(port_, 3000);
    EXPECT_TRUE(WaitUntil([&] { return idlers.came() > 3000; }));
    took = Stops(annas);
    Print("beside 3000 connections that say nothing", took);
    std::printf("%d connections came\n", idlers.came());
  }
  EXPECT_LT(Median(took), std::chrono::seconds(2));
}

}  // namespace
}  // namespace trailcast::test
