#include "agent/device/bag_device.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/recorded/bag_writers.h"
#include "tests/support/recorded/ros_messages.h"
#include "tests/support/temp_dir.h"
#include "tests/support/walk_frames.h"

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kImage = "sensor_msgs/msg/Image";
constexpr const char* kOdometry = "nav_msgs/msg/Odometry";
constexpr nanoseconds kBegin = std::chrono::seconds(1'700'000'000);
// How much later than it was stamped a message is recorded.
constexpr milliseconds kDelay{20};

class BagDeviceTest : public testing::Test {
 protected:
  test::BagWriter& Writer() {
    if (!writer_) writer_ = std::make_unique<test::Db3Writer>(File());
    return *writer_;
  }
  [[nodiscard]] std::filesystem::path File() const { return folder_ / "run.db3"; }

  void Picture(milliseconds at, int number = 0, const std::string& topic = "/camera") {
    Writer().Put(topic, kImage, kBegin + at + kDelay,
                 test::ImageMessage(kBegin + at, test::WalkFrame(number)));
  }
  // A robot that drives one metre a second.
  void Odometry(milliseconds at, nanoseconds clock = kBegin, const std::string& topic = "/odom") {
    Writer().Put(topic, kOdometry, kBegin + at + kDelay,
                 test::OdometryMessage(clock + at, {1e-3 * static_cast<double>(at.count()), 0, 0}));
  }
  Result<std::unique_ptr<BagDevice>> Open(BagRun run = {}) {
    writer_.reset();
    run.bag = File();
    return BagDevice::Open(run);
  }
  std::string ErrorOf(const BagRun& run = {}) {
    const auto device = Open(run);
    return device ? "no error" : device.error().message;
  }
  static std::vector<Observation> All(BagDevice& device) {
    std::vector<Observation> all;
    while (true) {
      auto next = device.Next();
      EXPECT_TRUE(next) << next.error().message;
      if (!next || !*next) return all;
      all.push_back(std::move(**next));
    }
  }

  test::TempDir folder_;
  std::unique_ptr<test::BagWriter> writer_;
};

TEST_F(BagDeviceTest, PicturesHaveTheirOwnTimesAndTheOdometryOfThen) {
  for (int i = 0; i < 5; ++i) Odometry(milliseconds(100 * i));
  Picture(milliseconds(0), 0);
  Picture(milliseconds(130), 1);
  Picture(milliseconds(275), 2);
  const auto device = Open();
  ASSERT_TRUE(device) << device.error().message;
  EXPECT_EQ((*device)->camera(), "recorded 160x120");
  EXPECT_THAT((*device)->sources(), AllOf(HasSubstr("/camera"), HasSubstr("/odom")));
  const auto all = All(**device);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[1].stamp, kBegin + milliseconds(130));
  EXPECT_EQ(all[1].image.pixels, test::WalkFrame(1).pixels);
  EXPECT_NEAR(all[1].odometry->x_m, 0.130, 1e-6);
  EXPECT_NEAR(all[2].odometry->x_m, 0.275, 1e-6);
  EXPECT_DOUBLE_EQ(*(*device)->drive_progress(), 1.0);
}

TEST_F(BagDeviceTest, OdometryInMillimetresIsRefused) {
  for (int at = 0; at <= 2000; at += 50) {
    Writer().Put("/odom", kOdometry, kBegin + milliseconds(at) + kDelay,
                 test::OdometryMessage(kBegin + milliseconds(at), {1.0 * at, 0, 0}));
  }
  for (int at = 0; at <= 2000; at += 100) Picture(milliseconds(at), at / 100);
  const auto device = Open();
  ASSERT_FALSE(device);
  EXPECT_THAT(device.error().message,
              AllOf(HasSubstr("/odom"), HasSubstr("1000 m/s"), HasSubstr("millimetres")));
}

TEST_F(BagDeviceTest, OdometryThatJumpsIsBridgedAndHowFarItMayHaveDrivenIsTold) {
  const auto odometry = [&](int at, double x_m) {
    Writer().Put("/odom", kOdometry, kBegin + milliseconds(at) + kDelay,
                 test::OdometryMessage(kBegin + milliseconds(at), {x_m, 0, 0}));
  };
  for (int at = 0; at < 1000; at += 50) odometry(at, 4.0 + 1e-3 * at);
  for (int at = 1000; at <= 2000; at += 50) odometry(at, 1e-3 * (at - 1000));
  for (int at = 0; at <= 2000; at += 100) Picture(milliseconds(at), at / 100);
  const auto device = Open();
  ASSERT_TRUE(device) << device.error().message;
  const auto all = All(**device);
  ASSERT_EQ(all.size(), 21U);
  EXPECT_NEAR(all.back().odometry->x_m - all.front().odometry->x_m, 1.95, 1e-6);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_NEAR(all[i].unknown.distance_m, i == 10 ? 0.05 : 0.0, 1e-6) << i;
  }
}

