#include "agent/duty/src/view_question.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/exchange/bounds.h"
#include "tests/support/pieces.h"

namespace trailcast::agent {
namespace {

using test::KeyNumber;
using testing::ElementsAre;
using testing::IsEmpty;

class ViewQuestionTest : public testing::Test {
 protected:
  void Show(unsigned route, const std::string& name, std::uint64_t teaching = 1,
            route::Standing standing = route::Standing::kActive) {
    reply_.places.push_back({KeyNumber(route, teaching), SegmentIndex(2), 0.5});
    route::RouteInfo info;
    info.key = KeyNumber(route, teaching);
    info.name = name;
    info.standing = standing;
    reply_.page.routes.push_back(info);
  }

  ViewQuestion question_{AgentId("robot1"), 7, route::View(20)};
  exchange::CatalogReply reply_{
      .server = AgentId("server"), .client = AgentId("robot1"), .request = 7};
};

TEST_F(ViewQuestionTest, AsksForWhatLooksLikeTheView) {
  EXPECT_TRUE(exchange::CheckBounds(question_.request()));
  EXPECT_EQ(question_.request().client, AgentId("robot1"));
  EXPECT_EQ(question_.request().query.view.size(), 20U);
  EXPECT_FALSE(question_.answered());
  EXPECT_THAT(question_.routes(), IsEmpty());
}

TEST_F(ViewQuestionTest, IsToldTheRoutesThatRobotsFollowOnceAndTheLikestFirst) {
  Show(1, "hall");
  Show(2, "old", 1, route::Standing::kRetired);
  Show(1, "hall");
  for (const char* name : {"office", "dock", "yard"}) Show(3, name, reply_.places.size());
  question_.Hear(reply_);
  EXPECT_THAT(question_.routes(), ElementsAre("hall", "office", "dock"));
}

TEST_F(ViewQuestionTest, ThatNothingLooksLikeItIsAnAnswer) {
  question_.Hear(reply_);
  EXPECT_TRUE(question_.answered());
  EXPECT_THAT(question_.routes(), IsEmpty());
  Show(1, "hall");
  question_.Hear(reply_);
  EXPECT_THAT(question_.routes(), IsEmpty()) << "of another server, later";
}

TEST_F(ViewQuestionTest, HearsNothingElse) {
  Show(1, "hall");
  for (const char* wrong : {"client", "request", "error"}) {
    exchange::CatalogReply other = reply_;
    if (wrong == std::string("client")) other.client = AgentId("robot2");
    if (wrong == std::string("request")) other.request = 6;
    if (wrong == std::string("error")) other.error = "busy";
    question_.Hear(other);
    EXPECT_FALSE(question_.answered()) << wrong;
  }
  question_.Hear(exchange::AgentStatus{});
  EXPECT_FALSE(question_.answered());
}

}  // namespace
}  // namespace trailcast::agent
