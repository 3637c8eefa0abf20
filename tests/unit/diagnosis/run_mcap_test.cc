// A replay's log as MCAP, read as a viewer does: by the description that the file carries.
#include "agent/diagnosis/run_mcap.h"

#include <gmock/gmock.h>
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/dynamic_message.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <memory>

#include "agent/diagnosis/run_log_format.h"
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
  return {.text = RowText(row) + EventText(event),
          .events = {event},
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
  // As text.
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
  EXPECT_EQ(viewer.topics(), 7U);
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

TEST_F(RunMcapTest, TheColumnsOfTheLogAreTheFieldsOfItsFrames) {
  RunMcap mcap;
  mcap.End();
  Write(mcap.TakeBytes());
  Viewer viewer(File());
  const auto* frame = viewer.Find("trailcast.log.Frame");
  ASSERT_NE(frame, nullptr);
  const auto columns = ColumnNames();
  ASSERT_EQ(static_cast<std::size_t>(frame->field_count()), columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto* field = frame->FindFieldByNumber(static_cast<int>(i) + 1);
    ASSERT_NE(field, nullptr) << columns[i];
    EXPECT_EQ(field->name(), columns[i]);
  }
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
  mcap.Add({.text = FirstLine() + HeaderText({})});
  for (int i = 0; i < 50; ++i) mcap.Add(FrameAt(milliseconds(100 * i), i));
  Write(mcap.TakeBytes());
  const auto log = ReadRunLog(File());
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_GE(log->frames.size(), 40U);
  EXPECT_FALSE(log->ending);
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

TEST_F(RunMcapTest, WhatHasNoPicturesSaysSo) {
  Write({'#', ' ', 't', 'e', 'x', 't'});
  const auto pictures = RunPictures::Open(File());
  ASSERT_FALSE(pictures);
  EXPECT_THAT(pictures.error().message, HasSubstr("no pictures"));
}

TEST_F(RunMcapTest, OfALongLogOnlyTheEndsAreReadForAList) {
  Fields header;
  header.Add("route", "hall");
  RunMcap mcap;
  mcap.Add({.text = FirstLine() + HeaderText(header)});
  for (int i = 0; i < 5000; ++i) {
    RunMoment moment = FrameAt(milliseconds(100 * i), i);
    moment.picture = {};
    mcap.Add(moment);
  }
  const RunEvent end{4999, 0.0, "end", {}, "there"};
  mcap.Add({.text = EventText(end), .events = {end}});
  mcap.End();
  Write(mcap.TakeBytes());
  const auto ends = ReadRunEnds(File());
  ASSERT_TRUE(ends) << ends.error().message;
  EXPECT_EQ(ends->header.Find("route"), "hall");
  EXPECT_EQ(ends->frames.front().frame, 0);
  EXPECT_EQ(ends->frames.back().frame, 4999);
  EXPECT_LT(ends->frames.size(), 1000U);
  ASSERT_TRUE(ends->ending);
  EXPECT_EQ(ends->ending->text, "there");
}

TEST_F(RunMcapTest, TheWayOfALongDriveStaysShort) {
  RunMcap mcap;
  for (int i = 0; i < 5000; ++i) {
    mcap.Add({.text = "",
              .stamp = kBegan + milliseconds(100 * i),
              .odometry = motion::Pose2{0.1 * i, 0.0, 0.0}});
  }
  mcap.End();
  Write(mcap.TakeBytes());
  Viewer viewer(File());
  const std::string last = viewer.Read("/odometry/path").back();
  EXPECT_LT(last.size(), 60'000U);
  EXPECT_THAT(last, HasSubstr("position { x: 499"));
}

TEST_F(RunMcapTest, ARecordingThatIsNoLogIsToldApart) {
  bag::McapWriter writer(bag::Compression::kNone, "");
  writer.Put(writer.AddChannel(0, "/chatter", "cdr"), milliseconds(0), {});
  writer.End();
  Write(writer.TakeBytes());
  const auto log = ReadRunLog(File());
  ASSERT_FALSE(log);
  EXPECT_THAT(log.error().message, HasSubstr("--log FILE.mcap"));
}

}  // namespace
}  // namespace trailcast::agent