TEST_F(BagDeviceTest, ADriveAsFastAsACarsIsNoJump) {
  const auto odometry = [&](int at) {
    Writer().Put("/odom", kOdometry, kBegin + milliseconds(at) + kDelay,
                 test::OdometryMessage(kBegin + milliseconds(at), {0.012 * at, 0, 0}));
  };
  for (int at = 0; at <= 9000; at += 1000) odometry(at);
  for (int at = 0; at <= 9000; at += 500) Picture(milliseconds(at), at / 500);
  const auto device = Open();
  ASSERT_TRUE(device) << device.error().message;
  const auto all = All(**device);
  ASSERT_EQ(all.size(), 19U);
  EXPECT_NEAR(all.back().odometry->x_m, 108.0, 1e-6);
  for (const Observation& each : all) EXPECT_EQ(each.unknown.distance_m, 0.0);
}

TEST_F(BagDeviceTest, WhatTheBaseWasToldIsHeardWhereItIsAskedForWhileItHolds) {
  for (int at = 0; at <= 3000; at += 100) {
    Odometry(milliseconds(at));
    Picture(milliseconds(at), at / 100);
  }
  const auto tell = [&](int at, double linear_mps) {
    Writer().Put("/cmd_vel", "geometry_msgs/msg/Twist", kBegin + milliseconds(at) + kDelay,
                 test::TwistMessage({linear_mps, 0.1}));
  };
  tell(450, 0.3);
  tell(850, 0.4);
  const auto without = Open();
  ASSERT_TRUE(without) << without.error().message;
  for (const Observation& each : All(**without)) EXPECT_FALSE(each.heard);
  BagRun run;
  run.hear_commands = true;
  const auto device = Open(run);
  ASSERT_TRUE(device) << device.error().message;
  const auto all = All(**device);
  ASSERT_EQ(all.size(), 31U);
  EXPECT_FALSE(all[4].heard);
  EXPECT_EQ(all[5].heard, (motion::VelocityCommand{0.3, 0.1}));
  EXPECT_EQ(all[9].heard, (motion::VelocityCommand{0.4, 0.1}));
  EXPECT_TRUE(all[18].heard);
  EXPECT_FALSE(all[19].heard) << "a second and more ago";
}

TEST_F(BagDeviceTest, TheCommandsTopicIsTheOneThatIsNamedWhereThereAreSeveral) {
  Picture(milliseconds(100));
  Odometry(milliseconds(100));
  for (const char* topic : {"/cmd_vel", "/joystick"}) {
    Writer().Put(topic, "geometry_msgs/msg/Twist", kBegin, test::TwistMessage({0.3, 0.0}));
  }
  BagRun run;
  run.hear_commands = true;
  const auto unnamed = Open(run);
  ASSERT_TRUE(unnamed) << unnamed.error().message;
  EXPECT_FALSE(All(**unnamed).front().heard);
  run.command_topic = "/joystick";
  const auto named = Open(run);
  ASSERT_TRUE(named) << named.error().message;
  EXPECT_TRUE(All(**named).front().heard);
  run.command_topic = "/nobody";
  EXPECT_THAT(ErrorOf(run), HasSubstr("no topic /nobody; there are: "));
}

TEST_F(BagDeviceTest, TellsOfClocksThatStepAndOfOdometryThatIsNone) {
  for (int at = 0; at <= 2000; at += 100) {
    Picture(milliseconds(at), at / 100);
    const auto clock = kBegin + (at < 1000 ? milliseconds(0) : milliseconds(1500));
    Odometry(milliseconds(at), clock);
  }
  auto zeros = test::OdometryMessage(kBegin, {});
  std::fill(zeros.end() - static_cast<std::ptrdiff_t>((78 + 4) * sizeof(double)),
            zeros.end() - static_cast<std::ptrdiff_t>(78 * sizeof(double)), std::uint8_t{0});
  Writer().Put("/odom", kOdometry, kBegin + milliseconds(2100), zeros);
  const auto device = Open();
  ASSERT_TRUE(device) << device.error().message;
  (void)All(**device);
  const auto news = (*device)->TakeNews();
  ASSERT_GE(news.size(), 2U);
  EXPECT_THAT(news[0], HasSubstr("the stamps of /odom step by +1.50 s against the recorder's "
                                 "clock, 1.00 s into the recording"));
  EXPECT_THAT(news[1], AllOf(HasSubstr("1 of 22 messages of /odom are left out"),
                             HasSubstr("the orientation in it is the quaternion (0, 0, 0, 0)")));
  EXPECT_THAT((*device)->TakeNews(), testing::IsEmpty());
}

