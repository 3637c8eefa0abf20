#include "services/dds/ros2_link.h"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <mutex>
#include <utility>

#include "services/dds/src/domain/cyclone_uri.h"
#include "services/dds/src/domain/domain_config.h"
#include "services/dds/src/domain/user_data.h"
#include "services/dds/src/entities.h"
#include "services/dds/src/ros2/closed_participants.h"
#include "services/dds/src/ros2/ros2_network.h"
#include "services/dds/src/ros2/ros2_speaker.h"
#include "services/dds/src/ros2/ros2_wire.h"

namespace trailcast::dds {
namespace {

constexpr int kNewestFrames = 2;
constexpr int kNewestPoses = 64;
constexpr int kNewestScans = 2;
constexpr int kNewestImu = 256;
constexpr std::chrono::milliseconds kWriteTimeout{100};
constexpr std::size_t kMaxSamplesPerTake = 256;
// Our own messages are small, but a camera's picture of 12 megapixels in colour is not.
constexpr const char* kPictureSized =
    "<CycloneDDS><Domain><Internal><MaxSampleSize>64MB</MaxSampleSize></Internal></Domain>"
    "</CycloneDDS>";

// A ROS name has tokens of letters, digits and '_'. None begins with a digit, and none is empty.
bool IsRosName(const std::string& name) {
  bool begins = true;
  for (const char c : name.substr(1)) {
    const auto letter = static_cast<unsigned char>(c);
    if (c == '/' ? begins : std::isalnum(letter) == 0 && c != '_') return false;
    if (begins && std::isdigit(letter) != 0) return false;
    begins = c == '/';
  }
  return name.size() > 1 && name.front() == '/' && !begins;
}

std::string Resolve(const std::string& robot, const std::string& topic) {
  if (topic.starts_with('/')) return topic;
  return (robot == "/" ? "" : robot) + "/" + topic;
}

// Sensors are heard from any publisher that offers at least best effort.
Qos SensorQos(int keep_last) {
  Qos qos = MakeQos();
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_BEST_EFFORT, 0);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, keep_last);
  return qos;
}

Qos ReliableQos(int keep_last) {
  Qos qos = MakeQos();
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, DDS_MSECS(kWriteTimeout.count()));
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, keep_last);
  return qos;
}

// A participant of the robot's domain, for either end.
struct Node {
  Domain domain;
  Participant participant;
  std::vector<Topic> topics;
  WaitSet wait_set;

  // `network_xml` tells how it meets others, if not as any node does.
  static Result<Node> Open(const Ros2Options& options, const std::string& network_xml = {}) {
    if (auto valid = options.Validate(); !valid) return tl::unexpected(valid.error());
    DdsOptions dds;
    dds.domain_id = options.domain_id;
    dds.discovery_tag = options.discovery_tag;
    dds.network_interface = options.network_interface;
    dds.extra_config_xml = kPictureSized;
    if (!network_xml.empty()) dds.extra_config_xml += "," + network_xml;
    const auto config = DomainConfig(dds, {}, CycloneUri());
    if (!config) return tl::unexpected(config.error());
    auto domain = Domain::Create(*config);
    if (!domain) return tl::unexpected(domain.error());
    auto participant = Participant::Create(*domain, kRobotsEnd);
    if (!participant) return tl::unexpected(participant.error());
    auto wait_set = WaitSet::Create(*participant);
    if (!wait_set) return tl::unexpected(wait_set.error());
    return Node{*std::move(domain), *std::move(participant), {}, *std::move(wait_set)};
  }

  [[nodiscard]] Result<const Topic*> MakeTopic(const dds_topic_descriptor_t& type,
                                               const std::string& name) {
    auto topic = Topic::Create(participant, type, "rt" + name);
    if (!topic) return tl::unexpected(topic.error());
    return &topics.emplace_back(*std::move(topic));
  }

  [[nodiscard]] Result<Reader> Hear(const dds_topic_descriptor_t& type, const std::string& name,
                                    const Qos& qos) {
    auto topic = MakeTopic(type, name);
    if (!topic) return tl::unexpected(topic.error());
    auto reader = Reader::Create(participant, **topic, qos);
    if (!reader) return Wrap(reader.error(), name);
    if (auto attached = wait_set.Attach(*reader); !attached) return Wrap(attached.error(), name);
    return reader;
  }

