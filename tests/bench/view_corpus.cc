#include "tests/bench/view_corpus.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "agent/session/replay_session.h"
#include "agent/session/teach_session.h"
#include "services/image/files.h"
#include "services/lab/sim/core/judge.h"
#include "services/lab/sim/core/path_follow_driver.h"
#include "services/lab/sim/core/random.h"
#include "services/lab/sim/core/simulated_robot.h"
#include "services/lab/sim/places/place.h"
#include "services/vision/view_features.h"
#include "tests/bench/must.h"

namespace trailcast::bench {
namespace {

constexpr double kFrames_hz = 15.0;

// One frame of a teaching: which segment was under way, and where the scout was.
struct Moment {
  SegmentIndex segment;
  motion::Pose2 pose;
};

struct Taught {
  Walk walk;
  std::vector<Moment> moments;
};

class Teacher {
 public:
  explicit Teacher(std::string name) { taught_.walk.name = std::move(name); }

  void See(const agent::Observation& seen, const motion::Pose2& pose) {
    Keep(Must(session_.Observe(seen)).finished);
    taught_.moments.push_back(
        {SegmentIndex(static_cast<std::uint32_t>(taught_.walk.segments.size())), pose});
  }
  Taught Finish() {
    Keep(session_.Finish());
    return std::move(taught_);
  }

 private:
  void Keep(std::optional<route::Segment> segment) {
    if (segment) taught_.walk.segments.push_back(std::move(*segment));
  }

