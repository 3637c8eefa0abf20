#include "services/lab/trial/recording/reference.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/temp_dir.h"

namespace trailcast::trial {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

class ReferenceTest : public testing::Test {
 protected:
  std::filesystem::path Write(const std::string& text) {
    std::ofstream(folder_ / "in.csv") << text;
    return folder_ / "in.csv";
  }
  std::string Refusal(const std::string& text) {
    const auto read = ReadReference(Write(text));
    return read ? "none" : read.error().message;
  }
  const std::string header_ = "replay_frame,teach_frame,inliers,median_du_px,good\n";
  test::TempDir folder_;
};

TEST_F(ReferenceTest, WhatWasWrittenIsReadAgain) {
  const Reference written{{0, 3, 18, 52.59, true}, {4, 7, 0, -1.5, false}};
  ASSERT_TRUE(WriteReference(written, folder_ / "out.csv"));
  const auto read = ReadReference(folder_ / "out.csv");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->size(), 2U);
  EXPECT_EQ(read->front().teach_frame, 3);
  EXPECT_EQ(read->front().inliers, 18);
  EXPECT_DOUBLE_EQ(read->front().median_du_px, 52.59);
  EXPECT_TRUE(read->front().good);
  EXPECT_EQ(read->back().replay_frame, 4);
  EXPECT_FALSE(read->back().good);
}

TEST_F(ReferenceTest, SaysWhatIsWrongAndWhere) {
  EXPECT_THAT(Refusal("frame,steering\n"),
              HasSubstr("in.csv, line 1: expected a header with the columns replay_frame"));
  EXPECT_THAT(Refusal(header_ + "0,0,18,1.0,1\n4,far,18,1.0,1\n"),
              HasSubstr("line 3: expected a number under 'teach_frame'"));
  EXPECT_THAT(Refusal(header_ + "0,0,18\n"), HasSubstr("3 columns; expected the 5 of"));
  EXPECT_THAT(Refusal(header_ + "0,0.5,18,1.0,1\n"), HasSubstr("whole numbers"));
  EXPECT_THAT(Refusal(header_ + "0,1e300,18,1.0,1\n"), HasSubstr("whole numbers"));
  EXPECT_THAT(Refusal(header_ + "4,0,18,1.0,1\n4,0,18,1.0,1\n"),
              HasSubstr("frame 4 does not come after frame 4"));
  EXPECT_THAT(ReadReference(folder_ / "absent.csv").error().message, HasSubstr("absent.csv"));
}

TEST_F(ReferenceTest, CannotBeWrittenWhereThereIsNoFolder) {
  const auto written = WriteReference({}, folder_ / "absent" / "out.csv");
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message, HasSubstr("absent/out.csv"));
}

TEST_F(ReferenceTest, ARecordingOnItselfIsWhereItIs) {
  const Reference identity = IdentityReference(3);
  ASSERT_EQ(identity.size(), 3U);
  EXPECT_EQ(identity[2].replay_frame, 2);
  EXPECT_EQ(identity[2].teach_frame, 2);
  EXPECT_TRUE(identity[2].good);
}

TEST_F(ReferenceTest, SteeringIsReadByTheNamesOfItsColumns) {
  const auto steering =
      ReadSteering(Write("throttle,frame,steering\r\n0.5,0,-0.25\r\n0.5,2,0.75\r\n"));
  ASSERT_TRUE(steering) << steering.error().message;
  EXPECT_THAT(*steering, ElementsAre(Pair(0, -0.25), Pair(2, 0.75)));
}

}  // namespace
}  // namespace trailcast::trial
