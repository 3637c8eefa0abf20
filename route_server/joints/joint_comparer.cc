#include "route_server/joints/joint_comparer.h"

#include <chrono>
#include <utility>

#include "services/base/cpu_time.h"
#include "services/base/give_way.h"

namespace trailcast::server {

JointComparer::JointComparer() : thread_([this] { Run(); }) {}

JointComparer::~JointComparer() {
  ending_ = true;
  bell_.Ring();
  thread_.join();
}

std::optional<std::uint64_t> JointComparer::TryPut(Views a, Views b, bool same_camera) {
  const std::uint64_t number = jobs_put_ + 1;
  if (!jobs_.TryPut({number, std::move(a), std::move(b), same_camera})) return std::nullopt;
  bell_.Ring();
  jobs_put_ = number;
  return number;
}

void JointComparer::Run() {
  constexpr int kNiceness = 10;
  constexpr std::chrono::milliseconds kLookEvery{1000};
  GiveWay(kNiceness);
  while (!ending_) {
    const auto job = jobs_.TryGet();
    if (!job) {
      bell_.Wait(kLookEvery);
      continue;
    }
    // Nobody has put in more than this holds without taking some out.
    (void)done_.TryPut(Compare(*job));
  }
}

JointComparer::Done JointComparer::Compare(const Job& job) const {
  Done done{.number = job.number};
  const double until_ms = ThreadCpuMs() + kMost_ms;
  joints::JointOptions options;
  options.give_up = [&] {
    done.gave_up = ending_ || ThreadCpuMs() > until_ms;
    return done.gave_up;
  };
  done.joints = job.b ? joints::FindJoints(*job.a, *job.b, job.same_camera, options)
                      : joints::FindLoops(*job.a, options);
  return done;
}

}  // namespace trailcast::server
