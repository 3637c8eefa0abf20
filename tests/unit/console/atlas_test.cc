#include "services/console/atlas.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "services/catalog/catalog.h"
#include "services/exchange/in_process_exchange.h"
#include "services/exchange/publish.h"
#include "services/exchange/route_keeper.h"
#include "services/fleet/routes/route_export.h"
#include "services/route/digest.h"
#include "services/store/route_store.h"
#include "tests/support/await.h"
#include "tests/support/taught_route.h"
#include "tests/support/temp_dir.h"

namespace trailcast::console {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using test::TaughtRoute;
using testing::HasSubstr;

// A server with a route, and the atlas of a console beside it.
class AtlasTest : public testing::Test {
 protected:
  void Serve() {
    server_ = std::jthread([this](const std::stop_token& stop) {
      const auto exchange = bus_.Open(exchange::ServerTopics());
      const auto answer = [this](const exchange::CatalogRequest& request) {
        return catalog::Answer(request, AgentId("barn"), *store_);
      };
      auto keeper = exchange::RouteKeeper::Open(AgentId("barn"), *store_, {.answer = answer},
                                                {route::CheckDigest, route::ManifestDigest});
      ASSERT_TRUE(keeper) << keeper.error().message;
      while (!stop.stop_requested()) {
        for (const exchange::Message& message : exchange->Take(milliseconds(5))) {
          (*keeper)->Handle(message, std::chrono::steady_clock::now());
        }
        // A message that is lost is asked for again.
        (void)exchange::PublishAll(*exchange, (*keeper)->Tick(std::chrono::steady_clock::now()));
      }
    });
  }
  TaughtRoute Hold(std::uint32_t segments) {
    TaughtRoute taught = test::TeachSamples(segments, 20);
    EXPECT_TRUE(store_->AppendSegments(taught.pieces));
    EXPECT_TRUE(store_->PutRoute(taught.info));
    return taught;
  }
  Result<fleet::OperatorPeer> Join() {
    ++joined_;
    return fleet::OperatorPeer{AgentId("desk-map"), bus_.Open(fleet::ExporterTopics())};
  }

  test::TempDir folder_;
  exchange::InProcessBus bus_;
  std::unique_ptr<store::RouteStore> store_ = store::OpenSqliteStore(folder_ / "barn.db").value();
  std::jthread server_;
  std::atomic<int> joined_ = 0;
  Atlas atlas_{[this] { return Join(); }};
};

TEST_F(AtlasTest, ARouteIsFetchedOnceAndDrawn) {
  const TaughtRoute hall = Hold(40);
  Serve();
  EXPECT_EQ(joined_, 0) << "nobody has asked";
  const auto found = atlas_.Find(hall.info.key.route, hall.info.key.teaching, test::kLongEnough);
  ASSERT_TRUE(found) << found.error().message;
  ASSERT_TRUE(found->shape);
  const json shape = json::parse(*found->shape);
  EXPECT_EQ(shape["route"], hall.info.key.route.value());
  EXPECT_EQ(shape["teaching"], "2");
  EXPECT_EQ(shape["segments"], 40);
  EXPECT_NEAR(shape["length"].get<double>(), hall.info.length_m, 0.01);
  const auto again = atlas_.Find(hall.info.key.route, hall.info.key.teaching, milliseconds(0));
  ASSERT_TRUE(again);
  EXPECT_EQ(again->shape, found->shape);
  const auto active = atlas_.Find(hall.info.key.route, std::nullopt, test::kLongEnough);
  ASSERT_TRUE(active) << active.error().message;
  EXPECT_EQ(active->shape, found->shape) << "of the same teaching";
  EXPECT_EQ(joined_, 1);
}

TEST_F(AtlasTest, WhatIsNotThereIsSaid) {
  const TaughtRoute hall = Hold(2);
  Serve();
  const auto unknown = atlas_.Find(RouteId(std::string(32, 'f')), std::nullopt, test::kLongEnough);
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::kNotFound);
  const auto other = atlas_.Find(hall.info.key.route, TeachingId(77), test::kLongEnough);
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().code, ErrorCode::kNotFound);
}

