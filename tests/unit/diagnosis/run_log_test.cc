#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <span>
#include <string>

#include "agent/diagnosis/run_log_reader.h"
#include "agent/diagnosis/src/protobuf_writer.h"
#include "agent/diagnosis/src/run_log_messages.h"
#include "services/bag/mcap_writer.h"
#include "tests/support/recorded/sample_run.h"
#include "tests/support/temp_dir.h"

namespace trailcast::agent {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

std::span<const std::uint8_t> BytesOf(const std::string& message) {
  return {reinterpret_cast<const std::uint8_t*>(message.data()), message.size()};
}

FrameRow RowNumber(int frame) {
  FrameRow row;
  row.frame = frame;
  return row;
}

// A log of messages as they are given, whatever they hold.
class Messages {
 public:
  Messages& Put(const char* topic, const std::string& message) {
    const bool header = std::string(topic) == kHeaderTopic;
    const auto channel = header ? header_ : std::string(topic) == kFrameTopic ? frame_ : event_;
    writer_.Put(channel, std::chrono::seconds(1), BytesOf(message));
    return *this;
  }
  Messages& Frames(int first, int count) {
    for (int i = first; i < first + count; ++i) Put(kFrameTopic, FrameMessage(RowNumber(i)));
    return *this;
  }
  [[nodiscard]] std::string Mcap() {
    writer_.End();
    const bag::Bytes bytes = writer_.TakeBytes();
    return {bytes.begin(), bytes.end()};
  }

 private:
  bag::McapWriter writer_{bag::Compression::kZstd, ""};
  bag::McapWriter::Id header_ = writer_.AddChannel(0, kHeaderTopic, "protobuf");
  bag::McapWriter::Id frame_ = writer_.AddChannel(0, kFrameTopic, "protobuf");
  bag::McapWriter::Id event_ = writer_.AddChannel(0, kEventTopic, "protobuf");
};

class RunLogTest : public testing::Test {
 protected:
  Result<RunLog> Read(const std::string& bytes, const ReadLimits& limits = {}) {
    std::ofstream(folder_ / "run.mcap", std::ios::binary) << bytes;
    return ReadRunLog(folder_ / "run.mcap", limits);
  }
  test::TempDir folder_;
};

TEST(RunLogMessages, WhatARobotDoesNotHaveStaysEmpty) {
  FrameRow row;
  row.turn_rad = std::numeric_limits<double>::quiet_NaN();
  row.left_sigma_m = std::numeric_limits<double>::infinity();
  row.left_m = 0.0;
  row.segment = -1;
  const auto read = ReadFrame(BytesOf(FrameMessage(row)));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->segment, -1);
  EXPECT_EQ(read->left_m, 0.0);
  EXPECT_FALSE(read->left_sigma_m);
  EXPECT_FALSE(read->driven_m);
  EXPECT_EQ(read->turn_rad, 0.0);
  EXPECT_EQ(read->magnification, 1.0);
}

TEST(RunLogMessages, AFrameTakesLessThanThreeHundredAndFiftyBytes) {
  FrameRow row;
  row.vision_turn_rad = row.odometry_turn_rad = row.delta = row.delta_minus = 0.1;
  row.left_m = row.left_sigma_m = row.heading_rad = row.along_m = row.mount_yaw_rad = 0.1;
  row.driven_m = row.x_m = row.y_m = row.true_off_m = 0.1;
  row.place = row.place_sigma = row.off_route = 0.1;
  EXPECT_LT(FrameMessage(row).size(), 350U);
}

TEST(RunLogMessages, EventsAndHeaderComeBack) {
  RunEvent event{7, 0.233, "hand-over", {}, "one line: with = and : in it\nand no second"};
  event.fields.Add("segment", "3");
  event.fields.Add("search", "near by");
  const auto read = ReadEvent(BytesOf(EventMessage(event)));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->frame, 7);
  EXPECT_EQ(read->t_s, 0.233);
  EXPECT_EQ(read->what, "hand-over");
  EXPECT_EQ(read->fields.all(), event.fields.all());
  EXPECT_EQ(read->text, "one line: with = and : in it and no second");
  EXPECT_EQ(DescribeEvent(*read),
            "hand-over segment=3 search=near_by : one line: with = and : in it and no second");

  Fields header;
  header.Add("scout_camera", "webcam 320x240");
  EXPECT_EQ(ReadHeader(BytesOf(HeaderMessage(header)))->all(), header.all());
}

