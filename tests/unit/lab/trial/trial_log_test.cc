#include "services/lab/trial/src/trial_log.h"

#include <gtest/gtest.h>

namespace trailcast::trial {
namespace {

TrialSetup SetupOf(const std::string& scenario) {
  TrialSetup setup;
  setup.scenario = scenario;
  return setup;
}

TrialCase CaseOf(const std::string& scout_camera, const std::string& follower_camera,
                 double push_m) {
  TrialCase trial_case;
  trial_case.method = agent::ReplayMethod::kPaper;
  trial_case.scout_camera.name = scout_camera;
  trial_case.follower_camera.name = follower_camera;
  trial_case.push_m = push_m;
  return trial_case;
}

TEST(TrialLogName, SaysWhatTheTrialWas) {
  const TrialSetup setup = SetupOf("indoor");
  EXPECT_EQ(TrialLogName(setup, CaseOf("webcam", "wide", 0.0), 3),
            "indoor-paper-webcam-wide-trial3.mcap");
  EXPECT_EQ(TrialLogName(setup, CaseOf("webcam", "wide", -0.5), 3),
            "indoor-paper-webcam-wide-push-0.5-trial3.mcap");
  TrialCase served = CaseOf("webcam", "wide", 0.0);
  served.through_server = true;
  EXPECT_EQ(TrialLogName(setup, served, 3), "indoor-paper-webcam-wide-served-trial3.mcap");
  TrialSetup same = setup;
  same.same_robot = true;
  EXPECT_EQ(TrialLogName(same, CaseOf("webcam", "webcam", 0.0), 3),
            "indoor-paper-webcam-webcam-same-trial3.mcap");
}

TEST(TrialLogName, StaysInItsFolderWhateverThingsAreCalled) {
  EXPECT_EQ(TrialLogName(SetupOf("../my shop"), CaseOf("a/b", "c", 0.0), 1),
            ".._my_shop-paper-a_b-c-trial1.mcap");
}

}  // namespace
}  // namespace trailcast::trial