  [[nodiscard]] Result<Writer> Speak(const dds_topic_descriptor_t& type, const std::string& name,
                                     const Qos& qos) {
    auto topic = MakeTopic(type, name);
    if (!topic) return tl::unexpected(topic.error());
    auto writer = Writer::Create(participant, **topic, qos);
    if (!writer) return Wrap(writer.error(), name);
    return writer;
  }
};

std::string Mismatch(const std::string& topic, const std::string& policy) {
  return policy.empty() ? std::string() : fmt::format("{} ({})", topic, policy);
}

}  // namespace

std::string Ros2Options::ImageTopic() const { return Resolve(robot, image); }
std::string Ros2Options::OdometryTopic() const { return Resolve(robot, odometry); }
std::string Ros2Options::ScanTopic() const { return Resolve(robot, scan); }
std::string Ros2Options::RangeTopic(std::size_t sensor) const {
  return Resolve(robot, ranges[sensor]);
}
std::string Ros2Options::ImuTopic() const { return Resolve(robot, imu); }
std::string Ros2Options::BatteryTopic() const { return Resolve(robot, battery); }
std::string Ros2Options::CommandTopic() const { return Resolve(robot, command); }
bool Ros2Options::image_is_compressed() const { return image.ends_with("/compressed"); }

Result<void> Ros2Options::Validate() const {
  std::vector<std::string> names{ImageTopic(), CommandTopic()};
  if (!odometry.empty()) names.push_back(OdometryTopic());
  if (!scan.empty()) names.push_back(ScanTopic());
  if (!imu.empty()) names.push_back(ImuTopic());
  if (!battery.empty()) names.push_back(BatteryTopic());
  for (std::size_t i = 0; i < ranges.size(); ++i) names.push_back(RangeTopic(i));
  for (const std::string& name : names) {
    if (!IsRosName(name)) {
      return Fail(ErrorCode::kInvalidArgument,
                  "'{}' is no ROS 2 topic: expected a name as /robot1/image_raw, of letters, "
                  "digits and '_', no part beginning with a digit",
                  name);
    }
  }
  return {};
}

namespace {

struct DriverState {
  Ros2Options options;
  Ros2Network network;
  Node node;
  Reader image;
  std::optional<Reader> odometry;
  std::optional<Reader> scan;
  std::vector<Reader> ranges;
  std::optional<Reader> imu;
  std::optional<Reader> battery;
  std::optional<Reader> others_commands;
  Writer command;
};

class Ros2DdsDriver final : public Ros2Driver {
 public:
  explicit Ros2DdsDriver(DriverState state, ClosedParticipants closed)
      : state_(std::move(state)), closed_(std::move(closed)) {}
  std::vector<Ros2Sensed> Take(std::chrono::milliseconds max_wait) override;
  Result<void> Publish(const Ros2Command& command) override;
  [[nodiscard]] Peers peers() const override;
  [[nodiscard]] std::string crowded() const override;

 private:
  // Says whether a sample is to be passed on.
  [[nodiscard]] bool Counts(Ros2Speaker& speaker, const Reader& reader,
                            const dds_sample_info_t& info);
  void NoteOdometry(const Result<Ros2Odometry>& odometry, std::vector<Ros2Sensed>& sensed);

  DriverState state_;
  mutable std::mutex mutex_;  // guards everything below
  Ros2Speaker image_speaker_;
  Ros2Speaker odometry_speaker_;
  mutable ClosedParticipants closed_;
  int unusable_odometry_ = 0;
  std::string unfit_odometry_;
};

}  // namespace