TEST_F(BagDeviceTest, PicturesFarFromAnyOdometryAreLeftOut) {
  for (int at = 1000; at <= 1400; at += 100) Odometry(milliseconds(at));
  for (int at = 3000; at <= 3400; at += 100) Odometry(milliseconds(at));
  for (int at = 0; at <= 4500; at += 100) Picture(milliseconds(at), at / 100);
  const auto device = Open();
  ASSERT_TRUE(device) << device.error().message;
  const auto all = All(**device);
  ASSERT_EQ(all.size(), 30U);
  EXPECT_EQ(all.front().stamp, kBegin + milliseconds(500));
  EXPECT_EQ(all.back().stamp, kBegin + milliseconds(3900));
  EXPECT_THAT((*device)->TakeNews(),
              Contains(HasSubstr("of 46 pictures are left out: 16 taken more than 0.5 s from any "
                                 "odometry; nothing is seen of ")));
}

TEST_F(BagDeviceTest, ClocksThatDifferAreReplacedByTheRecorders) {
  for (int i = 0; i < 5; ++i) Odometry(milliseconds(100 * i), std::chrono::seconds(77));
  Picture(milliseconds(250));
  const auto device = Open();
  ASSERT_TRUE(device) << device.error().message;
  const auto all = All(**device);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].stamp, kBegin + milliseconds(250) + kDelay);
  EXPECT_NEAR(all[0].odometry->x_m, 0.250, 1e-6);
}

// A drive of ten seconds, at one metre a second, whose clocks are as `at` makes them of the time.
class BagClockTest : public BagDeviceTest {
 protected:
  struct Clocks {
    nanoseconds stamp{};
    nanoseconds logged{};
  };
  // Odometry thirty times a second, pictures ten times, in turn.
  template <typename PictureClocks, typename OdometryClocks>
  void Record(const PictureClocks& picture, const OdometryClocks& odometry) {
    writer_.reset();
    std::filesystem::remove(File());
    for (int i = 0; i <= 300; ++i) {
      const milliseconds at(i * 100 / 3);
      const Clocks by = odometry(at);
      Writer().Put("/odom", kOdometry, by.logged,
                   test::OdometryMessage(by.stamp, {1e-3 * static_cast<double>(at.count()), 0, 0}));
      if (i % 3 != 0) continue;
      const Clocks seen = picture(at);
      Writer().Put("/camera", kImage, seen.logged,
                   test::ImageMessage(seen.stamp, test::WalkFrame(i / 3)));
    }
  }
  static Clocks Right(milliseconds at) { return {kBegin + at, kBegin + at + kDelay}; }
  // All 101 pictures, each where it was taken.
  void ExpectAll() {
    const auto device = Open();
    ASSERT_TRUE(device) << device.error().message;
    const auto all = All(**device);
    ASSERT_EQ(all.size(), 101U);
    for (std::size_t i = 0; i < all.size(); ++i) {
      EXPECT_NEAR(all[i].odometry->x_m, 0.1 * static_cast<double>(i), 0.045) << i;
      EXPECT_EQ(all[i].unknown.distance_m, 0.0) << i;
      if (i == 0) continue;
      EXPECT_NEAR(Seconds(all[i].stamp - all[i - 1].stamp), 0.1, 0.06) << i;
    }
  }
};

constexpr milliseconds kHalf{5000};

TEST_F(BagClockTest, BothOfTheirClocksAreSetBackOnTheWay) {
  for (const auto by : {std::chrono::seconds(10), std::chrono::seconds(3600)}) {
    const auto set_back = [&](milliseconds at) {
      const Clocks right = Right(at);
      if (at < kHalf) return right;
      return Clocks{right.stamp - by, right.logged - by};
    };
    Record(set_back, set_back);
    ExpectAll();
  }
}

