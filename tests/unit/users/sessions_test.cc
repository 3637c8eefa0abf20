#include "services/users/sessions.h"

#include <gtest/gtest.h>

namespace trailcast::users {
namespace {

using std::chrono::minutes;
using std::chrono::seconds;

class SessionsTest : public testing::Test {
 protected:
  std::string Open(const std::string& user) {
    return sessions_.Open({.user = user, .stamp = "hash"}, now_);
  }
  Sessions::Time now_ = Sessions::Time{} + std::chrono::hours(1000);
  Sessions sessions_{{.idle = minutes(30), .longest = minutes(100), .most = 6, .of_one_user = 3}};
};

TEST_F(SessionsTest, ATokenIsItsUsers) {
  const std::string anna = Open("anna");
  const std::string bob = Open("bob");
  EXPECT_EQ(sessions_.Use(anna, now_)->user, "anna");
  EXPECT_EQ(sessions_.Use(bob, now_)->user, "bob");
  EXPECT_FALSE(sessions_.Use("", now_));
  EXPECT_FALSE(sessions_.Use(std::string(64, '0'), now_));
  sessions_.Close(anna);
  EXPECT_FALSE(sessions_.Use(anna, now_));
  EXPECT_TRUE(sessions_.Use(bob, now_));
}

TEST_F(SessionsTest, EndsWhenNobodyIsThereAndAfterItsLongestTime) {
  const std::string idle = Open("anna");
  const std::string busy = Open("anna");
  for (int i = 0; i < 4; ++i) {
    EXPECT_TRUE(sessions_.Use(busy, now_)) << i;
    now_ += minutes(20);
  }
  EXPECT_FALSE(sessions_.Use(idle, now_));
  EXPECT_TRUE(sessions_.Use(busy, now_));
  now_ += minutes(20);
  EXPECT_FALSE(sessions_.Use(busy, now_)) << "100 minutes in all";
  EXPECT_EQ(sessions_.size(), 0U);
}

TEST_F(SessionsTest, TooManyMakeRoomForTheNewest) {
  const std::string bob = Open("bob");
  std::vector<std::string> annas;
  for (int i = 0; i < 5; ++i) {
    now_ += seconds(1);
    annas.push_back(Open("anna"));
  }
  EXPECT_EQ(sessions_.size(), 4U) << "nobody takes others' room";
  EXPECT_TRUE(sessions_.Use(bob, now_));
  EXPECT_FALSE(sessions_.Use(annas[1], now_));
  EXPECT_TRUE(sessions_.Use(annas[2], now_));
  for (const char* user : {"carl", "dora", "emil"}) {
    now_ += seconds(1);
    (void)Open(user);
  }
  EXPECT_EQ(sessions_.size(), 6U);
  EXPECT_FALSE(sessions_.Use(annas[3], now_)) << "that was not used for longest";
  EXPECT_TRUE(sessions_.Use(annas[2], now_));
}

}  // namespace
}  // namespace trailcast::users