  agent::TeachSession session_;
  Taught taught_;
};

// ---- simulated

sim::Place Open(const std::string& name) {
  sim::PlaceOptions options;
  options.world = name;
  return Must(sim::OpenPlace(options));
}

std::unique_ptr<sim::SimulatedRobot> Robot(const sim::Place& place, const std::string& camera,
                                           std::uint64_t seed, bool scout) {
  sim::SimulatedRobotOptions options;
  options.camera = Must(sim::FindCamera(camera));
  options.start = sim::StartPose(place.path.points);
  options.start_z_max_m = place.path.z_max_m;
  options.rate_hz = kFrames_hz;
  options.seed = seed;
  if (scout) {
    options.disturbances = sim::Disturbances::ForScout();
  } else {
    options.lighting = sim::WithMovedSun(place.world->lighting(), seed);
  }
  return Must(sim::SimulatedRobot::Create(place.world, options));
}

Taught TeachIn(const std::string& name, const sim::Place& place) {
  const auto robot = Robot(place, "webcam", 1, true);
  sim::Judge truth(*robot);
  sim::DriverOptions driving;
  driving.speed_mps = place.speed_mps;
  sim::PathFollowDriver driver(place.path.points, driving);
  Teacher teacher(name);
  for (motion::VelocityCommand command; !driver.arrived();
       command = driver.Command(truth.true_pose())) {
    sim::Observation seen = robot->Step(command);
    teacher.See({seen.stamp, std::move(seen.image), seen.odometry}, truth.true_pose());
  }
  return teacher.Finish();
}

route::View LookFrom(sim::SimulatedRobot& robot, const motion::Pose2& pose) {
  sim::Judge truth(robot);
  truth.Shove(motion::Between(truth.true_pose(), pose));
  return vision::DescribeForQuery(robot.Step({}).image);
}

// Another robot, under another sun, beside the path and turned a little.
void SeeAnew(const sim::Place& place, const Taught& taught, const std::string& camera,
             const std::string& set, std::uint32_t walk, Corpus& corpus) {
  constexpr std::size_t kEvery = 12;  // frames
  sim::Random random(7, set);
  const auto robot = Robot(place, camera, 2, false);
  for (std::size_t i = 0; i < taught.moments.size(); i += kEvery) {
    const Moment& moment = taught.moments[i];
    const motion::Pose2 aside{0.0, random.Uniform(-0.15, 0.15), 0.06 * random.Normal()};
    corpus.held.push_back(
        {set, walk, moment.segment, LookFrom(*robot, motion::Compose(moment.pose, aside))});
  }
}

// A view as a segment.
route::Segment AsSegment(const route::View& view) {
  constexpr std::size_t kStored = 60;
  route::Segment segment;
  segment.has_odometry = true;
  segment.length_m = 1.0;
  segment.key_views.push_back({0.0, view});
  route::View& features = segment.key_views.back().features;
  features.resize(std::min(features.size(), kStored));
  return segment;
}

// Along the path and up to three metres aside, looking at least 60 degrees away from it.
std::vector<route::View> LookElsewhere(const std::string& name, const sim::Place& place,
                                       int count) {
  sim::Random random(11, name);
  const auto robot = Robot(place, "webcam", 3, true);
  const double length_m = sim::Length(place.path.points);
  std::vector<route::View> views;
  for (int i = 0; i < count; ++i) {
    const double along_m = random.Uniform(0.0, length_m - 0.5);
    const Eigen::Vector2d at = sim::PointAlong(place.path.points, along_m);
    const Eigen::Vector2d ahead = sim::PointAlong(place.path.points, along_m + 0.3) - at;
    const motion::Pose2 on_path{at.x(), at.y(), std::atan2(ahead.y(), ahead.x())};
    const motion::Pose2 aside{0.0, random.Uniform(-3.0, 3.0), random.Uniform(1.05, 5.23)};
    views.push_back(LookFrom(*robot, motion::Compose(on_path, aside)));
  }
  return views;
}

void AddSimulated(Corpus& corpus) {
  for (const char* name : {"indoor", "desks", "turns", "corridor", "rough", "paved"}) {
    std::cerr << "teaching in " << name << '\n';
    const sim::Place place = Open(name);
    Taught taught = TeachIn(name, place);
    const auto walk = static_cast<std::uint32_t>(corpus.walks.size());
    SeeAnew(place, taught, "webcam", fmt::format("sim {}", name), walk, corpus);
    for (const char* camera : {"firewire", "hd", "wide", "fisheye", "omni"}) {
      SeeAnew(place, taught, camera, fmt::format("sim {} by {}", name, camera), walk, corpus);
    }
    corpus.walks.push_back(std::move(taught.walk));
    for (const route::View& view : LookElsewhere(name, place, 300)) {
      if (view.size() >= 12) corpus.elsewhere.push_back(AsSegment(view));
    }
  }
  for (const char* name : {"road", "ramp"}) {
    for (route::View& view : LookElsewhere(name, Open(name), 200)) {
      corpus.strangers.push_back({name, 0, SegmentIndex(0), std::move(view)});
    }
  }
}

// ---- recorded

std::vector<image::GrayImage> Frames(const std::filesystem::path& folder) {
  const auto sequence = Must(image::FrameSequence::Open(folder));
  std::vector<image::GrayImage> frames;
  while (auto frame = Must(sequence->Next())) frames.push_back(std::move(*frame));
  return frames;
}

SensorTime StampOf(std::size_t frame) {
  return SensorTime(static_cast<std::int64_t>(1e9 * static_cast<double>(frame) / 30.0));
}

Taught TeachFrom(const std::string& name, const std::vector<image::GrayImage>& frames) {
  Teacher teacher(name);
  for (std::size_t i = 0; i < frames.size(); ++i) teacher.See({StampOf(i), frames[i], {}}, {});
  return teacher.Finish();
}

// Where that was, a replay says that follows the route frame by frame; where it is not sure,
// nothing.
void SeeByReplay(const Walk& taught, const std::vector<image::GrayImage>& frames,
                 const std::string& set, std::uint32_t walk, Corpus& corpus) {
  constexpr std::size_t kEvery = 5;
  route::RouteInfo info;
  info.image_width_px = frames.front().width;
  info.image_height_px = frames.front().height;
  agent::ReplaySession session({}, info);
  for (const route::Segment& segment : taught.segments) {
    if (!session.AddSegment(segment)) std::abort();
  }
  session.MarkComplete();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const agent::ReplayStep step = Must(session.Observe({StampOf(i), frames[i], {}}));
    if (step.state == agent::ReplayState::kLost) break;
    const bool sure = step.state == agent::ReplayState::kFollowing && step.features >= 10;
    if (!sure || i % kEvery != 0) continue;
    corpus.held.push_back({set, walk, step.segment, vision::DescribeForQuery(frames[i])});
  }
}

void AddRecorded(const std::filesystem::path& data, Corpus& corpus) {
  const auto next = [&] { return static_cast<std::uint32_t>(corpus.walks.size()); };
  if (!std::filesystem::exists(data)) {
    std::cerr << "no recorded runs in " << data << ": left out\n";
    return;
  }
  for (const auto& [folder, first, later] :
       {std::tuple("donkey_track", "teach", std::vector{"replay"}),
        std::tuple("patio_laps", "lap0", std::vector{"lap1", "lap2", "lap3"})}) {
    Taught taught = TeachFrom(folder, Frames(data / folder / first));
    for (const char* run : later) {
      SeeByReplay(taught.walk, Frames(data / folder / run), fmt::format("{} {}", folder, run),
                  next(), corpus);
    }
    taught.walk.is_lap = true;
    corpus.walks.push_back(std::move(taught.walk));
  }
  // Walked twice, frame by frame alike.
  Taught taught = TeachFrom("corridor_offset", Frames(data / "corridor_offset" / "ref"));
  const auto query = Frames(data / "corridor_offset" / "query");
  for (std::size_t i = 0; i < std::min(query.size(), taught.moments.size()); ++i) {
    corpus.held.push_back(
        {"corridor_offset", next(), taught.moments[i].segment, vision::DescribeForQuery(query[i])});
  }
  corpus.walks.push_back(std::move(taught.walk));
}

}  // namespace

Corpus MakeCorpus(const std::filesystem::path& data) {
  Corpus corpus;
  AddRecorded(data, corpus);
  AddSimulated(corpus);
  return corpus;
}

}  // namespace trailcast::bench
