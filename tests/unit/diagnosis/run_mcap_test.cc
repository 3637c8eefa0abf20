// A replay's log, read as a viewer does: by the description that the file carries.
#include "agent/diagnosis/run_mcap.h"

#include <gmock/gmock.h>
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/dynamic_message.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <memory>

#include "agent/diagnosis/run_log_reader.h"
#include "agent/diagnosis/run_pictures.h"
#include "idl/run_log_description.h"
#include "services/bag/bag.h"
#include "services/image/files.h"
#include "tests/support/temp_dir.h"
#include "tests/support/walk_frames.h"

namespace trailcast::agent {
namespace {

namespace pb = google::protobuf;
using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr SensorTime kBegan = std::chrono::seconds(1'700'000'000);

RunMoment FrameAt(milliseconds at, int number) {
  FrameRow row;
  row.frame = number;
  row.phase = Phase::kSure;
  row.turn_rad = -0.25;
  row.left_m = 0.125;
  replay::FeatureView feature;
  feature.at = {.u_px = 10.0F, .v_px = -20.0F};
  feature.milestone = {.u_px = 30.0F, .v_px = -40.0F};
  feature.verdict = replay::FeatureVerdict::kAsksRight;
  RunEvent event{number, 0.0, "phase", {}, "words"};
  event.fields.Add("to", "unsure");
  return {.events = {event},
          .stamp = kBegan + at,
          .row = row,
          .odometry = motion::Pose2{0.1 * number, 0.0, 0.5},
          .picture = test::WalkFrame(number),
          .features = {feature}};
}

// Messages of a file, by the description in it.
class Viewer {
 public:
  explicit Viewer(const std::filesystem::path& file) {
    pb::FileDescriptorSet set;
    const auto description = RunLogDescription();
    EXPECT_TRUE(set.ParseFromArray(description.data(), static_cast<int>(description.size())));
    for (const auto& each : set.file()) EXPECT_TRUE(pool_.BuildFile(each)) << each.name();
    auto bag = bag::Bag::Open(file, [](const std::string&) {});
    EXPECT_TRUE(bag) << bag.error().message;
    bag_ = std::move(*bag);
  }
  // Reads messages as text.
  std::vector<std::string> Read(const std::string& name) {
    std::vector<std::string> texts;
    for (const bag::Topic& topic : bag_->topics()) {
      if (topic.name != name) continue;
      EXPECT_EQ(topic.encoding, "protobuf");
      const auto* type = pool_.FindMessageTypeByName(topic.type);
      EXPECT_NE(type, nullptr) << topic.type;
      bag_->Begin(topic);
      while (auto message = *bag_->Next()) {
        const std::unique_ptr<pb::Message> parsed(factory_.GetPrototype(type)->New());
        EXPECT_TRUE(
            parsed->ParseFromArray(message->bytes.data(), static_cast<int>(message->bytes.size())));
        EXPECT_TRUE(parsed->GetReflection()->GetUnknownFields(*parsed).empty()) << name;
        texts.push_back(parsed->ShortDebugString());
      }
    }
    return texts;
  }
  const pb::Descriptor* Find(const std::string& name) { return pool_.FindMessageTypeByName(name); }
  [[nodiscard]] std::size_t topics() const { return bag_->topics().size(); }

 private:
  pb::DescriptorPool pool_;
  pb::DynamicMessageFactory factory_{&pool_};
  std::unique_ptr<bag::Bag> bag_;
};

class RunMcapTest : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path File() const { return folder_ / "run.mcap"; }
  void Write(const bag::Bytes& bytes) {
    std::ofstream stream(File(), std::ios::binary | std::ios::app);
    stream.write(reinterpret_cast<const char*>(bytes.data()),
                 static_cast<std::streamsize>(bytes.size()));
  }
  test::TempDir folder_;
};

TEST_F(RunMcapTest, ViewersSeePicturesFeaturesPathAndStates) {
  RunMcap mcap;
  mcap.Add(FrameAt(milliseconds(0), 0));
  mcap.Add(FrameAt(milliseconds(100), 1));
  mcap.End();
  Write(mcap.TakeBytes());
  Viewer viewer(File());
  EXPECT_EQ(viewer.topics(), 8U);
  const std::string stamp = "timestamp { seconds: 1700000000 nanos: 100000000 }";
  ASSERT_EQ(viewer.Read("/camera/image").size(), 2U);
  EXPECT_THAT(viewer.Read("/camera/image")[1],
              testing::AllOf(HasSubstr(stamp), HasSubstr("format: \"jpeg\"")));
  // From the centre of 160x120 pixels to their corner.
  EXPECT_THAT(viewer.Read("/camera/features")[1],
              testing::AllOf(HasSubstr("circles { " + stamp + " position { x: 90 y: 40 }"),
                             HasSubstr("points { " + stamp +
                                       " type: LINE_LIST points { x: 90 y: 40 "
                                       "} points { x: 110 y: 20 }")));
  EXPECT_THAT(viewer.Read("/odometry/pose")[1],
              HasSubstr("frame_id: \"odom\" pose { position { x: 0.1 }"));
  EXPECT_THAT(viewer.Read("/odometry/path"), ElementsAre(HasSubstr("poses")));
  EXPECT_THAT(viewer.Read("/replay/states")[1],
              testing::AllOf(HasSubstr("level: WARNING"), HasSubstr("phase to=unsure : words")));
  EXPECT_THAT(
      viewer.Read("/replay/frame")[1],
      testing::AllOf(HasSubstr("frame: 1"), HasSubstr("phase: SURE"), HasSubstr("turn_rad: -0.25"),
                     HasSubstr("left_m: 0.125"), testing::Not(HasSubstr("delta"))));
}

TEST_F(RunMcapTest, ViewersFindEachValueUnderItsName) {
  FrameRow row;
  row.frame = 12345;
  row.t_s = 411.5;
  row.segment = 117;
  row.fraction = 0.125;
  row.progress = 0.875;
  row.phase = Phase::kCovered;
  row.stored = 29;
  row.tracked = 21;
  row.agreeing = 18;
  row.rejected = 3;
  row.rejected_by_px = 17.5;
  row.left_picture = 2;
  row.not_returned = 1;
  row.turn_rad = -0.5;
  row.vision_turn_rad = -0.25;
  row.odometry_turn_rad = 0.0625;
  row.delta = 0.75;
  row.delta_minus = 1.5;
  row.left_m = -0.75;
  row.left_sigma_m = 0.25;
  row.heading_rad = -1.25;
  row.along_m = 1.75;
  row.mount_yaw_rad = 2.25;
  row.magnification = 0.5;
  row.driven_m = 151.25;
  row.x_m = -103.5;
  row.y_m = 42.125;
  row.linear_mps = 0.375;
  row.angular_radps = -0.0625;
  row.cpu_ms = 12.25;
  row.true_off_m = 0.5625;
  row.place = 0.3125;
  row.place_sigma = 0.015625;
  row.off_route = 0.03125;
  row.odometry_trust = 0.875;
  row.odometry_scale = 1.125;
  row.evidence = Evidence::kViews;
  Fields header;
  header.Add("route", "hall");
  RunEvent event{7, 0.25, "hand-over", {}, "words"};
  event.fields.Add("segment", "3");
  event.fields.Add("search", "near");
  RunMcap mcap;
  mcap.Add({.header = header, .events = {event}, .stamp = kBegan, .row = row});
  mcap.End();
  Write(mcap.TakeBytes());
  Viewer viewer(File());
  EXPECT_THAT(
      viewer.Read("/replay/frame"),
      ElementsAre("frame: 12345 t_s: 411.5 segment: 117 fraction: 0.125 progress: 0.875 "
                  "phase: COVERED stored: 29 tracked: 21 agreeing: 18 rejected: 3 "
                  "rejected_by_px: 17.5 left_picture: 2 not_returned: 1 turn_rad: -0.5 "
                  "vision_turn_rad: -0.25 odometry_turn_rad: 0.0625 delta: 0.75 delta_minus: 1.5 "
                  "left_m: -0.75 left_sigma_m: 0.25 heading_rad: -1.25 along_m: 1.75 "
                  "mount_yaw_rad: 2.25 magnification: 0.5 driven_m: 151.25 x_m: -103.5 "
                  "y_m: 42.125 linear_mps: 0.375 angular_radps: -0.0625 cpu_ms: 12.25 "
                  "true_off_m: 0.5625 place: 0.3125 place_sigma: 0.015625 off_route: 0.03125 "
                  "odometry_trust: 0.875 odometry_scale: 1.125 evidence: VIEWS"));
  EXPECT_THAT(viewer.Read("/replay/header"),
              ElementsAre("fields { key: \"route\" value: \"hall\" }"));
  EXPECT_THAT(viewer.Read("/replay/event"),
              ElementsAre("frame: 7 t_s: 0.25 what: \"hand-over\" fields { key: \"segment\" value: "
                          "\"3\" } fields { key: \"search\" value: \"near\" } text: \"words\""));
  // And our own reader the same.
  const auto log = ReadRunLog(File());
  ASSERT_TRUE(log) << log.error().message;
  RunMcap again;
  again.Add(
      {.header = log->header, .events = log->events, .stamp = kBegan, .row = log->frames.at(0)});
  again.End();
  std::filesystem::remove(File());
  Write(again.TakeBytes());
  Viewer reread(File());
  for (const char* topic : {"/replay/frame", "/replay/header", "/replay/event"}) {
    EXPECT_EQ(reread.Read(topic), viewer.Read(topic));
  }
}

TEST_F(RunMcapTest, ViewersNameThePhasesAsWeDo) {
  RunMcap mcap;
  mcap.End();
  Write(mcap.TakeBytes());
  Viewer viewer(File());
  const auto* frame = viewer.Find("trailcast.log.Frame");
  ASSERT_NE(frame, nullptr);
  const auto* phases = frame->FindFieldByName("phase")->enum_type();
  for (int i = 0; i < phases->value_count(); ++i) {
    std::string name = phases->FindValueByNumber(i)->name();
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    EXPECT_EQ(name, ToString(static_cast<Phase>(i)));
  }
}

TEST_F(RunMcapTest, OfARunThatWasKilledAllButTheLastSecondIsThere) {
  RunMcap mcap;
  mcap.Add({.header = Fields()});
  for (int i = 0; i < 50; ++i) mcap.Add(FrameAt(milliseconds(100 * i), i));
  Write(mcap.TakeBytes());
  const auto log = ReadRunLog(File());
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_GE(log->frames.size(), 40U);
  EXPECT_FALSE(log->ending);
}

TEST_F(RunMcapTest, OfARunThatWasKilledEarlyThereIsWhatItWasAndItsFirstFrame) {
  Fields header;
  header.Add("route", "hall");
  RunMcap mcap;
  mcap.Add({.header = header});
  Write(mcap.TakeBytes());
  const auto nothing = ReadRunLog(File());
  ASSERT_TRUE(nothing) << nothing.error().message;
  EXPECT_TRUE(nothing->frames.empty());
  mcap.Add({.events = {{.what = "complete", .text = "all 3 segments are known"}}});
  mcap.Add(FrameAt(milliseconds(0), 0));
  Write(mcap.TakeBytes());
  const auto first = ReadRunLog(File());
  ASSERT_TRUE(first) << first.error().message;
  EXPECT_EQ(first->header.Find("route"), "hall");
  EXPECT_EQ(first->frames.size(), 1U);
  EXPECT_EQ(first->events.size(), 2U);
  EXPECT_FALSE(first->ending);
}

TEST_F(RunMcapTest, WhatIsSaidWhenNoFrameComesAnyMoreIsThereAtOnce) {
  RunMcap mcap;
  for (int i = 0; i < 5; ++i) mcap.Add(FrameAt(milliseconds(100 * i), i));
  mcap.Add({.events = {{.frame = 4, .what = "robot", .text = "no picture for 0.3 s"}}});
  Write(mcap.TakeBytes());
  const auto log = ReadRunLog(File());
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_EQ(log->frames.size(), 5U);
  EXPECT_EQ(log->events.back().what, "robot");
}

TEST_F(RunMcapTest, WithoutPicturesThereAreNoFeaturesEither) {
  RunMcap mcap(0.0);
  for (int i = 0; i < 20; ++i) mcap.Add(FrameAt(milliseconds(100 * i), i));
  mcap.End();
  const auto bytes = mcap.TakeBytes();
  Write(bytes);
  EXPECT_EQ(ReadRunLog(File())->frames.size(), 20U);
  Viewer viewer(File());
  EXPECT_TRUE(viewer.Read("/camera/image").empty());
  EXPECT_TRUE(viewer.Read("/camera/features").empty());
  const auto pictures = RunPictures::Open(File());
  ASSERT_FALSE(pictures);
  EXPECT_THAT(pictures.error().message, HasSubstr("no pictures"));
}

TEST_F(RunMcapTest, WhatWasSeenInAFrameIsFoundByItsTime) {
  RunMcap mcap(0.5);
  for (int i = 0; i < 40; ++i) mcap.Add(FrameAt(milliseconds(100 * i), i));
  mcap.End();
  Write(mcap.TakeBytes());
  auto pictures = RunPictures::Open(File());
  ASSERT_TRUE(pictures) << pictures.error().message;
  const double began_s = 1'700'000'000.0;
  const auto features = (*pictures)->FeaturesAt(began_s + 2.3);
  ASSERT_TRUE(features);
  EXPECT_THAT(*features, ElementsAre(SeenFeature{.u_px = 90.0,
                                                 .v_px = 40.0,
                                                 .to_u_px = 110.0,
                                                 .to_v_px = 20.0,
                                                 .verdict = replay::FeatureVerdict::kAsksRight}));
  const auto picture = (*pictures)->PictureUntil(began_s + 2.3);
  ASSERT_TRUE(picture && *picture);
  EXPECT_NEAR((*picture)->t_s - began_s, 2.0, 1e-3) << "the last until then";
  EXPECT_TRUE(image::DecodeGray((*picture)->jpeg, "it"));
  EXPECT_TRUE((*pictures)->FeaturesAt(began_s + 2.25)->empty()) << "there was no frame";
  EXPECT_FALSE(*(*pictures)->PictureUntil(began_s - 1.0));
  EXPECT_FALSE(*(*pictures)->PictureUntil(began_s + 60.0)) << "that was elsewhere";
  EXPECT_FALSE(*(*pictures)->PictureUntil(-1e300));
}

TEST_F(RunMcapTest, TheWayOfALongDriveStaysShort) {
  RunMcap mcap;
  for (int i = 0; i < 5000; ++i) {
    mcap.Add(
        {.stamp = kBegan + milliseconds(100 * i), .odometry = motion::Pose2{0.1 * i, 0.0, 0.0}});
  }
  mcap.End();
  Write(mcap.TakeBytes());
  Viewer viewer(File());
  const std::string last = viewer.Read("/odometry/path").back();
  EXPECT_LT(last.size(), 60'000U);
  EXPECT_THAT(last, HasSubstr("position { x: 499"));
}

}  // namespace
}  // namespace trailcast::agent