TEST(RunLogMessages, WhatALaterWriterAddsIsPassedOver) {
  const std::string more = ProtobufWriter().Double(90, 1.0).Bytes(91, "cheerful").bytes();
  EXPECT_EQ(ReadFrame(BytesOf(FrameMessage(RowNumber(3)) + more))->frame, 3);
  EXPECT_EQ(ReadEvent(BytesOf(EventMessage({.frame = 3, .what = "phase"}) + more))->what, "phase");
  EXPECT_TRUE(ReadHeader(BytesOf(HeaderMessage({}) + more)));
}

TEST(RunLogMessages, StrangersBytesAreRefusedOrPlain) {
  const std::string whole = FrameMessage(RowNumber(3));
  EXPECT_FALSE(ReadFrame(BytesOf(whole.substr(0, whole.size() - 1))));
  EXPECT_FALSE(ReadFrame(BytesOf(ProtobufWriter().Number(6, 10).bytes()))) << "no such phase";
  EXPECT_FALSE(ReadEvent(BytesOf(ProtobufWriter().Bytes(4, "x").bytes()))) << "no pair";
  EXPECT_FALSE(ReadEvent(BytesOf(std::string(kLongestMessage + 1, '\0'))));
  ProtobufWriter many;
  for (std::size_t i = 0; i <= kMostFields; ++i) many.Bytes(1, "");
  EXPECT_FALSE(ReadHeader(BytesOf(many.bytes())));
  EXPECT_EQ(ReadEvent(BytesOf(ProtobufWriter().Bytes(5, "a\x1b[2J\xff").bytes()))->text, "a [2J ");
}

TEST_F(RunLogTest, CutOffAnywhereItIsReadAsFarAsItIsWhole) {
  test::SampleRun run;
  run.HandOver(0, 25).Frames(30).HandOver(1, 20).Frames(5).End("ARRIVED", "at the end");
  const std::string whole = run.Mcap();
  const std::string data = run.Mcap(false);
  constexpr std::size_t kMagic = 8;
  std::size_t last = 0;
  constexpr std::size_t kStep = 13;
  const std::size_t first = kMagic + (data.size() - kMagic) % kStep;
  for (std::size_t size = first; size <= data.size(); size += kStep) {
    const auto log = Read(whole.substr(0, size));
    ASSERT_TRUE(log) << size << log.error().message;
    const std::size_t read = log->frames.size() + log->events.size() + (log->ending ? 1 : 0);
    EXPECT_GE(read, last) << size;
    EXPECT_GE(log->damaged, 1U) << size;
    last = read;
    if (!log->frames.empty()) {
      EXPECT_EQ(log->header.Find("route"), "hall") << size;
    }
  }
  EXPECT_EQ(last, run.Log().frames.size() + run.Log().events.size() + 1);
  EXPECT_EQ(Read(whole)->damaged, 0U);
}

TEST_F(RunLogTest, DamagedMessagesAreNamedAndTheOthersKept) {
  const auto log = Read(Messages()
                            .Frames(0, 1)
                            .Put(kFrameTopic, "\xff")
                            .Put(kFrameTopic, std::string(kLongestMessage + 1, '\0'))
                            .Frames(5, 1)
                            .Put(kEventTopic, "x")
                            .Put(kEventTopic, EventMessage({.what = "found"}))
                            .Mcap());
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_EQ(log->frames.size(), 2U);
  EXPECT_EQ(log->events.size(), 1U);
  EXPECT_EQ(log->damaged, 3U);
  EXPECT_THAT(log->damage, ElementsAre("message 2 of /replay/frame: its bytes are no message",
                                       HasSubstr("message 3 of /replay/frame: longer than"),
                                       HasSubstr("message 1 of /replay/event")));
}

TEST_F(RunLogTest, FramesThatGoBackAreDamage) {
  const auto log = Read(Messages().Frames(0, 3).Frames(1, 1).Mcap());
  EXPECT_EQ(log->frames.size(), 3U);
  EXPECT_THAT(log->damage.at(0), HasSubstr("frame 1 after frame 2"));
}

