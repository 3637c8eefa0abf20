// Drives as a robot's own recorder writes them, made of runs that nobody here recorded, give the
// answers that their pictures give. Skipped, visibly, where those are absent.
#include "tests/scenario/recorded_runs.h"
#include "tests/support/recorded/record_drive.h"

namespace trailcast::test {
namespace {

using testing::HasSubstr;

// Share of the frames of `part` that were told what those of `whole` were.
double Agreement(const std::vector<Frame>& part, const std::vector<Frame>& whole) {
  constexpr double kSameTurn_rad = 0.05;
  std::size_t agreed = 0;
  for (std::size_t i = 0; i < std::min(part.size(), whole.size()); ++i) {
    const bool same = part[i].state == whole[i].state &&
                      std::abs(part[i].segment - whole[i].segment) <= 1 &&
                      std::abs(part[i].turn_rad - whole[i].turn_rad) < kSameTurn_rad;
    agreed += same ? 1 : 0;
  }
  return static_cast<double>(agreed) / static_cast<double>(part.size());
}

class RecordedDrivesTest : public RecordedRunsTest {
 protected:
  void SetUp() override {
    if (Absent("donkey_track")) GTEST_SKIP() << "no recorded runs at " << Data("donkey_track");
  }
  static std::filesystem::path Drive(const std::string& name) {
    return Data("donkey_track") / name;
  }

  void Teach(const Words& recording, const std::string& store) {
    const auto taught =
        RunAgent(With({"teach", "--route", "run", "--store", Path(store)}, recording));
    ASSERT_EQ(taught.status, 0) << taught.output;
  }
  std::vector<Frame> Replay(const Words& recording, const std::string& store) {
    const auto replayed = RunAgent(
        With({"replay", "--route", "run", "--store", Path(store), "--csv", Path("told.csv")},
             recording));
    EXPECT_TRUE(replayed.status == 0 || replayed.status == 3) << replayed.output;
    output_ = replayed.output;
    return ReadCsv(Path("told.csv"));
  }
  Words FramesWords(const std::string& name) {
    const std::string odometry = Path(name + ".csv");
    WriteOdometry(PicturesOf(Drive(name)).size(), odometry);
    return {"--frames",   Drive(name).string(),
            "--rate",     fmt::format("{:g}", kDriveRate_hz),
            "--odometry", odometry};
  }

  std::string output_;
};

TEST_F(RecordedDrivesTest, TaughtFromDb3AndReplayedFromMcapItIsToldTheSame) {
  { RecordDrive({Drive("teach")}, *std::make_unique<Db3Writer>(Path("teach.db3"))); }
  {
    McapBagWriter bag(Path("replay.mcap"), bag::Compression::kLz4);
    RecordDrive({Drive("replay"), /*compressed=*/true}, bag);
  }
  Teach({"--bag", Path("teach.db3")}, "bag.db");
  const auto by_bag = Replay({"--bag", Path("replay.mcap")}, "bag.db");
  EXPECT_THAT(output_, HasSubstr("pictures of /camera/image_raw/compressed, odometry of /odom"));
  Teach(FramesWords("teach"), "frames.db");
  const auto by_frames = Replay(FramesWords("replay"), "frames.db");
  ASSERT_GT(by_frames.size(), 400U);
  ASSERT_EQ(by_bag.size(), by_frames.size());
  EXPECT_EQ(Agreement(by_bag, by_frames), 1.0);
}

TEST_F(RecordedDrivesTest, ReplayedAgainItIsToldTheSame) {
  Teach(FramesWords("teach"), "store.db");
  ASSERT_GT(Replay(FramesWords("replay"), "store.db").size(), 400U);
  const bag::Bytes first = ReadBytes(Path("told.csv"));
  for (int again = 0; again < 3; ++again) {
    Replay(FramesWords("replay"), "store.db");
    EXPECT_EQ(ReadBytes(Path("told.csv")), first);
  }
}

TEST_F(RecordedDrivesTest, ARecordingThatWasCutOffIsToldTheSameAsFarAsItGoes) {
  for (const char* name : {"teach", "replay"}) {
    McapBagWriter bag(Path(std::string(name) + ".mcap"), bag::Compression::kZstd);
    RecordDrive({Drive(name), false, /*odometry=*/false}, bag);
  }
  Teach({"--bag", Path("teach.mcap")}, "store.db");
  const auto whole = Replay({"--bag", Path("replay.mcap")}, "store.db");
  bag::Bytes bytes = ReadBytes(Path("replay.mcap"));
  bytes.resize(bytes.size() * 6 / 10);
  WriteBytes(Path("cut.mcap"), bytes);
  const auto cut = Replay({"--bag", Path("cut.mcap")}, "store.db");
  EXPECT_THAT(output_, HasSubstr("cut off"));
  ASSERT_GT(cut.size(), whole.size() / 2);
  ASSERT_LT(cut.size(), whole.size());
  EXPECT_EQ(Agreement(cut, whole), 1.0);
}

TEST_F(RecordedDrivesTest, TheWrongTopicIsAnsweredWithThoseThatThereAre) {
  { RecordDrive({Drive("teach")}, *std::make_unique<Db3Writer>(Path("teach.db3"))); }
  const auto taught = RunAgent({"teach", "--route", "run", "--store", Path("store.db"), "--bag",
                                Path("teach.db3"), "--image-topic", "/front/image"});
  EXPECT_EQ(taught.status, 1) << taught.output;
  EXPECT_THAT(taught.output, HasSubstr("no topic /front/image; there are: /camera/image_raw "
                                       "(sensor_msgs/msg/Image, "));
}

}  // namespace
}  // namespace trailcast::test
