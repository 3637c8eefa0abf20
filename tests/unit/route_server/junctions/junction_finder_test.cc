#include "route_server/junctions/junction_finder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <thread>

#include "services/route/codec.h"
#include "tests/support/await.h"
#include "tests/support/memory_store.h"
#include "tests/support/seen_segment.h"

namespace trailcast::server {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::steady_clock;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

// Segments of a metre, known by a number: those of one number look alike.
using Numbers = std::vector<unsigned>;

Numbers Range(unsigned from, unsigned to) {
  Numbers numbers;
  for (unsigned number = from; number < to; ++number) numbers.push_back(number);
  return numbers;
}

Numbers operator+(Numbers one, const Numbers& other) {
  one.insert(one.end(), other.begin(), other.end());
  return one;
}

route::RouteKey Key(unsigned number) { return test::KeyNumber(number); }

class JunctionFinderTest : public testing::Test {
 protected:
  JunctionFinderTest()
      : views_(store_),
        desk_(store_, views_, [this](const auto& key) { return was_searched_.contains(key); }) {}

  void AddSegment(const route::RouteKey& key, std::uint32_t index, unsigned number) {
    route::Segment segment = test::SegmentToSee(number, index);
    segment.has_odometry = true;
    segment.length_m = 1.0;
    segment.duration_s = 2.0;
    route::SegmentPiece piece{
        .key = key, .index = segment.index, .digest = {}, .bytes = route::Encode(segment)};
    piece.digest = test::ToyDigest(piece.bytes);
    ASSERT_TRUE(store_.AppendSegments({&piece, 1}));
  }
  route::RouteInfo Teach(unsigned id, const std::string& name, const Numbers& numbers,
                         route::Standing standing = route::Standing::kActive) {
    for (std::uint32_t i = 0; i < numbers.size(); ++i) AddSegment(Key(id), i, numbers[i]);
    route::RouteInfo info = test::InfoOf(Key(id), {}, route::RouteState::kComplete);
    info.name = name;
    info.standing = standing;
    info.segment_count = static_cast<std::uint32_t>(numbers.size());
    info.length_m = static_cast<double>(numbers.size());
    EXPECT_TRUE(store_.PutRoute(info));
    return info;
  }
  void FillViews() {
    while (!views_.Filled()) ASSERT_TRUE(views_.Fill(100));
  }
  void Turn() {
    (void)desk_.Turn(steady_clock::now() + hours(1));  // due, whenever that is
    for (const Meeting& meeting : desk_.TakeMeetings()) meetings_.push_back(meeting);
    for (const route::RouteKey& key : desk_.TakeSearched()) {
      searched_.push_back(key);
      was_searched_.insert(key);
    }
    for (const Crossing& crossing : desk_.TakeCrossings()) crossings_.push_back(crossing);
  }
  bool TurnUntil(const std::function<bool()>& done) {
    const auto until = steady_clock::now() + test::kLongEnough;
    while (!done() && steady_clock::now() < until) {
      Turn();
      std::this_thread::sleep_for(milliseconds(1));
    }
    return done();
  }
  bool SearchesFor(std::size_t routes) {
    return TurnUntil([&] { return searched_.size() >= routes; });
  }
  // Until another one is searched, too: all that waited before it is.
  bool SearchesAllBefore(unsigned id) {
    desk_.Note(Teach(id, "last", Range(9000, 9004)));
    return TurnUntil([&] { return !searched_.empty() && searched_.back() == Key(id); });
  }
  [[nodiscard]] const Meeting* Of(unsigned a, unsigned b) const {
    for (const Meeting& meeting : meetings_) {
      if (meeting.a == Key(a) && meeting.b == Key(b)) return &meeting;
    }
    return nullptr;
  }