Result<std::unique_ptr<Ros2Driver>> Ros2Driver::Open(const Ros2Options& options) {
  Ros2Network network = MeetRos2(options.network_interface, UriXml(CycloneUri()));
  auto node = Node::Open(options, network.xml);
  if (!node) return tl::unexpected(node.error());
  auto image = node->Hear(ImageType(options.image_is_compressed()), options.ImageTopic(),
                          SensorQos(kNewestFrames));
  if (!image) return tl::unexpected(image.error());
  std::optional<Reader> odometry;
  if (!options.odometry.empty()) {
    auto reader = node->Hear(OdometryType(), options.OdometryTopic(), SensorQos(kNewestPoses));
    if (!reader) return tl::unexpected(reader.error());
    odometry = *std::move(reader);
  }
  std::optional<Reader> scan;
  if (!options.scan.empty()) {
    auto reader = node->Hear(ScanType(), options.ScanTopic(), SensorQos(kNewestScans));
    if (!reader) return tl::unexpected(reader.error());
    scan = *std::move(reader);
  }
  std::optional<Reader> imu;
  if (!options.imu.empty()) {
    auto reader = node->Hear(ImuType(), options.ImuTopic(), SensorQos(kNewestImu));
    if (!reader) return tl::unexpected(reader.error());
    imu = *std::move(reader);
  }
  std::optional<Reader> battery;
  if (!options.battery.empty()) {
    auto reader = node->Hear(BatteryType(), options.BatteryTopic(), SensorQos(1));
    if (!reader) return tl::unexpected(reader.error());
    battery = *std::move(reader);
  }
  std::vector<Reader> ranges;
  for (std::size_t i = 0; i < options.ranges.size(); ++i) {
    auto reader = node->Hear(RangeType(), options.RangeTopic(i), SensorQos(kNewestScans));
    if (!reader) return tl::unexpected(reader.error());
    ranges.push_back(*std::move(reader));
  }
  std::optional<Reader> others_commands;
  if (options.hear_commands) {
    Qos qos = SensorQos(1);
    // This ignores the driver's own commands; the driver is no base that listens to them.
    dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
    auto reader = node->Hear(CommandType(options.command_type), options.CommandTopic(), qos);
    if (!reader) return tl::unexpected(reader.error());
    others_commands = *std::move(reader);
  }
  auto command =
      node->Speak(CommandType(options.command_type), options.CommandTopic(), ReliableQos(1));
  if (!command) return tl::unexpected(command.error());
  auto closed = ClosedParticipants::Create(node->participant);
  if (!closed) return tl::unexpected(closed.error());
  return std::make_unique<Ros2DdsDriver>(
      DriverState{options, std::move(network), *std::move(node), *std::move(image),
                  std::move(odometry), std::move(scan), std::move(ranges), std::move(imu),
                  std::move(battery), std::move(others_commands), *std::move(command)},
      *std::move(closed));
}

bool Ros2DdsDriver::Counts(Ros2Speaker& speaker, const Reader& reader,
                           const dds_sample_info_t& info) {
  if (!info.valid_data) return false;
  const std::scoped_lock lock(mutex_);
  return speaker.Hear(static_cast<std::int64_t>(info.publication_handle),
                      std::chrono::steady_clock::now(), [&](std::int64_t writer) {
                        return reader.Matches(static_cast<dds_instance_handle_t>(writer));
                      });
}

std::string Ros2DdsDriver::crowded() const {
  const std::scoped_lock lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (image_speaker_.crowded(now)) return state_.options.ImageTopic();
  return odometry_speaker_.crowded(now) ? state_.options.OdometryTopic() : std::string();
}

void Ros2DdsDriver::NoteOdometry(const Result<Ros2Odometry>& odometry,
                                 std::vector<Ros2Sensed>& sensed) {
  if (odometry) sensed.emplace_back(*odometry);
  const std::lock_guard guard(mutex_);
  if (!odometry) ++unusable_odometry_;
  unfit_odometry_ = odometry ? std::string() : odometry.error().message;
}