TEST_F(RunLogTest, EndlessDamageIsCountedAndNotKept) {
  Messages messages;
  for (int i = 0; i < 1000; ++i) messages.Put(kFrameTopic, "?");
  const auto log = Read(messages.Mcap());
  EXPECT_EQ(log->damaged, 1000U);
  EXPECT_LT(log->damage.size(), 100U);
}

TEST_F(RunLogTest, NoMoreIsReadThanTheLimitsSay) {
  test::SampleRun run;
  run.HandOver(0, 20).HandOver(1, 20).HandOver(2, 20).Frames(50).End("ARRIVED", "there");
  const auto log = Read(run.Mcap(), {.messages = 40, .events = 2});
  ASSERT_TRUE(log);
  EXPECT_EQ(log->frames.size(), 40U);
  EXPECT_EQ(log->events.size(), 2U);
  EXPECT_TRUE(log->ending);
  EXPECT_THAT(log->damage,
              ElementsAre(HasSubstr("/replay/frame has more than is read"),
                          HasSubstr("message 3 of /replay/event: more events than are read")));
  const auto little = Read(run.Mcap(), {.bytes = 2000});
  EXPECT_LT(little->frames.size(), 20U);
  EXPECT_THAT(little->damage, Contains(HasSubstr("more than is read")));
}

TEST_F(RunLogTest, WhatUnpacksToFarTooMuchIsLeftOut) {
  Messages messages;
  const std::string large(std::size_t{1} << 20U, '\0');
  for (int i = 0; i < 100; ++i) messages.Put(kFrameTopic, large);
  const auto log = Read(messages.Mcap());
  ASSERT_TRUE(log);
  EXPECT_LT(log->damaged, 90U) << "of a hundred messages, the rest was not unpacked";
}

TEST_F(RunLogTest, ItsEndsAreReadByThemselves) {
  test::SampleRun run;
  run.HandOver(0, 20).Frames(3000).End("ARRIVED", "there");
  std::ofstream(folder_ / "run.mcap", std::ios::binary) << run.Mcap();
  const auto ends = ReadRunEnds(folder_ / "run.mcap");
  ASSERT_TRUE(ends) << ends.error().message;
  EXPECT_EQ(ends->header.Find("route"), "hall");
  EXPECT_EQ(ends->frames.front().frame, 0);
  EXPECT_EQ(ends->frames.back().frame, 3000);
  EXPECT_LT(ends->frames.size(), 100U) << "of a longer log";
  ASSERT_TRUE(ends->ending);
  EXPECT_EQ(ends->ending->text, "there");

  run = test::SampleRun();
  run.HandOver(0, 20).Frames(10);
  std::ofstream(folder_ / "short.mcap", std::ios::binary) << run.Mcap();
  const auto brief = ReadRunEnds(folder_ / "short.mcap");
  ASSERT_TRUE(brief);
  EXPECT_EQ(brief->frames.size(), 11U);
  EXPECT_EQ(brief->damaged, 0U);
  EXPECT_FALSE(brief->ending);
  std::ofstream(folder_ / "other.mcap") << "2026 something else";
  EXPECT_FALSE(ReadRunEnds(folder_ / "other.mcap"));
}

TEST_F(RunLogTest, OtherFilesAreRefused) {
  for (const std::string text : {"", "# trailcast replay log 1\n", "\x89PNG\r\n"}) {
    const auto log = Read(text);
    ASSERT_FALSE(log);
    EXPECT_EQ(log.error().code, ErrorCode::kCorrupt);
    EXPECT_THAT(log.error().message, HasSubstr("not a replay's log: it is no MCAP file"));
    EXPECT_THAT(log.error().message, HasSubstr("--log FILE.mcap"));
  }
  bag::McapWriter writer(bag::Compression::kNone, "");
  writer.Put(writer.AddChannel(0, "/chatter", "cdr"), std::chrono::seconds(0), {});
  writer.End();
  const bag::Bytes bytes = writer.TakeBytes();
  const auto log = Read({bytes.begin(), bytes.end()});
  ASSERT_FALSE(log);
  EXPECT_THAT(log.error().message, HasSubstr("it has no topic /replay/header"));
  EXPECT_EQ(ReadRunLog(folder_ / "none.mcap").error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace trailcast::agent
