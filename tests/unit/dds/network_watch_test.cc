#include "services/dds/src/domain/network_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::dds {
namespace {

using std::chrono::seconds;
using testing::HasSubstr;
using Step = NetworkWatch::Step;

Interface Loopback() {
  return {.name = "lo",
          .index = 1,
          .address = "127.0.0.1",
          .up = true,
          .connected = true,
          .loopback = true};
}
Interface Wired(const std::string& address) {
  return {.name = "eth0",
          .index = 2,
          .address = address,
          .up = true,
          .connected = true,
          .multicast = true,
          .hardware = true};
}
Interface Radio(const std::string& address) {
  Interface radio = Wired(address);
  radio.name = "wlan0";
  radio.index = 3;
  return radio;
}
Interface OfContainers() {
  Interface bridge = Wired("172.17.0.1");
  bridge.name = "docker0";
  bridge.index = 4;
  bridge.hardware = false;
  return bridge;
}
Interface Down(Interface interface) {
  interface.up = false;
  return interface;
}
Interface WithoutCable(Interface interface) {
  interface.connected = false;
  return interface;
}
Interface MadeAnew(Interface interface) {
  interface.index += 10;
  return interface;
}

class NetworkWatchTest : public testing::Test {
 protected:
  using There = std::vector<Interface>;

  void Begin(const There& there, const std::string& wanted = "",
             NetworkWatch::By by = NetworkWatch::By::kOne) {
    watch_.emplace(wanted, by);
    watch_->Begin(there, now_);
  }
  // Looks once a second for so long: what was done at last, and when, in seconds.
  struct Done {
    Step step = Step::kNone;
    int after_s = 0;
    int steps = 0;
  };
  Done LookFor(int duration_s, const There& there) {
    Done done;
    for (int second = 0; second < duration_s; ++second) {
      const Step step = watch_->Look(there, now_);
      if (step != Step::kNone) done = {step, second, done.steps + 1};
      now_ += seconds(1);
    }
    return done;
  }
  [[nodiscard]] std::string By() const { return ToText(watch_->chosen()); }