std::vector<Ros2Sensed> Ros2DdsDriver::Take(std::chrono::milliseconds max_wait) {
  std::vector<Ros2Sensed> sensed;
  DriverState& s = state_;
  // After a failed wait or take, the data stay for the next call.
  if (!s.node.wait_set.Wait(max_wait)) return sensed;
  if (s.odometry) {
    (void)s.odometry->Take(kMaxSamplesPerTake,
                           [&](const void* sample, const dds_sample_info_t& info) {
                             if (!Counts(odometry_speaker_, *s.odometry, info)) return;
                             NoteOdometry(OdometryFromWire(sample), sensed);
                           });
  }
  if (s.scan) {
    (void)s.scan->Take(kMaxSamplesPerTake, [&](const void* sample, const dds_sample_info_t& info) {
      if (!info.valid_data) return;
      if (auto scan = ScanFromWire(sample)) sensed.emplace_back(*std::move(scan));
    });
  }
  for (std::size_t i = 0; i < s.ranges.size(); ++i) {
    (void)s.ranges[i].Take(kMaxSamplesPerTake,
                           [&](const void* sample, const dds_sample_info_t& info) {
                             if (!info.valid_data) return;
                             if (auto range = RangeFromWire(sample, i)) sensed.emplace_back(*range);
                           });
  }
  if (s.imu) {
    (void)s.imu->Take(kMaxSamplesPerTake, [&](const void* sample, const dds_sample_info_t& info) {
      if (!info.valid_data) return;
      if (auto imu = ImuFromWire(sample)) sensed.emplace_back(*imu);
    });
  }
  if (s.battery) {
    (void)s.battery->Take(kMaxSamplesPerTake,
                          [&](const void* sample, const dds_sample_info_t& info) {
                            if (info.valid_data) sensed.emplace_back(BatteryFromWire(sample));
                          });
  }
  if (s.others_commands) {
    (void)s.others_commands->Take(
        kMaxSamplesPerTake, [&](const void* sample, const dds_sample_info_t& info) {
          if (!info.valid_data) return;
          if (auto said = CommandFromWire(sample, s.options.command_type)) {
            sensed.emplace_back(*said);
          }
        });
  }
  (void)s.image.Take(kMaxSamplesPerTake, [&](const void* sample, const dds_sample_info_t& info) {
    if (Counts(image_speaker_, s.image, info)) {
      sensed.push_back(ImageFromWire(sample, s.options.image_is_compressed()));
    }
  });
  return sensed;
}

Result<void> Ros2DdsDriver::Publish(const Ros2Command& command) {
  return WithRos2Wire(command, state_.options.command_type,
                      [&](const void* sample) { return state_.command.Write(sample); });
}

Ros2Driver::Peers Ros2DdsDriver::peers() const {
  const DriverState& s = state_;
  Peers peers;
  peers.tried = s.network.tried;
  peers.cameras = s.image.matched();
  peers.bases = s.command.matched();
  std::vector<std::string> mismatches{
      Mismatch(s.options.ImageTopic(), s.image.refused_policy()),
      Mismatch(s.options.CommandTopic(), s.command.refused_policy())};
  const std::lock_guard guard(mutex_);
  peers.closed = closed_.Look();
  if (s.odometry) {
    peers.odometers = s.odometry->matched();
    peers.unusable_odometry = unusable_odometry_;
    peers.unfit_odometry = unfit_odometry_;
    mismatches.push_back(Mismatch(s.options.OdometryTopic(), s.odometry->refused_policy()));
  }
  if (s.scan) {
    peers.scanners = s.scan->matched();
    mismatches.push_back(Mismatch(s.options.ScanTopic(), s.scan->refused_policy()));
  }
  for (std::size_t i = 0; i < s.ranges.size(); ++i) {
    peers.rangers.push_back(s.ranges[i].matched());
    mismatches.push_back(Mismatch(s.options.RangeTopic(i), s.ranges[i].refused_policy()));
  }
  if (s.imu) {
    peers.imus = s.imu->matched();
    mismatches.push_back(Mismatch(s.options.ImuTopic(), s.imu->refused_policy()));
  }
  if (s.battery) {
    peers.batteries = s.battery->matched();
    mismatches.push_back(Mismatch(s.options.BatteryTopic(), s.battery->refused_policy()));
  }
  std::erase(mismatches, std::string());
  peers.mismatch = fmt::format("{}", fmt::join(mismatches, ", "));
  return peers;
}

struct Ros2Robot::State {
  Ros2Options options;
  Node node;
  Reader command;
  Writer image;
  Writer odometry;
  std::optional<Writer> scan;
  std::vector<Writer> ranges;
  std::optional<Writer> imu;
  std::optional<Writer> battery;
};

Ros2Robot::Ros2Robot(std::unique_ptr<State> state) : state_(std::move(state)) {}
Ros2Robot::~Ros2Robot() = default;