TEST_F(AtlasTest, OfARouteThatRobotsDoNotFollowItIsSaid) {
  TaughtRoute hall = Hold(2);
  hall.info.cut_off = true;
  store_ = store::OpenSqliteStore(folder_ / "other.db").value();
  ASSERT_TRUE(store_->AppendSegments(hall.pieces));
  ASSERT_TRUE(store_->PutRoute(hall.info));
  Serve();
  const auto active = atlas_.Find(hall.info.key.route, std::nullopt, test::kLongEnough);
  ASSERT_FALSE(active);
  EXPECT_EQ(active.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(active.error().message, HasSubstr("(cut off): its teaching was cut off"));
}

TEST_F(AtlasTest, WithoutAServerItSaysSoAndTriesAgainLater) {
  Atlas impatient([this] { return Join(); }, milliseconds(100));
  const auto found = impatient.Find(RouteId(std::string(32, 'a')), std::nullopt, test::kLongEnough);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kUnavailable);
}

TEST(Atlas, WhoDoesNotWaitIsToldHowFarItIsAndOnlySoManyAreAskedFor) {
  std::promise<void> network;
  Atlas atlas([joins = network.get_future().share()]() -> Result<fleet::OperatorPeer> {
    joins.wait();
    return Fail(ErrorCode::kUnavailable, "no network");
  });
  for (std::size_t i = 0; i < Atlas::kMostAsked; ++i) {
    const auto found = atlas.Find(RouteId(fmt::format("{:032x}", i)), {}, milliseconds(0));
    EXPECT_TRUE(found && !found->shape && found->fetched == 0.0) << i;
  }
  const auto more = atlas.Find(RouteId(std::string(32, 'f')), {}, milliseconds(0));
  network.set_value();
  ASSERT_FALSE(more);
  EXPECT_THAT(more.error().message, HasSubstr("too many routes"));
  const auto first = atlas.Find(RouteId(fmt::format("{:032x}", 0)), {}, test::kLongEnough);
  ASSERT_FALSE(first);
  EXPECT_EQ(first.error().message, "no network");
}

TEST(Atlas, WhatItsThreadThrowsIsTheAnswerAndItGoesOn) {
  int joins = 0;
  Atlas atlas([&]() -> Result<fleet::OperatorPeer> {
    if (++joins == 1) throw std::runtime_error("no room for so long a route");
    return Fail(ErrorCode::kUnavailable, "no network");
  });
  const auto first = atlas.Find(RouteId(std::string(32, 'a')), std::nullopt, test::kLongEnough);
  ASSERT_FALSE(first);
  EXPECT_EQ(first.error().code, ErrorCode::kInternal);
  EXPECT_THAT(first.error().message, HasSubstr("no room for so long a route"));
  const auto next = atlas.Find(RouteId(std::string(32, 'b')), std::nullopt, test::kLongEnough);
  ASSERT_FALSE(next);
  EXPECT_EQ(next.error().message, "no network");
}

TEST(Atlas, ClosedItLetsGoWhoWaits) {
  std::promise<void> network;
  Atlas atlas([joins = network.get_future().share()]() -> Result<fleet::OperatorPeer> {
    joins.wait();
    return Fail(ErrorCode::kUnavailable, "no network");
  });
  auto waits = std::async(std::launch::async, [&] {
    return atlas.Find(RouteId(std::string(32, 'a')), std::nullopt, std::chrono::hours(24));
  });
  atlas.Close();
  EXPECT_EQ(waits.wait_for(test::kLongEnough), std::future_status::ready);
  network.set_value();  // lets go whoever still waits
  const auto found = waits.get();
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_FALSE(found->shape);
}

}  // namespace
}  // namespace trailcast::console