  std::optional<NetworkWatch> watch_;
  NetworkWatch::Time now_{seconds(1000)};
};

TEST_F(NetworkWatchTest, GoesByWhatThereIsAndStaysThere) {
  Begin({Loopback(), Wired("10.0.0.7")});
  EXPECT_EQ(By(), "eth0 (10.0.0.7)");
  EXPECT_EQ(LookFor(100, {Loopback(), Wired("10.0.0.7")}).steps, 0);
  EXPECT_EQ(watch_->trouble(), "");
}

TEST_F(NetworkWatchTest, WaitsForAnAddressAndSaysWhatIsLacking) {
  Interface six = Wired("");
  six.ipv6 = true;
  Begin({Loopback(), Down(Radio("")), six});
  EXPECT_EQ(By(), "");
  EXPECT_THAT(watch_->trouble(), HasSubstr("wlan0 is down, eth0 has an IPv6 address alone"));
  EXPECT_THAT(watch_->trouble(), HasSubstr("--network-interface lo"));
  EXPECT_EQ(LookFor(100, {Loopback(), Wired("")}).steps, 0);
  EXPECT_THAT(watch_->trouble(), HasSubstr("eth0 has no IPv4 address"));
  const Done done = LookFor(10, {Loopback(), Wired("10.0.0.7")});
  EXPECT_EQ(done.step, Step::kJoin);
  EXPECT_EQ(done.after_s, 1);
  EXPECT_EQ(watch_->change(), "on the network by eth0 (10.0.0.7)");
  EXPECT_EQ(watch_->trouble(), "");
}

TEST_F(NetworkWatchTest, TheLoopbackIsUsedWhereItIsNamed) {
  Begin({Loopback()}, "lo");
  EXPECT_EQ(By(), "lo (127.0.0.1)");
  Begin({Loopback()});
  EXPECT_EQ(By(), "");
  EXPECT_THAT(watch_->trouble(), HasSubstr("there is none but the loopback"));
}

TEST_F(NetworkWatchTest, ANamedInterfaceIsWaitedForWhateverElseThereIs) {
  Begin({Loopback(), Wired("10.0.0.7")}, "wlan0");
  EXPECT_EQ(watch_->trouble(), "there is no network interface 'wlan0', of: lo, eth0");
  EXPECT_EQ(LookFor(3, {Loopback(), Wired("10.0.0.7"), Down(Radio("10.1.0.7"))}).steps, 0);
  EXPECT_EQ(watch_->trouble(), "the network interface 'wlan0' is down");
  EXPECT_EQ(LookFor(3, {Loopback(), Wired("10.0.0.7"), Radio("10.1.0.7")}).step, Step::kJoin);
  EXPECT_EQ(By(), "wlan0 (10.1.0.7)");
}

TEST_F(NetworkWatchTest, AnotherAddressIsJoinedBy) {
  Begin({Loopback(), Radio("10.0.0.7")});
  LookFor(100, {Loopback(), Radio("10.0.0.7")});
  EXPECT_EQ(LookFor(5, {Loopback(), Radio("10.0.0.9")}).step, Step::kJoin);
  EXPECT_EQ(watch_->change(), "on the network by wlan0 (10.0.0.9) instead of wlan0 (10.0.0.7)");
}

TEST_F(NetworkWatchTest, AnInterfaceThatIsMadeAnewIsAnother) {
  Begin({Loopback(), Radio("10.0.0.7")});
  EXPECT_EQ(LookFor(5, {Loopback(), MadeAnew(Radio("10.0.0.7"))}).step, Step::kJoin);
}

TEST_F(NetworkWatchTest, LeavesWhatIsGoneAndComesBack) {
  Begin({Loopback(), Radio("10.0.0.7")});
  const Done left = LookFor(5, {Loopback(), Radio("")});
  EXPECT_EQ(left.step, Step::kLeave);
  EXPECT_EQ(left.steps, 1);
  EXPECT_THAT(watch_->change(), HasSubstr("wlan0 (10.0.0.7) is gone"));
  EXPECT_THAT(watch_->change(), HasSubstr("wlan0 has no IPv4 address"));
  EXPECT_THAT(watch_->trouble(), HasSubstr("wlan0 has no IPv4 address"));
  EXPECT_EQ(LookFor(5, {Loopback(), Radio("10.0.0.7")}).step, Step::kJoin);
}

TEST_F(NetworkWatchTest, WhatIsBackWithinASecondWasNoChange) {
  Begin({Loopback(), Radio("10.0.0.7")});
  for (int time = 0; time < 20; ++time) {
    EXPECT_EQ(LookFor(1, {Loopback(), Radio("")}).steps, 0);
    EXPECT_EQ(LookFor(1, {Loopback(), Radio("10.0.0.7")}).steps, 0);
  }
}

TEST_F(NetworkWatchTest, OneThatFlapsIsJoinedEverMoreRarely) {
  Begin({Loopback(), Radio("10.0.0.7")});
  int joins = 0;
  for (int time = 0; time < 60; ++time) {
    LookFor(5, {Loopback()});
    if (LookFor(5, {Loopback(), Radio("10.0.0.7")}).step == Step::kJoin) ++joins;
  }
  EXPECT_GE(joins, 1);
  EXPECT_LE(joins, 25) << "of sixty times within ten minutes";
  // Once it lasts, it is soon joined as ever.
  LookFor(100, {Loopback(), Radio("10.0.0.7")});
  EXPECT_EQ(By(), "wlan0 (10.0.0.7)");
  LookFor(5, {Loopback()});
  EXPECT_EQ(LookFor(5, {Loopback(), Radio("10.0.0.7")}).after_s, 1);
}

TEST_F(NetworkWatchTest, WhatWorksIsKeptThoughAnotherOfItsKindComes) {
  Begin({Loopback(), Radio("10.0.0.7")});
  EXPECT_EQ(LookFor(20, {Loopback(), Wired("10.1.0.7"), Radio("10.0.0.7")}).steps, 0);
}

TEST_F(NetworkWatchTest, ABetterOneIsGoneOverTo) {
  Begin({Loopback(), OfContainers()});
  EXPECT_EQ(By(), "docker0 (172.17.0.1)");
  EXPECT_EQ(LookFor(5, {Loopback(), Wired("169.254.3.4"), OfContainers()}).steps, 0);
  EXPECT_EQ(LookFor(5, {Loopback(), Wired("10.0.0.7"), OfContainers()}).step, Step::kJoin);
  EXPECT_EQ(By(), "eth0 (10.0.0.7)");
}

TEST_F(NetworkWatchTest, ACableThatIsPulledIsWaitedForUnlessThereIsAnotherWay) {
  Begin({Loopback(), Wired("10.0.0.7")});
  EXPECT_EQ(LookFor(20, {Loopback(), WithoutCable(Wired("10.0.0.7"))}).steps, 0);
  EXPECT_EQ(LookFor(20, {Loopback(), WithoutCable(Wired("10.0.0.7")), Radio("10.1.0.7")}).step,
            Step::kJoin);
  EXPECT_EQ(By(), "wlan0 (10.1.0.7)");
}

TEST_F(NetworkWatchTest, WhereCyclonesConfigurationNamesSomeItChoosesAnewWhateverChanges) {
  Begin({Loopback(), Wired("10.0.0.7")}, "", NetworkWatch::By::kCyclone);
  EXPECT_EQ(By(), "lo (127.0.0.1), eth0 (10.0.0.7)");
  EXPECT_EQ(LookFor(5, {Loopback(), Wired("10.0.0.7"), Radio("10.1.0.7")}).step, Step::kJoin);
}

}  // namespace
}  // namespace trailcast::dds
