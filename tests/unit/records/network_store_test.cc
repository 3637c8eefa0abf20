#include "services/records/network_store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "services/records/mission_store.h"
#include "tests/support/temp_dir.h"

namespace trailcast::store {
namespace {

using network::Condition;
using network::Junction;
using network::Lie;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class NetworkStoreTest : public testing::Test {
 protected:
  void SetUp() override { Reopen(); }
  void Reopen() {
    store_.reset();
    auto opened = NetworkStore::Open(file_);
    ASSERT_TRUE(opened) << opened.error().message;
    store_ = std::move(*opened);
  }
  void Put(const Junction& junction) { ASSERT_TRUE(store_->Put(junction, "desk", 1000)); }

  test::TempDir folder_;
  std::filesystem::path file_ = folder_ / "joints";
  std::unique_ptr<NetworkStore> store_;
};

TEST_F(NetworkStoreTest, JunctionsAreThereAfterARestartInTheirOrderOnceForTheSamePlaces) {
  const Junction first{{"a/1", 12.25}, {"b/7", 0.0}, true, Lie{0.1, -0.25, 0.5}};
  Junction second{{"b/7", 3.0}, {"a/1", 1.0}};
  Put(first);
  Put(second);
  Reopen();
  EXPECT_THAT(store_->Junctions().value(), ElementsAre(first, second));
  second.both = true;
  Put(second);
  EXPECT_THAT(store_->Junctions().value(), ElementsAre(first, second));
  ASSERT_TRUE(store_->Drop(first));
  ASSERT_TRUE(store_->Drop(first)) << "of what is not there, too";
  Reopen();
  EXPECT_THAT(store_->Junctions().value(), ElementsAre(second));
}

TEST_F(NetworkStoreTest, WhatRoutesShareIsKeptWithTheProposalWhateverIsSaidOfIt) {
  ProposedJunction found{.proposal = {{{"a/1", 12.25}, {"b/7", 0.0}, true}, 0.97}, .length_m = 7.5};
  ASSERT_TRUE(store_->Put({&found, 1}, "server", 1000));
  Reopen();
  EXPECT_THAT(store_->Proposals().value(), ElementsAre(found));
  found.verdict = ProposedJunction::Verdict::kTaken;
  ASSERT_TRUE(store_->Put({&found, 1}, "desk", 2000));
  Reopen();
  EXPECT_THAT(store_->Proposals().value(), ElementsAre(found));
  ASSERT_TRUE(store_->DropProposals("b/7"));
  found.length_m = 0.0;
  ASSERT_TRUE(store_->Put({&found, 1}, "server", 3000));
  EXPECT_THAT(store_->Proposals().value(), ElementsAre(found)) << "nothing of before is left";
}

TEST_F(NetworkStoreTest, ProposalsStayWhatTheyAreSaidToBeUntilTheirRevisionGoes) {
  using Verdict = ProposedJunction::Verdict;
  const Junction first{{"a/1", 12.25}, {"b/7", 0.0}, true, Lie{.turn_rad = 0.05}};
  const Junction second{{"b/7", 3.0}, {"c/1", 1.0}};
  ASSERT_TRUE(
      store_->Put(std::vector<ProposedJunction>{{{first, 0.97}}, {{second, 0.8}}}, "server", 1000));
  const std::vector<std::string> searched{"b/7", "b/7"};
  ASSERT_TRUE(store_->MarkSearched(searched));
  ASSERT_TRUE(store_->MarkSearched(searched));
  Reopen();
  EXPECT_THAT(store_->Proposals().value(),
              ElementsAre(ProposedJunction{{first, 0.97}}, ProposedJunction{{second, 0.8}}));
  EXPECT_THAT(store_->Searched().value(), ElementsAre("b/7"));
  EXPECT_THAT(store_->Junctions().value(), IsEmpty());
  const ProposedJunction taken{{first, 0.97}, Verdict::kTaken};
  const ProposedJunction refused{{second, 0.8}, Verdict::kRefused};
  ASSERT_TRUE(store_->Put(std::vector<ProposedJunction>{taken, refused}, "desk", 2000));
  Reopen();
  EXPECT_THAT(store_->Proposals().value(), ElementsAre(taken, refused));
  EXPECT_THAT(store_->Junctions().value(), ElementsAre(first));
  ASSERT_TRUE(store_->DropProposals("c/1"));
  EXPECT_THAT(store_->Proposals().value(), ElementsAre(taken));
  ASSERT_TRUE(store_->DropProposals("b/7"));
  EXPECT_THAT(store_->Proposals().value(), IsEmpty());
  EXPECT_THAT(store_->Searched().value(), IsEmpty());
  EXPECT_THAT(store_->Junctions().value(), ElementsAre(first)) << "an operator's word stays";
}

TEST_F(NetworkStoreTest, ConditionsOfARouteReplaceThoseOfBefore) {
  const Condition closed{.route = "a", .from_m = 3.0, .to_m = 7.5, .closed = true};
  const Condition slow{.route = "a", .to_m = 1e7, .speed = 0.5, .cost = 2.0};
  const Condition other{.route = "b", .to_m = 1.0, .closed = true};
  const Condition backed{.route = "a", .from_m = 1.0, .to_m = 4.0, .backed = true};
  ASSERT_TRUE(store_->Replace("a", {backed, closed, slow}, "desk", 1000));
  ASSERT_TRUE(store_->Replace("b", {other}, "desk", 1000));
  Reopen();
  EXPECT_THAT(store_->Conditions().value(), ElementsAre(closed, slow, other, backed));
  ASSERT_TRUE(store_->Replace("a", {slow}, "desk", 2000));
  EXPECT_THAT(store_->Conditions().value(), ElementsAre(other, slow));
  ASSERT_TRUE(store_->Replace("a", {}, "desk", 3000));
  ASSERT_TRUE(store_->Replace("b", {}, "desk", 3000));
  Reopen();
  EXPECT_THAT(store_->Conditions().value(), IsEmpty());
}

TEST_F(NetworkStoreTest, MoreConditionsThanThereMayBeAreRefusedAndThoseOfBeforeStay) {
  const Condition closed{.route = "a", .to_m = 1.0, .closed = true};
  ASSERT_TRUE(store_->Replace("a", {closed}, "desk", 1000));
  const auto kept = static_cast<std::size_t>(NetworkStore::kMostConditions);
  const auto refused = store_->Replace("a", std::vector<Condition>(kept + 1, closed), "desk", 1000);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(store_->Conditions().value(), ElementsAre(closed));
}

TEST_F(NetworkStoreTest, ANameIsThatOfOnePlace) {
  using network::NamedPlace;
  ASSERT_TRUE(store_->Put(NamedPlace{"dock", {"a/1", 2.5}}, "desk", 1000));
  ASSERT_TRUE(store_->Put(NamedPlace{"bay", {"b/7", 0.0}}, "desk", 1000));
  ASSERT_TRUE(store_->Put(NamedPlace{"dock", {"b/7", 3.0}}, "desk", 2000));
  Reopen();
  EXPECT_THAT(store_->Names().value(),
              ElementsAre(NamedPlace{"bay", {"b/7", 0.0}}, NamedPlace{"dock", {"b/7", 3.0}}));
  ASSERT_TRUE(store_->Put(NamedPlace{"bay", {"b/7", 0.0}, true}, "desk", 3000));
  Reopen();
  EXPECT_THAT(store_->Names().value(),
              ElementsAre(NamedPlace{"bay", {"b/7", 0.0}, true}, NamedPlace{"dock", {"b/7", 3.0}}));
  ASSERT_TRUE(store_->Put(NamedPlace{"bay", {"b/7", 0.0}}, "desk", 4000));
  EXPECT_FALSE(store_->Names().value().front().home) << "it is one no more";
  ASSERT_TRUE(store_->Forget("bay"));
  ASSERT_TRUE(store_->Forget("bay")) << "of what is not there, too";
  Reopen();
  EXPECT_THAT(store_->Names().value(), ElementsAre(NamedPlace{"dock", {"b/7", 3.0}}));
}

TEST_F(NetworkStoreTest, KeepsDocksWhoIsThereAndWhenRobotsCharge) {
  using network::NamedPlace;
  const NamedPlace dock{"dock1", {"a/1", 2.5}, false, true};
  ASSERT_TRUE(store_->Put(dock, "desk", 1000));
  ASSERT_TRUE(store_->HoldDock("dock1", {AgentId("robot1"), AgentId("robot2")}));
  EXPECT_FALSE(store_->Charge().value());
  ASSERT_TRUE(store_->Put(network::ChargeLimits{10, 80}));
  ASSERT_TRUE(store_->Put(network::ChargeLimits{20, 90}));
  ASSERT_TRUE(store_->Put(dock, "desk", 2000)) << "whoever is there stays";
  Reopen();
  EXPECT_THAT(store_->Names().value(), ElementsAre(dock));
  EXPECT_THAT(store_->DockHolders().value().at("dock1"),
              ElementsAre(AgentId("robot1"), AgentId("robot2")));
  EXPECT_EQ(store_->Charge().value(), (network::ChargeLimits{20, 90}));
  ASSERT_TRUE(store_->HoldDock("dock1", {AgentId("robot2")}));
  EXPECT_THAT(store_->DockHolders().value().at("dock1"), ElementsAre(AgentId("robot2")));
  ASSERT_TRUE(store_->Forget("dock1"));
  ASSERT_TRUE(store_->Put(std::optional<network::ChargeLimits>()));
  Reopen();
  EXPECT_THAT(store_->DockHolders().value(), testing::IsEmpty());
  EXPECT_FALSE(store_->Charge().value());
}

TEST_F(NetworkStoreTest, AnotherFileIsLeftAlone) {
  EXPECT_EQ(NetworkStore::Open(file_).error().code, ErrorCode::kConflict) << "it is open";
  ASSERT_TRUE(MissionStore::Open(folder_ / "missions"));
  const auto missions = NetworkStore::Open(folder_ / "missions");
  ASSERT_FALSE(missions);
  EXPECT_EQ(missions.error().code, ErrorCode::kCorrupt);
  EXPECT_THAT(missions.error().message, HasSubstr("holds no junctions"));
  std::ofstream(folder_ / "text") << "this is no database, but a file of somebody's";
  EXPECT_EQ(NetworkStore::Open(folder_ / "text").error().code, ErrorCode::kCorrupt);
}

TEST_F(NetworkStoreTest, HowSectionsWereFollowedIsThereAfterARestartAndTheOldestGoes) {
  const FollowedSection first{{RouteId("a"), TeachingId(1)}, 0, 3.5, 0.5, 2000};
  const FollowedSection other{{RouteId("a"), TeachingId(1)}, 1, 1.0, 1.0, 1000};
  ASSERT_TRUE(store_->Put(std::vector{first, other}));
  Reopen();
  EXPECT_THAT(store_->Followed().value(), ElementsAre(other, first));
  FollowedSection later = other;
  later.passed = 2.0;
  later.at_unix_ms = 3000;
  ASSERT_TRUE(store_->Put(std::vector{later}));
  EXPECT_THAT(store_->Followed().value(), ElementsAre(first, later));
  std::vector<FollowedSection> many;
  for (std::int64_t i = 1; i < NetworkStore::kMostFollowed; ++i) {
    many.push_back({{RouteId("b"), TeachingId(~0ULL >> 1U)}, i, 1.0, 0.0, 4000});
  }
  ASSERT_TRUE(store_->Put(many));
  const auto kept = store_->Followed().value();
  EXPECT_EQ(kept.size(), static_cast<std::size_t>(NetworkStore::kMostFollowed));
  EXPECT_EQ(kept.front(), later);
  EXPECT_EQ(kept.back(), many.back());
}

}  // namespace
}  // namespace trailcast::store