TEST_F(BagClockTest, TheirStampsAloneAreSetBackOrAhead) {
  for (const milliseconds by : {milliseconds(10'000), milliseconds(-86'400'000)}) {
    const auto set = [&](milliseconds at) {
      return at < kHalf ? Right(at) : Clocks{Right(at).stamp - by, Right(at).logged};
    };
    Record(set, set);
    ExpectAll();
    Record(set, Right);
    ExpectAll();
  }
}

TEST_F(BagClockTest, TheRecordersClockAloneIsSetBackOrAhead) {
  for (const milliseconds by : {milliseconds(10'000), milliseconds(-86'400'000)}) {
    const auto set = [&](milliseconds at) {
      return at < kHalf ? Right(at) : Clocks{Right(at).stamp, Right(at).logged - by};
    };
    Record(set, set);
    ExpectAll();
  }
}

TEST_F(BagClockTest, OneMessageIsADayAhead) {
  constexpr std::chrono::hours kDay{24};
  for (const auto& [stamp, logged] :
       std::vector<std::pair<nanoseconds, nanoseconds>>{{kDay, {}}, {{}, kDay}, {kDay, kDay}}) {
    const auto one_ahead = [&, ahead = Clocks{stamp, logged}](milliseconds at) {
      const Clocks right = Right(at);
      const bool is_it = at > milliseconds(2950) && at < milliseconds(3020);
      return is_it ? Clocks{right.stamp + ahead.stamp, right.logged + ahead.logged} : right;
    };
    Record(one_ahead, Right);
    ExpectAll();
    const auto first_ahead = [&, ahead = Clocks{stamp, logged}](milliseconds at) {
      const Clocks right = Right(at);
      const bool is_it = at > milliseconds(2980) && at < milliseconds(3020);
      return is_it ? Clocks{right.stamp + ahead.stamp, right.logged + ahead.logged} : right;
    };
    Record(Right, first_ahead);
    ExpectAll();
  }
}

TEST_F(BagClockTest, EitherClockStandsAltogetherOrAtFirst) {
  const auto stamps_stand = [](milliseconds at) { return Clocks{kBegin, Right(at).logged}; };
  const auto recorder_stands = [](milliseconds at) { return Clocks{Right(at).stamp, kBegin}; };
  const auto zero_at_first = [](milliseconds at) {
    return at < milliseconds(300) ? Clocks{{}, Right(at).logged} : Right(at);
  };
  Record(stamps_stand, stamps_stand);
  ExpectAll();
  Record(stamps_stand, Right);
  ExpectAll();
  Record(recorder_stands, recorder_stands);
  ExpectAll();
  Record(zero_at_first, Right);
  ExpectAll();
  Record(Right, zero_at_first);
  ExpectAll();
}

TEST_F(BagDeviceTest, PicturesWithoutStampsHaveTheTimeOfRecording) {
  Writer().Put("/camera", kImage, kBegin, test::ImageMessage({}, test::WalkFrame(0)));
  Writer().Put("/camera", kImage, kBegin + milliseconds(50),
               test::ImageMessage({}, test::WalkFrame(1)));
  const auto device = Open();
  ASSERT_TRUE(device) << device.error().message;
  const auto all = All(**device);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[1].stamp, kBegin + milliseconds(50));
  EXPECT_FALSE(all[1].odometry);
}

TEST_F(BagDeviceTest, DamagedAndLatePicturesAreLeftOut) {
  Picture(milliseconds(0), 0);
  Writer().Put("/camera", kImage, kBegin + milliseconds(50), {1, 2, 3});
  Picture(milliseconds(200), 1);
  Picture(milliseconds(100), 2);
  Picture(milliseconds(300), 3);
  const auto device = Open();
  ASSERT_TRUE(device) << device.error().message;
  const auto all = All(**device);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[2].image.pixels, test::WalkFrame(3).pixels);
}

TEST_F(BagDeviceTest, ADriveOfWhichTooManyPicturesAreDamagedEndsThere) {
  Picture(milliseconds(0), 0);
  for (int at = 50; at <= 600; at += 50) {
    Writer().Put("/camera", kImage, kBegin + milliseconds(at), {1, 2, 3});
  }
  const auto device = Open();
  ASSERT_TRUE(device) << device.error().message;
  ASSERT_TRUE((*device)->Next());
  const auto ended = (*device)->Next();
  ASSERT_FALSE(ended);
  EXPECT_THAT(ended.error().message,
              AllOf(HasSubstr("/camera"), HasSubstr("11 of 12 pictures"), HasSubstr("too many")));
}

TEST_F(BagDeviceTest, OfASensorWithTwelveBitsThoseAreSeen) {
  for (int i = 0; i < 2; ++i) {
    image::GrayImage wide{320, 120, {}};  // two bytes a pixel, of which four bits are above eight
    for (const std::uint8_t pixel : test::WalkFrame(i).pixels) {
      wide.pixels.push_back(static_cast<std::uint8_t>(pixel << 4U));
      wide.pixels.push_back(static_cast<std::uint8_t>(pixel >> 4U));
    }
    test::CdrWriter cdr;
    cdr.PutHeader(kBegin + milliseconds(100 * i), "camera");
    cdr.Put(std::uint32_t{120}).Put(std::uint32_t{160}).PutText("mono16").Put(std::uint8_t{0});
    cdr.Put(std::uint32_t{320}).PutOctets(wide.pixels);
    Writer().Put("/camera", kImage, kBegin + milliseconds(100 * i), cdr.Message());
  }
  const auto device = Open();
  ASSERT_TRUE(device) << device.error().message;
  const auto all = All(**device);
  ASSERT_EQ(all.size(), 2U);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(all[static_cast<std::size_t>(i)].image.pixels, test::WalkFrame(i).pixels);
  }
}

TEST_F(BagDeviceTest, OdometryWithoutAnOrientationIsToldSo) {
  Picture(milliseconds(0));
  test::CdrWriter cdr;
  cdr.PutHeader(kBegin, "odom").PutText("base_link");
  for (int i = 0; i < 7; ++i) cdr.PutDouble(0.0);
  Writer().Put("/odom", kOdometry, kBegin, cdr.Message());
  EXPECT_THAT(ErrorOf(), AllOf(HasSubstr("none of 1 messages of /odom"),
                               HasSubstr("orientation in it is the quaternion (0, 0, 0, 0)")));
}

TEST_F(BagDeviceTest, CompressedPicturesAreDecoded) {
  const auto jpeg = image::EncodeJpeg(test::WalkFrame(3), 100);
  ASSERT_TRUE(jpeg);
  Writer().Put("/camera/compressed", "sensor_msgs/msg/CompressedImage", kBegin,
               test::CompressedImageMessage(kBegin, *jpeg));
  const auto device = Open();
  ASSERT_TRUE(device) << device.error().message;
  const auto all = All(**device);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].image.pixels, image::DecodeGray(*jpeg, "")->pixels);
}

