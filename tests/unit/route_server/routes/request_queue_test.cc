#include "route_server/routes/request_queue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::server {
namespace {

using exchange::CatalogRequest;
using exchange::RouteEditRequest;
using testing::ElementsAre;
using testing::HasSubstr;

CatalogRequest Query(const std::string& client, std::uint64_t request, const std::string& name) {
  return {AgentId(client), request, {.name = name}};
}

class RequestQueueTest : public testing::Test {
 protected:
  void Add(const exchange::Message& request) {
    const auto added = queue_.Add(request);
    EXPECT_TRUE(added) << added.error().message;
  }
  // Numbers of those that are served next.
  std::vector<std::uint64_t> Served(int count) {
    std::vector<std::uint64_t> numbers;
    for (int i = 0; i < count; ++i) {
      const auto next = queue_.Next();
      if (next) numbers.push_back(std::get<CatalogRequest>(*next).request);
    }
    return numbers;
  }
  RequestQueue queue_;
};

TEST_F(RequestQueueTest, ServesClientsInTurnAndEachInItsOrder) {
  for (const std::uint64_t number : {1, 2, 3}) Add(Query("a", number, fmt::format("r{}", number)));
  Add(Query("b", 11, "x"));
  Add(Query("c", 21, "x"));
  EXPECT_THAT(Served(3), ElementsAre(1, 11, 21));
  Add(Query("b", 12, "y"));
  EXPECT_THAT(Served(9), ElementsAre(2, 12, 3));
  EXPECT_TRUE(queue_.empty());
}

TEST_F(RequestQueueTest, TheSameAskedAgainTakesItsPlace) {
  Add(Query("a", 1, "hall"));
  Add(Query("a", 2, "yard"));
  Add(Query("a", 3, "hall"));
  EXPECT_EQ(queue_.size(), 2U);
  EXPECT_THAT(Served(2), ElementsAre(3, 2));
  const RouteEditRequest edit{AgentId("desk"), 5, {.route = "hall"}};
  Add(edit);
  Add(edit);
  EXPECT_EQ(queue_.size(), 1U);
  EXPECT_EQ(queue_.Next(), exchange::Message(edit));
  const exchange::NetworkEdit close{AgentId("desk"), 6, "close hall"};
  const exchange::NetworkRequest way{AgentId("desk"), 7, "way hall@2 office@8", 0};
  Add(close);
  Add(way);
  Add(close);
  EXPECT_EQ(queue_.size(), 2U);
  EXPECT_EQ(queue_.Next(), exchange::Message(close));
  EXPECT_EQ(queue_.Next(), exchange::Message(way));
}

TEST_F(RequestQueueTest, WhoAsksTooMuchIsToldSoAndOthersAreNot) {
  for (std::uint64_t i = 0; i < RequestQueue::kMostOfAMember; ++i) {
    Add(Query("a", i, fmt::format("r{}", i)));
  }
  const auto refused = queue_.Add(Query("a", 99, "one-more"));
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("16 requests of 'a' wait here already"));
  Add(Query("b", 1, "x"));
}

TEST_F(RequestQueueTest, TheProcessesOfAMemberAreOne) {
  Add(Query("desk-p1", 1, "hall"));
  Add(Query("desk-p2", 2, "hall"));
  EXPECT_EQ(queue_.size(), 2U) << "each waits for an answer of its own";
  Add(Query("lab", 3, "hall"));
  EXPECT_THAT(Served(3), ElementsAre(1, 3, 2)) << "in turn with others";
  for (std::uint64_t i = 0; i < RequestQueue::kMostOfAMember; ++i) {
    Add(Query(fmt::format("desk-p{}", i), i, "hall"));
  }
  EXPECT_FALSE(queue_.Add(Query("desk-p99", 1, "hall")));
  Add(Query("desk-pump", 1, "hall"));
}

TEST_F(RequestQueueTest, MissionsWaitTheirTurnAndAreTakenBeforeItTogether) {
  const auto mission = [](const std::string& client, const std::string& id) {
    return mission::Mission{.agent = AgentId("robot1"), .id = id, .client = AgentId(client)};
  };
  const exchange::MissionRequest history{.client = AgentId("desk-p2"), .request = 4};
  Add(mission("desk-p1", "m1"));
  Add(mission("desk-p1", "m1"));
  Add(history);
  Add(mission("desk-p1", "m2"));
  Add(mission("lab", "m3"));
  EXPECT_EQ(queue_.size(), 4U);
  EXPECT_EQ(queue_.Next(), exchange::Message(mission("desk-p1", "m1")));
  EXPECT_THAT(queue_.TakeMissions(), ElementsAre(mission("desk-p1", "m2"), mission("lab", "m3")));
  EXPECT_EQ(queue_.Next(), exchange::Message(history));
  EXPECT_TRUE(queue_.empty());
}

TEST_F(RequestQueueTest, IsBoundedWhateverNamesAreMadeUp) {
  std::size_t refused = 0;
  for (std::size_t i = 0; i < 2 * RequestQueue::kMost; ++i) {
    const auto added = queue_.Add(Query(fmt::format("made-up-{}", i), 1, "x"));
    if (!added) ++refused;
  }
  EXPECT_EQ(queue_.size(), RequestQueue::kMost);
  EXPECT_EQ(refused, RequestQueue::kMost);
}

}  // namespace
}  // namespace trailcast::server
