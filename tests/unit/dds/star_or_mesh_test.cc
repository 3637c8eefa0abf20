#include "services/dds/src/domain/star_or_mesh.h"

#include <gtest/gtest.h>

namespace trailcast::dds {
namespace {

using exchange::AgentGone;
using exchange::AgentMode;
using exchange::AgentRole;
using exchange::AgentStatus;
using std::chrono::milliseconds;
using std::chrono::seconds;
using Step = StarOrMesh::Step;

constexpr StarOrMesh::Seen kNobody{};
constexpr StarOrMesh::Seen kServer{.server = true, .anybody = true};
constexpr StarOrMesh::Seen kSomebody{.server = false, .anybody = true};

AgentStatus FromServer(AgentMode mode = AgentMode::kWaiting) {
  return {.agent = AgentId("server"), .instance = 7, .role = AgentRole::kServer, .mode = mode};
}

class StarOrMeshTest : public testing::Test {
 protected:
  void Begin(Discovery wanted, double share = 0.0) {
    way_.emplace(wanted, share);
    way_->Begin(now_);
  }
  // The first step other than kNone within `time`, asked every second; kJoinAnew is carried out.
  Step After(seconds time, const StarOrMesh::Seen& seen) {
    for (const auto until = now_ + time; now_ < until;) {
      now_ += seconds(1);
      const Step step = way_->Look(seen, now_);
      if (step == Step::kJoinAnew) way_->Begin(now_);
      if (step != Step::kNone) return step;
    }
    return Step::kNone;
  }
  // Whether it joins anew within `time`, calls or not.
  bool JoinsAnew(seconds time, const StarOrMesh::Seen& seen) {
    for (const auto until = now_ + time; now_ < until;) {
      if (After(seconds(1), seen) == Step::kJoinAnew) return true;
    }
    return false;
  }

  StarOrMesh::Time now_ = StarOrMesh::Time() + seconds(1000);
  std::optional<StarOrMesh> way_;
};

TEST_F(StarOrMeshTest, AMeshStaysOne) {
  Begin(Discovery::kMesh);
  EXPECT_FALSE(way_->star());
  way_->Hear(FromServer());
  EXPECT_EQ(After(seconds(60), kServer), Step::kNone);
  EXPECT_FALSE(way_->star());
}

TEST_F(StarOrMeshTest, AStarWithoutAServerCallsEverMoreRarely) {
  Begin(Discovery::kStar);
  int calls = 0;
  for (int i = 0; i < 60; ++i) calls += After(seconds(1), kNobody) == Step::kCall ? 1 : 0;
  EXPECT_TRUE(way_->star());
  EXPECT_GE(calls, 8);
  EXPECT_LE(calls, 11);
}

TEST_F(StarOrMeshTest, AStarWithAServerHasNothingToDo) {
  Begin(Discovery::kAuto);
  EXPECT_EQ(After(seconds(1), kServer), Step::kNone);
  way_->Hear(FromServer());
  EXPECT_EQ(After(seconds(60), kServer), Step::kNone);
  EXPECT_TRUE(way_->star());
}

TEST_F(StarOrMeshTest, WhereNobodyIsThereIsAMeshSoon) {
  Begin(Discovery::kAuto);
  EXPECT_FALSE(JoinsAnew(StarOrMesh::kLooks - seconds(1), kNobody));
  EXPECT_TRUE(JoinsAnew(seconds(1), kNobody));
  EXPECT_FALSE(way_->star());
}

TEST_F(StarOrMeshTest, WhereSomebodyAnsweredTheServerGetsLonger) {
  Begin(Discovery::kAuto);
  EXPECT_FALSE(JoinsAnew(StarOrMesh::kLooksLonger - seconds(1), kSomebody));
  EXPECT_TRUE(JoinsAnew(seconds(1), kSomebody));
}

TEST_F(StarOrMeshTest, AServerThatGoesLeavesTheStarAndIsCalled) {
  Begin(Discovery::kAuto);
  ASSERT_EQ(After(seconds(1), kServer), Step::kNone);
  way_->Hear(FromServer());
  ASSERT_EQ(After(seconds(10), kServer), Step::kNone);
  way_->Hear(AgentGone{AgentId("server"), 7});
  // The endpoint that it wrote with is connected until its lease is over.
  EXPECT_EQ(After(seconds(2), kServer), Step::kCall);
  EXPECT_FALSE(JoinsAnew(seconds(60), kNobody));
  EXPECT_TRUE(way_->star());
}

TEST_F(StarOrMeshTest, AServerThatIsStoppedIsOne) {
  Begin(Discovery::kStar);
  way_->Hear(FromServer());
  ASSERT_EQ(After(seconds(1), kServer), Step::kNone);
  way_->Hear(FromServer(AgentMode::kStopped));
  EXPECT_EQ(After(seconds(2), kSomebody), Step::kCall);
}

TEST_F(StarOrMeshTest, AMeshReturnsToTheServerWhenItsTurnComes) {
  for (const double share : {0.0, 1.0}) {
    Begin(Discovery::kAuto, share);
    ASSERT_TRUE(JoinsAnew(StarOrMesh::kLooks, kNobody));
    EXPECT_EQ(After(seconds(10), kSomebody), Step::kNone);
    way_->Hear(FromServer());
    const auto heard = now_;
    ASSERT_TRUE(JoinsAnew(seconds(10), kSomebody));
    EXPECT_TRUE(way_->star());
    const auto after = now_ - heard - seconds(1);  // it is asked every second
    EXPECT_EQ(after, share == 0.0 ? StarOrMesh::kReturnsFrom : StarOrMesh::kReturnsUntil);
  }
}

TEST_F(StarOrMeshTest, AServerThatComesAndGoesLeavesTheMesh) {
  Begin(Discovery::kAuto, 1.0);
  ASSERT_TRUE(JoinsAnew(StarOrMesh::kLooks, kNobody));
  way_->Hear(FromServer());
  EXPECT_FALSE(JoinsAnew(seconds(2), kSomebody));
  way_->Hear(AgentGone{AgentId("server"), 7});
  EXPECT_FALSE(JoinsAnew(seconds(30), kSomebody));
  EXPECT_FALSE(way_->star());
}

}  // namespace
}  // namespace trailcast::dds