Result<std::unique_ptr<Ros2Robot>> Ros2Robot::Open(const Ros2Options& options) {
  if (options.image_is_compressed() || options.odometry.empty()) {
    return Fail(ErrorCode::kInvalidArgument,
                "a virtual robot publishes plain images, and odometry");
  }
  auto node = Node::Open(options);
  if (!node) return tl::unexpected(node.error());
  auto command =
      node->Hear(CommandType(options.command_type), options.CommandTopic(), ReliableQos(1));
  if (!command) return tl::unexpected(command.error());
  auto image = node->Speak(ImageType(false), options.ImageTopic(), ReliableQos(kNewestFrames));
  if (!image) return tl::unexpected(image.error());
  auto odometry = node->Speak(OdometryType(), options.OdometryTopic(), ReliableQos(kNewestPoses));
  if (!odometry) return tl::unexpected(odometry.error());
  std::optional<Writer> scan;
  if (!options.scan.empty()) {
    // ROS 2's drivers of scanners offer this QoS.
    auto writer = node->Speak(ScanType(), options.ScanTopic(), SensorQos(kNewestScans));
    if (!writer) return tl::unexpected(writer.error());
    scan = *std::move(writer);
  }
  std::optional<Writer> imu;
  if (!options.imu.empty()) {
    auto writer = node->Speak(ImuType(), options.ImuTopic(), SensorQos(kNewestImu));
    if (!writer) return tl::unexpected(writer.error());
    imu = *std::move(writer);
  }
  std::optional<Writer> battery;
  if (!options.battery.empty()) {
    auto writer = node->Speak(BatteryType(), options.BatteryTopic(), SensorQos(1));
    if (!writer) return tl::unexpected(writer.error());
    battery = *std::move(writer);
  }
  std::vector<Writer> ranges;
  for (std::size_t i = 0; i < options.ranges.size(); ++i) {
    auto writer = node->Speak(RangeType(), options.RangeTopic(i), SensorQos(kNewestScans));
    if (!writer) return tl::unexpected(writer.error());
    ranges.push_back(*std::move(writer));
  }
  return std::unique_ptr<Ros2Robot>(new Ros2Robot(std::unique_ptr<State>(new State{
      options, *std::move(node), *std::move(command), *std::move(image), *std::move(odometry),
      std::move(scan), std::move(ranges), std::move(imu), std::move(battery)})));
}

Result<void> Ros2Robot::Publish(const Ros2Image& image) {
  return WithRos2Wire(image, [&](const void* sample) { return state_->image.Write(sample); });
}

Result<void> Ros2Robot::Publish(const Ros2Odometry& odometry) {
  return WithRos2Wire(odometry, [&](const void* sample) { return state_->odometry.Write(sample); });
}

Result<void> Ros2Robot::Publish(const Ros2Scan& scan) {
  if (!state_->scan) return Fail(ErrorCode::kInvalidArgument, "the robot has no scan topic");
  return WithRos2Wire(scan, [&](const void* sample) { return state_->scan->Write(sample); });
}

Result<void> Ros2Robot::Publish(const Ros2Range& range) {
  std::vector<Writer>& ranges = state_->ranges;
  if (range.sensor >= ranges.size()) {
    return Fail(ErrorCode::kInvalidArgument, "the robot has no such range topic");
  }
  return WithRos2Wire(range,
                      [&](const void* sample) { return ranges[range.sensor].Write(sample); });
}

Result<void> Ros2Robot::Publish(const Ros2Imu& imu) {
  if (!state_->imu) return Fail(ErrorCode::kInvalidArgument, "the robot has no IMU topic");
  return WithRos2Wire(imu, [&](const void* sample) { return state_->imu->Write(sample); });
}

Result<void> Ros2Robot::Publish(const Ros2Battery& battery) {
  if (!state_->battery) return Fail(ErrorCode::kInvalidArgument, "the robot has no battery topic");
  return WithRos2Wire(battery, [&](const void* sample) { return state_->battery->Write(sample); });
}

std::optional<Ros2Command> Ros2Robot::Take(std::chrono::milliseconds max_wait) {
  std::optional<Ros2Command> latest;
  State& s = *state_;
  if (!s.node.wait_set.Wait(max_wait)) return latest;
  (void)s.command.Take(kMaxSamplesPerTake, [&](const void* sample, const dds_sample_info_t& info) {
    if (!info.valid_data) return;
    if (auto command = CommandFromWire(sample, s.options.command_type)) latest = command;
  });
  return latest;
}

bool Ros2Robot::watched() const { return state_->image.matched() > 0; }

bool Ros2Robot::scan_is_heard() const { return state_->scan && state_->scan->matched() > 0; }

bool Ros2Robot::range_is_heard(std::size_t sensor) const {
  return sensor < state_->ranges.size() && state_->ranges[sensor].matched() > 0;
}

bool Ros2Robot::imu_is_heard() const { return state_->imu && state_->imu->matched() > 0; }

}  // namespace trailcast::dds
