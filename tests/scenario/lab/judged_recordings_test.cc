// Recordings of real robots, taught and replayed as `./run recordings` does with all of them, a few
// here; skipped, visibly, where that data is absent. The bounds are what is reached today.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "services/lab/trial/judge/recording_batch.h"
#include "services/lab/trial/judge/recording_report.h"
#include "tests/support/places.h"

namespace trailcast::trial {
namespace {

namespace fs = std::filesystem;

class JudgedRecordingsTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::is_directory(data_)) GTEST_SKIP() << "no recordings at " << data_;
  }
  RecordingPair Pair(PairKind kind, const std::string& teach, const std::string& replay) const {
    RecordingPair pair;
    pair.kind = kind;
    pair.teach_name = teach;
    pair.replay_name = replay;
    pair.teach = {data_ / teach, {}, 20.0};
    pair.replay = {data_ / replay, {}, 20.0};
    return pair;
  }
  RecordingPair Donkey(const std::string& disturbance = "") const {
    RecordingPair pair = Pair(PairKind::kRight, "donkey_track/teach", "donkey_track/replay");
    pair.reference = data_ / "donkey_track/truth_replay.csv";
    pair.steering = data_ / "donkey_track/replay_steering.csv";
    pair.disturbance = disturbance;
    return pair;
  }
  static std::vector<RecordingRow> Run(const std::vector<RecordingPair>& pairs) {
    std::vector<RecordingRow> rows;
    for (const Result<RecordingOutcome>& outcome : RunRecordingTrials(pairs, {}, 2, {})) {
      EXPECT_TRUE(outcome) << outcome.error().message;
      if (!outcome) continue;
      rows.push_back(outcome->row);
      EXPECT_EQ(outcome->row.error, "");
    }
    EXPECT_EQ(rows.size(), pairs.size());
    return rows;
  }
  // Returns the shares of the verdict's counts.
  static RecordingShares Shares(const RecordingRow& row) { return SharesOf(row.verdict); }

  const fs::path data_ = fs::path(SourceDir()) / ".." / "shared" / "data";
};

TEST_F(JudgedRecordingsTest, WhatWasTaughtIsFollowedInEveryFrame) {
  const std::vector<RecordingRow> rows =
      Run({Pair(PairKind::kIdentity, "donkey_track/teach", "donkey_track/teach"),
           Pair(PairKind::kIdentity, "patio_laps/lap3", "patio_laps/lap3"),
           Pair(PairKind::kIdentity, "corridor_offset/ref", "corridor_offset/ref")});
  for (const RecordingRow& row : rows) {
    EXPECT_EQ(row.verdict.following, row.verdict.frames) << RecordingTable(rows);
    EXPECT_GE(Shares(row).right, 0.97) << RecordingTable(rows);
  }
}

TEST_F(JudgedRecordingsTest, TheSameWayIsFollowedAtItsPlaces) {
  const std::vector<RecordingRow> rows = Run({Donkey()});
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].verdict.aligned, 116);
  EXPECT_GE(Shares(rows[0]).right, 0.95) << RecordingTable(rows);
  EXPECT_LE(Shares(rows[0]).wrong, 0.04) << RecordingTable(rows);
  EXPECT_GE(Shares(rows[0]).steering, 0.85) << RecordingTable(rows);
}

TEST_F(JudgedRecordingsTest, UnderOtherLightItIsFollowedHalfTheWay) {
  RecordingPair patio = Pair(PairKind::kRight, "patio_laps/lap0", "patio_laps/lap1");
  patio.reference = data_ / "patio_laps/truth_lap1.csv";
  const std::vector<RecordingRow> rows = Run({patio});
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_GE(Shares(rows[0]).right, 0.6) << RecordingTable(rows);
  EXPECT_LE(Shares(rows[0]).wrong, 0.12) << RecordingTable(rows);
}

TEST_F(JudgedRecordingsTest, DisturbedItIsFollowedNearlyAsWell) {
  for (const RecordingRow& row : Run({Donkey("camera"), Donkey("every=3"), Donkey("slower=3"),
                                      Donkey("noise=12"), Donkey("jpeg=30"), Donkey("smear")})) {
    EXPECT_GE(Shares(row).right, 0.9) << row.disturbance;
    EXPECT_LE(Shares(row).wrong, 0.06) << row.disturbance;
  }
}

TEST_F(JudgedRecordingsTest, WhatAnotherLapRefreshedIsKnownToAnotherCameraAndToNoOtherPlace) {
  RecordingPair as_taught = Pair(PairKind::kRight, "patio_laps/lap0", "patio_laps/lap3");
  as_taught.reference = data_ / "patio_laps/truth_lap3.csv";
  as_taught.disturbance = "camera";
  RecordingPair refreshed = as_taught;
  refreshed.visits = {{data_ / "patio_laps/lap1", {}, 20.0}};
  RecordingPair elsewhere = Pair(PairKind::kWrong, "patio_laps/lap0", "donkey_track/replay");
  elsewhere.visits = refreshed.visits;
  RecordingPair by_another = Pair(PairKind::kRight, "patio_laps/lap0", "patio_laps/lap3");
  by_another.reference = as_taught.reference;
  by_another.visits = {{data_ / "donkey_track/replay", {}, 20.0}};
  const std::vector<RecordingRow> rows = Run({as_taught, refreshed, elsewhere, by_another});
  ASSERT_EQ(rows.size(), 4U);
  ASSERT_EQ(rows[1].visits.size(), 1U);
  EXPECT_THAT(rows[1].visits[0], testing::HasSubstr("views new, 0 gone"));
  EXPECT_GT(rows[1].verdict.following, rows[0].verdict.following) << RecordingTable(rows);
  EXPECT_GE(Shares(rows[1]).right, 0.97) << RecordingTable(rows);
  EXPECT_LE(Shares(rows[1]).wrong, 0.02) << RecordingTable(rows);
  EXPECT_EQ(rows[2].verdict.following, 0) << RecordingTable(rows);
  ASSERT_EQ(rows[3].visits.size(), 1U);
  EXPECT_THAT(rows[3].visits[0], testing::HasSubstr("it ends LOST")) << "who was elsewhere";
}

TEST_F(JudgedRecordingsTest, AnotherPlaceIsNotFollowed) {
  const std::vector<RecordingRow> rows =
      Run({Pair(PairKind::kWrong, "donkey_track/teach", "corridor_offset/ref")});
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].verdict.following, 0) << RecordingTable(rows);
  EXPECT_FALSE(rows[0].verdict.arrived);
}

}  // namespace
}  // namespace trailcast::trial
