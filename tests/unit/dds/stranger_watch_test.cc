#include "services/dds/src/stranger_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::dds {
namespace {

using std::chrono::seconds;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::UnorderedElementsAre;

class StrangerWatchTest : public testing::Test {
 protected:
  std::vector<std::string> After(seconds passed) {
    now_ += passed;
    return watch_.Tick(now_);
  }
  void See(const std::string& participant, const std::string& about, bool names_itself = false) {
    watch_.See(participant, {about, names_itself}, now_);
  }
  void Warn(const std::string& line) { EXPECT_TRUE(watch_.HandleWarning(line, now_)) << line; }

  // These are the words of Cyclone DDS 0.10.2.
  const std::string expired_ =
      "1795362525.549122 [0]        fsm: Begin handshake reply failed: Certificate not valid: "
      "error: "
      "certificate has expired; subject: /CN=scout.4f2a9c0d11223344.3(code: 200)";
  StrangerWatch watch_;
  StrangerWatch::Time now_{};
};

TEST_F(StrangerWatchTest, OneThatDoesNotProveItselfIsToldOnce) {
  See("1:2:3", "participant 1:2:3, calling itself 'robot-9'");
  EXPECT_THAT(After(seconds(9)), IsEmpty());
  EXPECT_THAT(After(seconds(1)), ElementsAre(AllOf(HasSubstr("kept out"), HasSubstr("'robot-9'"),
                                                   HasSubstr("not proven"))));
  EXPECT_THAT(After(seconds(60)), IsEmpty());
}

TEST_F(StrangerWatchTest, OfTwoStrangersTheOneThatNamesItselfIsNotTheOneWithTheCertificate) {
  See("1:2:3", "participant 1:2:3, host lab", true);
  See("4:5:6", "participant 4:5:6");
  Warn(expired_);
  EXPECT_THAT(After(seconds(10)),
              ElementsAre(HasSubstr("scout.4f2a9c0d11223344.3"),
                          AllOf(HasSubstr("host lab"), HasSubstr("not proven"))));
}

TEST_F(StrangerWatchTest, ARefusalBelongsToWhoCameThen) {
  const std::string revoked =
      "Certificate not valid: error: certificate revoked; subject: /CN=scout.00000000.3(code: 200)";
  See("1:2:3", "participant 1:2:3");
  Warn(expired_);
  now_ += seconds(5);
  See("4:5:6", "participant 4:5:6");
  Warn(revoked);
  EXPECT_THAT(After(seconds(60)), SizeIs(2)) << "and no third or fourth";
}

TEST_F(StrangerWatchTest, MembersAndWhoHasGoneAreNotTold) {
  See("1:2:3", "a");
  watch_.Prove("1:2:3", "");
  watch_.Prove("4:5:6", "");  // what it writes was known before it was
  See("4:5:6", "b");
  See("7:8:9", "c");
  watch_.Lose("7:8:9");
  EXPECT_THAT(After(seconds(60)), IsEmpty());
}

TEST_F(StrangerWatchTest, ARefusedCertificateIsToldAtOnceWithWhyAndNotAsASecondStranger) {
  See("1:2:3", "participant 1:2:3");
  Warn(expired_);
  EXPECT_THAT(After(seconds(0)), ElementsAre(AllOf(HasSubstr("scout.4f2a9c0d11223344.3"),
                                                   HasSubstr("its keys have expired"))));
  for (int i = 0; i < 20; ++i) {  // Cyclone tries every second
    Warn(expired_);
    EXPECT_THAT(After(seconds(1)), IsEmpty());
  }
}

TEST_F(StrangerWatchTest, AnotherStrangerBesideARefusedOneIsToldToo) {
  See("1:2:3", "first");
  See("4:5:6", "second");
  Warn(expired_);
  EXPECT_THAT(After(seconds(0)), ElementsAre(HasSubstr("expired")));
  EXPECT_THAT(After(seconds(10)), ElementsAre(HasSubstr("second")));
}

TEST_F(StrangerWatchTest, ARefusalThatIsHeardBeforeItsParticipantIsSeenIsNoSecondStranger) {
  Warn(expired_);
  EXPECT_THAT(After(seconds(1)), ElementsAre(HasSubstr("expired")));
  See("1:2:3", "participant 1:2:3");
  EXPECT_THAT(After(seconds(60)), IsEmpty());
}

TEST_F(StrangerWatchTest, WhoIsNotRefusedDoesNotHideBehindWhoIs) {
  See("1:2:3", "participant 1:2:3");
  now_ += seconds(3);
  See("4:5:6", "participant 4:5:6");
  Warn(expired_);
  EXPECT_THAT(After(seconds(60)),
              UnorderedElementsAre(HasSubstr("expired"), HasSubstr("participant 1:2:3")));
}

TEST_F(StrangerWatchTest, AForeignCertificateIsToldByItsWholeSubject) {
  Warn(
      "1.2 [0] fsm: Begin handshake reply failed: Certificate not valid: error: unable to get "
      "local issuer certificate; subject: /O=Others/CN=x(code: 200)");
  EXPECT_THAT(After(seconds(0)), ElementsAre(AllOf(HasSubstr("kept out: O=Others/CN=x: "),
                                                   HasSubstr("of another authority"))));
  Warn(
      "1.2 [0] fsm: Process handshake failed: Certificate not valid: error: certificate signature "
      "failure; subject: /CN=operator.b045f6e4cb9f7812.1(code: 200)");  // one of the same name
  EXPECT_THAT(After(seconds(0)), ElementsAre(HasSubstr("of another authority")));
}

TEST_F(StrangerWatchTest, OneThatComesBackMuchLaterIsToldAgain) {
  Warn(expired_);
  EXPECT_EQ(After(seconds(0)).size(), 1U);
  now_ += StrangerWatch::kAgain;
  Warn(expired_);
  EXPECT_EQ(After(seconds(0)).size(), 1U);
}

TEST_F(StrangerWatchTest, AMemberThatOpensMoreThanItMayIsToldWithWhatAndWhy) {
  See("8e64365e:681b1b61:c85b3f97", "participant 8e64365e:681b1b61:c85b3f97, at 10.0.0.7");
  Warn(
      "1.2 [0] dq.builtin: Access control does not allow remote writer "
      "8e64365e:681b1b61:c85b3f97:a02: trailcast/routes denied by default rule(code: 142)");
  EXPECT_THAT(After(seconds(0)), ElementsAre(AllOf(HasSubstr("at 10.0.0.7"),
                                                   HasSubstr("may not write trailcast/routes"),
                                                   HasSubstr("its role does not allow it"))));
  EXPECT_THAT(After(seconds(30)), IsEmpty());
}

TEST_F(StrangerWatchTest, WhatCycloneSaysOfEveryoneWhoArrivesIsNotTold) {
  Warn("1.2 [0] dq.builtin: Remote secure participant b4bcbdad:8cb9ff66:c107888e:1c1 not allowed");
  Warn(
      "1.2 [0] dq.builtin: Non secure remote writer 110ac28:182205b8:7e76407c:3c2 is not allowed.");
  EXPECT_THAT(After(seconds(1)), IsEmpty());
  EXPECT_FALSE(watch_.HandleWarning("using network interface eth0", now_));
}

}  // namespace
}  // namespace trailcast::dds