  test::MemoryStore store_;
  catalog::ViewCatalog views_;
  std::set<route::RouteKey> was_searched_;
  JunctionFinder desk_;
  std::vector<Meeting> meetings_;
  std::vector<route::RouteKey> searched_;
  std::vector<Crossing> crossings_;
};

// The junction is a little further on than where they begin to run together.
TEST_F(JunctionFinderTest, FindsWhereRoutesOfTheStoreMeetOnceTheirViewsAreIndexed) {
  Teach(1, "hall", Range(0, 20));
  Teach(2, "office", Range(12, 20) + Range(50, 60));
  Teach(3, "attic", Range(100, 120));
  Turn();
  EXPECT_THAT(searched_, IsEmpty());
  FillViews();
  ASSERT_TRUE(SearchesFor(3));
  EXPECT_THAT(searched_, UnorderedElementsAre(Key(1), Key(2), Key(3)));
  ASSERT_TRUE(Of(1, 2));
  EXPECT_NEAR(Of(1, 2)->at_a_m, 15.0, 0.2);
  EXPECT_NEAR(Of(1, 2)->at_b_m, 3.0, 0.2);
  EXPECT_NEAR(Of(1, 2)->length_m, 8.0, 1.1);
  EXPECT_GT(Of(1, 2)->confidence, 0.9);
  ASSERT_TRUE(Of(2, 1)) << "as seen from the other";
  EXPECT_NEAR(Of(2, 1)->at_b_m, 15.0, 0.2);
  EXPECT_EQ(meetings_.size(), 2U);
  Turn();
  EXPECT_FALSE(desk_.due());
}

TEST_F(JunctionFinderTest, ANewRouteIsLookedForAmongThoseThatWereSearchedBefore) {
  Teach(1, "hall", Range(0, 20));
  was_searched_.insert(Key(1));
  FillViews();
  const auto office = Teach(2, "office", Range(15, 25));
  views_.Note(office.key);
  FillViews();
  desk_.Note(office);
  desk_.Note(office);
  ASSERT_TRUE(SearchesFor(1));
  EXPECT_NE(Of(2, 1), nullptr);
  ASSERT_TRUE(SearchesAllBefore(9));
  EXPECT_THAT(searched_, ElementsAre(Key(2), Key(9)));
}

TEST_F(JunctionFinderTest, ARouteThatComesBackMeetsItself) {
  Teach(1, "ring", Range(0, 8) + Range(30, 40) + Range(0, 5));
  FillViews();
  ASSERT_TRUE(SearchesFor(1));
  ASSERT_TRUE(Of(1, 1));
  EXPECT_NEAR(Of(1, 1)->at_a_m, 2.5, 0.2);
  EXPECT_NEAR(Of(1, 1)->at_b_m, 20.5, 0.2);
}

TEST_F(JunctionFinderTest, WhatRobotsDoNotFollowIsLeftOut) {
  Teach(1, "hall", Range(0, 20));
  Teach(2, "office", Range(12, 24), route::Standing::kStaged);
  FillViews();
  ASSERT_TRUE(SearchesFor(1));
  ASSERT_TRUE(SearchesAllBefore(9));
  EXPECT_THAT(searched_, ElementsAre(Key(1), Key(9)));
  EXPECT_THAT(meetings_, IsEmpty());
}

TEST_F(JunctionFinderTest, WhatIsDamagedKeepsNoOtherFromBeingSearched) {
  Teach(1, "hall", Range(0, 20));
  Teach(2, "office", Range(12, 24));
  Teach(3, "yard", Range(16, 30));
  FillViews();
  store_.damaged.insert({Key(2), SegmentIndex(0)});
  ASSERT_TRUE(SearchesFor(2));
  EXPECT_THAT(searched_, UnorderedElementsAre(Key(1), Key(3)));
  EXPECT_NE(Of(1, 3), nullptr);
  EXPECT_EQ(Of(1, 2), nullptr);
}

TEST_F(JunctionFinderTest, AScoutThatCrossesAKnownRouteIsToldSoonAndOnce) {
  Teach(1, "hall", Range(0, 40));
  was_searched_.insert(Key(1));
  FillViews();
  route::RouteInfo taught = test::InfoOf(Key(2), {}, route::RouteState::kTeaching);
  taught.segment_count = 1;
  ASSERT_TRUE(store_.PutRoute(taught));
  const Numbers way = Range(200, 204) + Range(5, 25);
  std::size_t told_after = 0;
  for (std::uint32_t i = 0; i < way.size(); ++i) {
    AddSegment(Key(2), i, way[i]);
    desk_.NoteStored(Key(2), SegmentIndex(i));
    // Whatever is to be found by now is found before the next one comes.
    ASSERT_TRUE(SearchesAllBefore(100 + i));
    if (told_after == 0 && !crossings_.empty()) told_after = i + 1;
  }
  ASSERT_EQ(crossings_.size(), 1U);
  EXPECT_EQ(crossings_[0].teaching.key, Key(2));
  EXPECT_EQ(crossings_[0].known, "hall");
  EXPECT_NEAR(crossings_[0].along_m, 5.0, 0.5);
  EXPECT_LE(told_after, 4U + 3U);
}

TEST_F(JunctionFinderTest, MoreThanItCanLookAtIsLeftOut) {
  Teach(1, "hall", Range(0, 20));
  FillViews();
  for (std::uint32_t i = 0; i < 100'000; ++i) desk_.NoteStored(Key(i % 1000), SegmentIndex(i));
  ASSERT_TRUE(SearchesFor(1));
  EXPECT_THAT(crossings_, IsEmpty());
}

}  // namespace
}  // namespace trailcast::server
