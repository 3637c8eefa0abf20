#include "services/catalog/editing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/memory_store.h"

namespace trailcast::catalog {
namespace {

using route::EditAction;
using route::RouteEdit;
using route::RouteState;
using route::Standing;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Editing : public testing::Test {
 protected:
  void Teach(unsigned number, std::uint32_t revision, const std::string& name,
             RouteState state = RouteState::kComplete) {
    const route::RouteKey key = test::KeyNumber(number, revision);
    route::RouteInfo info = test::InfoOf(key, test::PiecesOf(key, 1), state);
    info.name = name;
    ASSERT_TRUE(store_.PutRoute(info));
  }
  // Carries the edit out, as a server does; its error, or an empty text.
  std::string Edit(const RouteEdit& edit) {
    const auto changed = PlanEdit(edit, store_);
    if (!changed) return changed.error().message;
    EXPECT_TRUE(store_.PutRoutes(*changed));
    return "";
  }
  std::vector<Standing> Standings(unsigned number = 1) {
    std::vector<Standing> standings;
    const auto revisions = store_.FindRevisions(test::KeyNumber(number).route).value();
    for (const route::RouteInfo& info : revisions) standings.push_back(info.standing);
    return standings;
  }

  test::MemoryStore store_;
};

TEST_F(Editing, OneRevisionIsActiveAndTheWayBackIsTheOneBefore) {
  for (const std::uint32_t revision : {1U, 2U, 3U}) Teach(1, revision, "yard");
  EXPECT_EQ(Edit({.action = EditAction::kActivate, .route = "yard"}), "");
  EXPECT_THAT(Standings(), ElementsAre(Standing::kStaged, Standing::kStaged, Standing::kActive));
  EXPECT_EQ(Edit({.action = EditAction::kRetire, .route = "yard", .revision = 2}), "");
  EXPECT_EQ(Edit({.action = EditAction::kRollBack, .route = "yard"}), "");
  EXPECT_THAT(Standings(), ElementsAre(Standing::kActive, Standing::kRetired, Standing::kStaged));
  EXPECT_THAT(Edit({.action = EditAction::kRollBack, .route = "yard"}),
              HasSubstr("no complete revision before 1"));
  EXPECT_EQ(Edit({.action = EditAction::kActivate, .route = "yard", .revision = 2}), "");
  EXPECT_THAT(Standings(), ElementsAre(Standing::kStaged, Standing::kActive, Standing::kStaged));
}

TEST_F(Editing, RetiredRevisionsAreTakenBackByNumber) {
  Teach(1, 1, "yard");
  EXPECT_EQ(Edit({.action = EditAction::kRetire, .route = "yard"}), "");
  EXPECT_THAT(Edit({.action = EditAction::kActivate, .route = "yard"}), HasSubstr("retired"));
  EXPECT_EQ(Edit({.action = EditAction::kActivate, .route = "yard", .revision = 1}), "");
  EXPECT_THAT(Standings(), ElementsAre(Standing::kActive));
}

TEST_F(Editing, WhatIsToBeReviewedIsActivatedByItsNumberAndIsReviewedThen) {
  Teach(1, 1, "yard");
  Teach(1, 2, "yard");
  const route::RouteKey key = test::KeyNumber(1, 2);
  route::RouteInfo info = store_.FindRoute(key).value().value();
  info.to_review = true;
  ++info.edition;
  ASSERT_TRUE(store_.PutRoute(info));
  EXPECT_EQ(Edit({.action = EditAction::kActivate, .route = "yard"}), "");
  EXPECT_THAT(Standings(), ElementsAre(Standing::kActive, Standing::kStaged));
  EXPECT_EQ(Edit({.action = EditAction::kDescribe, .route = "yard", .text = "seen"}), "");
  EXPECT_TRUE(store_.FindRoute(key).value()->to_review) << "nobody said that it is good";
  EXPECT_EQ(Edit({.action = EditAction::kActivate, .route = "yard", .revision = 2}), "");
  EXPECT_THAT(Standings(), ElementsAre(Standing::kStaged, Standing::kActive));
  EXPECT_FALSE(store_.FindRoute(key).value()->to_review);
}

TEST_F(Editing, WhatIsStillTaughtCannotBeActivated) {
  Teach(1, 1, "yard", RouteState::kTeaching);
  EXPECT_THAT(Edit({.action = EditAction::kActivate, .route = "yard"}), HasSubstr("no complete"));
  EXPECT_THAT(Edit({.action = EditAction::kActivate, .route = "yard", .revision = 1}),
              HasSubstr("no complete revision 1"));
  EXPECT_THAT(Edit({.action = EditAction::kActivate, .route = "yard", .revision = 7}),
              HasSubstr("no revision 7: there is 1"));
}

TEST_F(Editing, OnlyWhatChangesIsReturnedAnEditionLater) {
  Teach(1, 1, "yard");
  Teach(1, 2, "yard");
  const RouteEdit tag{
      .action = EditAction::kTag, .route = "yard", .revision = 2, .tags = {"wet", "night"}};
  const auto changed = PlanEdit(tag, store_).value();
  ASSERT_EQ(changed.size(), 1U);
  EXPECT_THAT(changed[0].tags, ElementsAre("night", "wet"));
  EXPECT_EQ(changed[0].edition, 1U);
  ASSERT_TRUE(store_.PutRoutes(changed));
  EXPECT_THAT(PlanEdit(tag, store_).value(), IsEmpty());
  EXPECT_EQ(Edit({.action = EditAction::kUntag, .route = "yard", .tags = {"wet"}}), "");
  EXPECT_THAT(store_.FindRoute(test::KeyNumber(1, 2)).value()->tags, ElementsAre("night"));
}

TEST_F(Editing, NamesStayUnambiguous) {
  Teach(1, 1, "yard");
  Teach(1, 2, "yard");
  Teach(2, 1, "shed");
  Teach(3, 1, "shed");
  EXPECT_THAT(Edit({.action = EditAction::kRename, .route = "yard", .text = "shed"}),
              HasSubstr("another route 'shed'"));
  EXPECT_EQ(Edit({.action = EditAction::kRename, .route = "yard", .text = "court"}), "");
  EXPECT_EQ(store_.FindRoutesByName("court").value().size(), 2U);
  EXPECT_THAT(Edit({.action = EditAction::kRetire, .route = "yard"}), HasSubstr("no route 'yard'"));
  EXPECT_THAT(Edit({.action = EditAction::kRetire, .route = "shed"}),
              HasSubstr(test::KeyNumber(2).route.value()));
  EXPECT_THAT(Edit({.action = EditAction::kRetire, .route = "shed"}),
              HasSubstr("may be any of 2 routes"));
  const std::string id = test::KeyNumber(3).route.value();
  EXPECT_EQ(Edit({.action = EditAction::kRetire, .route = id}), "");
  EXPECT_THAT(Standings(3), ElementsAre(Standing::kRetired));
}

TEST_F(Editing, TheBeginningOfAnIdIsEnoughWhereItIsTheOnlyOne) {
  Teach(0xa3f9c21, 1, "yard");
  route::RouteInfo shed = store_.FindRoute(test::KeyNumber(0xa3f9c21)).value().value();
  shed.key.route = RouteId("a3f9c21" + std::string(25, '0'));
  shed.name = "shed";
  ASSERT_TRUE(store_.PutRoute(shed));
  EXPECT_EQ(Edit({.action = EditAction::kRetire, .route = "a3f9c21"}), "");
  EXPECT_EQ(store_.FindRoute(shed.key).value()->standing, Standing::kRetired);
  EXPECT_THAT(Standings(0xa3f9c21), ElementsAre(Standing::kStaged)) << "its id only ends so";
  shed.key.route = RouteId("a3f9c21" + std::string(25, '1'));
  ASSERT_TRUE(store_.PutRoute(shed));
  EXPECT_THAT(Edit({.action = EditAction::kActivate, .route = "a3f9c21"}),
              testing::AllOf(HasSubstr("a3f9c210@1 'shed'"), HasSubstr("a3f9c211@1 'shed'")));
  EXPECT_EQ(Edit({.action = EditAction::kActivate, .route = "a3f9c211"}), "");
}

TEST_F(Editing, DeletesARevisionOrAllButNotTheActiveOneAlone) {
  Teach(1, 1, "yard");
  Teach(1, 2, "yard");
  ASSERT_EQ(Edit({.action = EditAction::kActivate, .route = "yard"}), "");
  EXPECT_THAT(Edit({.action = EditAction::kDelete, .route = "yard", .revision = 2}),
              HasSubstr("activate another"));
  EXPECT_EQ(Edit({.action = EditAction::kDelete, .route = "yard", .revision = 1}), "");
  EXPECT_THAT(Standings(), ElementsAre(Standing::kActive));
  EXPECT_EQ(Edit({.action = EditAction::kDelete, .route = "yard"}), "");
  EXPECT_THAT(Standings(), IsEmpty());
}

TEST_F(Editing, SaysWhichFieldIsWrong) {
  Teach(1, 1, "yard");
  EXPECT_THAT(Edit({.action = EditAction::kRename, .route = "yard", .text = "the yard"}),
              HasSubstr("new name"));
  EXPECT_THAT(Edit({.action = EditAction::kDescribe, .route = "yard", .text = "two\nlines"}),
              HasSubstr("description"));
  EXPECT_THAT(Edit({.action = static_cast<EditAction>(8), .route = "yard"}), HasSubstr("action"));
  EXPECT_THAT(Edit({.action = EditAction::kTag, .route = "yard", .tags = {"a b"}}),
              HasSubstr("tag"));
}

}  // namespace
}  // namespace trailcast::catalog
