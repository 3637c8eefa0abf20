// This is a robot whose ROS 2 nodes run over Fast DDS, ROS 2's own default: a camera, wheels, a
// base. It sees a film with so many pictures for each metre of the path ahead.
#include <chrono>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "node.h"
#include "program.h"
#include "ros2PubSubTypes.h"

namespace {

using Clock = std::chrono::steady_clock;
namespace dds = eprosima::fastdds::dds;
namespace geometry = geometry_msgs::msg::dds_;
namespace nav = nav_msgs::msg::dds_;
namespace sensor = sensor_msgs::msg::dds_;
using eprosima::fastrtps::types::ReturnCode_t;

constexpr const char* kUsage =
    "fast_dds_robot DOMAIN SETTING FILM WIDTH HEIGHT drive|obey\n"
    "SETTING is default, localhost-only, localhost-range or data-sharing, whose commands are "
    "plain\n"
    "Twists; FILM holds pictures, a byte a pixel.\n"
    "'drive' drives along most of the film once somebody watches; 'obey' does as it is told.\n";
constexpr double kStep_m = 0.02;  // from one picture to the next
constexpr double kPeriod_s = 0.05;
constexpr double kSpeed_mps = 0.4;
constexpr double kShareDriven = 0.75;
constexpr std::chrono::milliseconds kCommandHolds{300};
constexpr std::chrono::seconds kBeforeDriving{2};  // once it is watched

struct Film {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> bytes;

  [[nodiscard]] std::size_t picture_size() const {
    return static_cast<std::size_t>(width) * height;
  }
  [[nodiscard]] std::size_t pictures() const { return bytes.size() / picture_size(); }
  [[nodiscard]] double length_m() const { return kStep_m * static_cast<double>(pictures() - 1); }
};

Film ReadFilm(const std::string& file, const std::string& width, const std::string& height) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot read " + file);
  Film film{static_cast<std::uint32_t>(std::stoul(width)),
            static_cast<std::uint32_t>(std::stoul(height)),
            {std::istreambuf_iterator<char>(stream), {}}};
  if (film.pictures() < 2) throw std::runtime_error(file + " holds no two pictures");
  return film;
}

std_msgs::msg::dds_::Header_ HeaderNow(const std::string& frame) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const auto seconds = std::chrono::floor<std::chrono::seconds>(now);
  std_msgs::msg::dds_::Header_ header;
  header.stamp().sec(static_cast<std::int32_t>(seconds.count()));
  header.stamp().nanosec(static_cast<std::uint32_t>(
      std::chrono::duration_cast<std::chrono::nanoseconds>(now - seconds).count()));
  header.frame_id(frame);
  return header;
}

class Robot {
 public:
  Robot(std::uint32_t domain, robot::Setting setting, Film film, bool obeys)
      : film_(std::move(film)),
        obeys_(obeys),
        node_(domain, setting),
        camera_(node_.Write("/robot1/image_raw", dds::TypeSupport(new sensor::Image_PubSubType()))),
        wheels_(node_.Write("/robot1/odom", dds::TypeSupport(new nav::Odometry_PubSubType()))),
        plain_(setting == robot::Setting::kDataSharing),
        commands_(node_.Read("/robot1/cmd_vel",
                             plain_ ? dds::TypeSupport(new geometry::Twist_PubSubType())
                                    : dds::TypeSupport(new geometry::TwistStamped_PubSubType()))) {}

  [[noreturn]] void Live() {
    auto next = Clock::now();
    while (true) {
      place_m_ = std::min(film_.length_m(), place_m_ + kPeriod_s * Speed_mps());
      Say();
      next += std::chrono::milliseconds(static_cast<int>(1000 * kPeriod_s));
      std::this_thread::sleep_until(next);
    }
  }

 private:
  double Speed_mps() {
    if (!obeys_) return DrivesItself() ? kSpeed_mps : 0.0;
    if (plain_) {
      Hear<geometry::Twist_>([](geometry::Twist_& command) { return command.linear().x(); });
    } else {
      Hear<geometry::TwistStamped_>(
          [](geometry::TwistStamped_& command) { return command.twist().linear().x(); });
    }
    return Clock::now() - told_at_ < kCommandHolds ? told_mps_ : 0.0;
  }
  template <typename Command, typename SpeedOf>
  void Hear(const SpeedOf& speed_of) {
    Command command;
    dds::SampleInfo info;
    while (commands_->take_next_sample(&command, &info) == ReturnCode_t::RETCODE_OK) {
      if (!info.valid_data) continue;
      told_mps_ = speed_of(command);
      told_at_ = Clock::now();
    }
  }
  bool DrivesItself() {
    dds::PublicationMatchedStatus matched;
    camera_->get_publication_matched_status(matched);
    if (matched.current_count == 0) watched_since_ = Clock::now();
    return Clock::now() - watched_since_ > kBeforeDriving &&
           place_m_ < kShareDriven * film_.length_m();
  }
  void Say() {
    nav::Odometry_ odometry;
    odometry.header(HeaderNow("odom"));
    odometry.child_frame_id("base_link");
    odometry.pose().pose().position().x(place_m_);
    odometry.pose().pose().orientation().w(1.0);
    wheels_->write(&odometry);
    const auto picture = static_cast<std::size_t>(place_m_ / kStep_m + 0.5);
    const auto begin =
        film_.bytes.begin() + static_cast<std::ptrdiff_t>(picture * film_.picture_size());
    sensor::Image_ image;
    image.header(HeaderNow("camera"));
    image.width(film_.width);
    image.height(film_.height);
    image.encoding("mono8");
    image.step(film_.width);
    image.data(std::vector<std::uint8_t>(
        begin, begin + static_cast<std::ptrdiff_t>(film_.picture_size())));
    camera_->write(&image);
  }

  Film film_;
  bool obeys_;
  robot::Node node_;
  dds::DataWriter* camera_;
  dds::DataWriter* wheels_;
  bool plain_;  // commands, without a stamp: of a fixed size, as what is shared has to be
  dds::DataReader* commands_;
  double place_m_ = 0.0;
  double told_mps_ = 0.0;
  Clock::time_point told_at_{};
  Clock::time_point watched_since_ = Clock::now();
};

int Run(const std::vector<std::string>& words) {
  static const std::map<std::string, robot::Setting> kSettings = {
      {"default", robot::Setting::kDefault},
      {"localhost-only", robot::Setting::kLocalhostOnly},
      {"localhost-range", robot::Setting::kLocalhostRange},
      {"data-sharing", robot::Setting::kDataSharing}};
  if (words.size() != 6 || kSettings.count(words[1]) == 0 ||
      (words[5] != "drive" && words[5] != "obey")) {
    throw std::invalid_argument(kUsage);
  }
  Robot(static_cast<std::uint32_t>(std::stoul(words[0])), kSettings.at(words[1]),
        ReadFilm(words[2], words[3], words[4]), words[5] == "obey")
      .Live();
}

}  // namespace

int main(int argc, char** argv) { return fast_dds::StatusOf(Run, argc, argv); }
