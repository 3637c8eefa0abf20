#include "services/webhooks/courier.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>

#include "tests/support/await.h"
#include "tests/support/temp_dir.h"

namespace trailcast::webhooks {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;

// These are hooks whose answers the test decides.
class CourierTest : public testing::Test {
 protected:
  std::unique_ptr<Courier> Open() {
    auto courier = Courier::Open(hooks_, file_,
                                 {.unix_ms = [this] { return now_ms_.load(); },
                                  .post = [this](const Hook& hook, const auto& headers,
                                                 const std::string& body) -> Result<int> {
                                    const std::scoped_lock lock(mutex_);
                                    posted_.push_back({hook.url, body, headers});
                                    if (answer_ == 0)
                                      return Fail(ErrorCode::kUnavailable, "no answer");
                                    return answer_;
                                  },
                                  .tell =
                                      [this](const std::string& line) {
                                        const std::scoped_lock lock(mutex_);
                                        told_.push_back(line);
                                      }});
    EXPECT_TRUE(courier) << courier.error().message;
    return courier ? *std::move(courier) : nullptr;
  }
  static Json Missions(const std::string& state) {
    return {{{"robot", "robot1"}, {"mission", "m"}, {"state", state}, {"changed_unix_ms", 2000}}};
  }
  std::size_t posted() {
    const std::scoped_lock lock(mutex_);
    return posted_.size();
  }
  void Answer(int status) {
    const std::scoped_lock lock(mutex_);
    answer_ = status;
  }

  struct Posted {
    std::string url;
    std::string body;
    std::multimap<std::string, std::string> headers;
  };
  test::TempDir folder_;
  const std::filesystem::path file_ = folder_ / "hooks.waiting";
  const std::vector<Hook> hooks_ = ParseHooks(R"([{"url": "http://a/x", "secret": "s"}])").value();
  std::atomic<std::int64_t> now_ms_{1000};
  std::mutex mutex_;
  int answer_ = 200;
  std::vector<Posted> posted_;
  std::vector<std::string> told_;
};

TEST_F(CourierTest, AHookIsToldWithAHeaderOfEachKind) {
  const auto courier = Open();
  courier->Look(Json::array(), Json::array());
  courier->Look(Json::array(), Missions("failed"));
  ASSERT_TRUE(test::Await([&] { return posted() == 1; }, "the hook"));
  const std::scoped_lock lock(mutex_);
  const Posted& first = posted_.front();
  EXPECT_EQ(Json::parse(first.body)["event"], "mission.failed");
  EXPECT_EQ(first.headers.find("Trailcast-Event")->second, "mission.failed");
  EXPECT_EQ(first.headers.find("Trailcast-Delivery")->second,
            Json::parse(first.body)["id"].get<std::string>());
  EXPECT_EQ(first.headers.find("Trailcast-Signature")->second, SignatureOf("s", 1, first.body));
}

TEST_F(CourierTest, WhatDidNotArriveIsToldByTheNextOneAfterARestart) {
  Answer(503);
  {
    const auto courier = Open();
    courier->Look(Json::array(), Missions("failed"));
    ASSERT_TRUE(test::Await([&] { return posted() == 1; }, "the first try"));
  }
  ASSERT_EQ(told_.size(), 1U);
  EXPECT_THAT(told_[0], testing::AllOf(HasSubstr("http://a/x"), HasSubstr("it answers 503"),
                                       HasSubstr("tried again")));
  now_ms_ += Outbox::kFirstWait_ms;
  Answer(204);
  {
    const auto courier = Open();
    ASSERT_TRUE(test::Await([&] { return posted() == 2; }, "the second try"));
  }
  EXPECT_EQ(posted_[1].body, posted_[0].body);
  {
    const auto courier = Open();
    courier->Look(Json::array(), Missions("failed"));
  }
  EXPECT_EQ(posted(), 2U) << "it has arrived, and is no news";
}

TEST_F(CourierTest, ThatEventsAreDroppedIsToldOnceUntilItsHookAnswers) {
  const auto courier = Open();
  const auto measured = [&] {
    http::MetricsText text;
    courier->Measure(text);
    return text.text();
  };
  const auto told_of_drops = [&] {
    const std::scoped_lock lock(mutex_);
    return std::count_if(told_.begin(), told_.end(), [](const std::string& line) {
      return line ==
             "200 events wait for hook http://a/x, and no more are kept: it is never told "
             "of the oldest ones, from now on until it answers";
    });
  };
  // Each look shows as many missions that have failed since the one before.
  const auto fail = [&](std::size_t many) {
    Json missions = Json::array();
    const std::int64_t at_ms = now_ms_ += Outbox::kLongestWait_ms;
    for (std::size_t i = 0; i < many; ++i) {
      missions.push_back({{"robot", fmt::format("robot{}", i)},
                          {"mission", fmt::format("m{}", at_ms)},
                          {"state", "failed"},
                          {"changed_unix_ms", at_ms + 1}});
    }
    courier->Look(Json::array(), missions);
  };
  courier->Look(Json::array(), Json::array());
  Answer(503);
  fail(Outbox::kMostWaiting + 3);
  ASSERT_TRUE(test::Await([&] { return told_of_drops() == 1; }, "that some are dropped"));
  ASSERT_TRUE(test::Await(
      [&] { return measured().find("webhook_events_dropped_total 3\n") != std::string::npos; },
      "the metric"));
  EXPECT_THAT(measured(), HasSubstr("trailcast_webhook_events_waiting 200\n"));
  fail(2);
  ASSERT_TRUE(test::Await(
      [&] { return measured().find("webhook_events_dropped_total 5\n") != std::string::npos; },
      "two more"));
  EXPECT_EQ(told_of_drops(), 1);
  Answer(200);
  now_ms_ += Outbox::kLongestWait_ms;
  courier->Look(Json::array(), Json::array());
  ASSERT_TRUE(test::Await(
      [&] { return measured().find("webhook_events_waiting 0\n") != std::string::npos; },
      "all of them"));
  Answer(503);
  fail(Outbox::kMostWaiting + 1);
  EXPECT_TRUE(test::Await([&] { return told_of_drops() == 2; }, "it begins again"));
}

TEST_F(CourierTest, AFileOfSomethingElseIsLeftAlone) {
  std::ofstream(file_) << "my notes\n";
  const auto courier = Courier::Open(hooks_, file_, Courier::Parts{});
  ASSERT_FALSE(courier);
  EXPECT_THAT(courier.error().message,
              testing::AllOf(HasSubstr("hooks.waiting"), HasSubstr("move the file away")));
  std::string line;
  std::getline(std::ifstream(file_), line);
  EXPECT_EQ(line, "my notes");
}

}  // namespace
}  // namespace trailcast::webhooks