TEST_F(BagDeviceTest, TopicsThatAreNotThereAreAnsweredWithThoseThatAre) {
  Picture(milliseconds(0));
  Odometry(milliseconds(0));
  EXPECT_THAT(
      ErrorOf({{}, "/front", {}}),
      AllOf(HasSubstr("no topic /front"), HasSubstr("/camera (sensor_msgs/msg/Image, 1 messages)"),
            HasSubstr("/odom (nav_msgs/msg/Odometry, 1 messages)")));
  EXPECT_THAT(ErrorOf({{}, "/odom", {}}), HasSubstr("pictures are sensor_msgs/Image"));
  EXPECT_THAT(ErrorOf({{}, {}, "/wheels"}), HasSubstr("no topic /wheels"));
  EXPECT_EQ(ErrorOf({{}, "camera", "odom"}), "no error") << "without the slash";
}

TEST_F(BagDeviceTest, WhereThereIsAChoiceItIsTheUsers) {
  Picture(milliseconds(0), 0, "/left");
  Picture(milliseconds(0), 1, "/right");
  Odometry(milliseconds(0));
  Odometry(milliseconds(0), kBegin, "/odometry/filtered");
  EXPECT_THAT(ErrorOf(), AllOf(HasSubstr("--image-topic"), HasSubstr("/left"), HasSubstr("/right"),
                               Not(HasSubstr("/odom"))));
  EXPECT_THAT(ErrorOf({{}, "/right", {}}),
              AllOf(HasSubstr("--odom-topic"), HasSubstr("/odometry/filtered")));
  const auto device = Open({{}, "/right", ""});
  ASSERT_TRUE(device) << device.error().message;
  const auto all = All(**device);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].image.pixels, test::WalkFrame(1).pixels);
  EXPECT_FALSE(all[0].odometry);
}

TEST_F(BagDeviceTest, ARecordingWithoutPicturesSaysWhatItHas) {
  Odometry(milliseconds(0));
  EXPECT_THAT(ErrorOf(), AllOf(HasSubstr("no topic with pictures"), HasSubstr("/odom")));
}

TEST_F(BagDeviceTest, WhereNoPictureIsNearOdometryNothingBegins) {
  Picture(milliseconds(0));
  Picture(milliseconds(100));
  Odometry(milliseconds(5000));
  EXPECT_THAT(ErrorOf(), AllOf(HasSubstr("gives no picture"), HasSubstr("2 taken more than")));
}

}  // namespace
}  // namespace trailcast::agent
