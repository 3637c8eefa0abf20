// These test photos that robots take on missions, from the order to the operator's folder.
#include <fstream>

#include "tests/scenario/robots.h"

namespace trailcast::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

class PhotosTest : public RobotsTest {
 protected:
  void SetUp() override {
    Teach();
    most_mps_ = kUnwatched_mps;
    server_ = Server();
    robot_ = Robot("robot1", {});
    agent_ = Serve("robot1");
    ASSERT_TRUE(agent_->WaitForOutput("available as 'robot1'")) << agent_->output();
  }
  Ended Tool(const Words& words) {
    return End(*Start("trailcast", words, "tool" + std::to_string(++tools_)));
  }
  // Waits until the server has so many photos, and returns what the tool says of them.
  std::string Listed(const std::string& text, const Words& narrower = {}) {
    std::string listed;
    EXPECT_TRUE(WaitUntil([&] {
      listed = Tool(With({"photos"}, narrower)).output;
      return listed.find(text) != std::string::npos;
    })) << listed
        << agent_->output();
    return listed;
  }
  int JpegsIn(const std::string& folder) {
    int count = 0;
    for (const auto& entry : fs::directory_iterator(Path(folder))) {
      if (entry.path().extension() == ".jpg") ++count;
    }
    return count;
  }

  std::unique_ptr<Process> server_;
  std::unique_ptr<Process> robot_;
  std::unique_ptr<Process> agent_;
  int tools_ = 0;
};

TEST_F(PhotosTest, OfARoundAreTakenAtTheirPlacesAndFetchedWithATable) {
  ASSERT_EQ(Tool({"network", "name", "shelf", "hall@1.2"}).status, 0);
  const Ended sent = Tool({"send", "robot1", "follow", "hall", "..2.5", "--id", "first",
                           "--photo-every", "1", "--photo-at", "shelf", "--wait"});
  EXPECT_EQ(sent.status, 0) << sent.output << agent_->output();
  EXPECT_THAT(sent.output, HasSubstr("arrived: 4 photos"));
  EXPECT_THAT(Listed("hall@2 ", {"--mission", "first"}),
              AllOf(HasSubstr("hall@0 "), HasSubstr("hall@1 "), HasSubstr("shelf ")));
  EXPECT_TRUE(WaitUntil([&] { return JpegsIn("routes.db.robot1.photos") == 0; }))
      << "what the server has, the robot need not keep";
  const Ended fetched = Tool({"photos", "--mission", "first", "--to", Path("round")});
  EXPECT_EQ(fetched.status, 0) << fetched.output;
  EXPECT_EQ(JpegsIn("round"), 4);
  std::ifstream table(Path("round") + "/photos.csv");
  const std::string rows{std::istreambuf_iterator<char>(table), {}};
  EXPECT_THAT(rows, HasSubstr(",robot1,first,hall,1,shelf,1.20,"));

  // A round back, in reverse gear, sees the same shelf from nearly the same place.
  const Ended back = Tool({"send", "robot1", "photo", "at", "shelf=hall@1.2", "follow", "hall",
                           "backwards", "..0.5", "--id", "second", "--wait"});
  EXPECT_EQ(back.status, 0) << back.output << agent_->output();
  (void)Listed("second", {"--place", "shelf"});
  const Ended compared = Tool({"photos", "--place", "shelf", "--compare"});
  EXPECT_EQ(compared.status, 0) << compared.output;
  EXPECT_THAT(compared.output, HasSubstr("of shelf, compared with"));
}

TEST_F(PhotosTest, OfARobotWithoutAServerAndOfAnEndedMissionAreKept) {
  server_->Signal(SIGKILL);
  (void)End(*server_);
  const Ended sent = Tool({"send", "robot1", "photo", "every", "0.5", "follow", "hall", "..2.5",
                           "wait", "600", "--id", "first", "--unheard"});
  EXPECT_EQ(sent.status, 0) << sent.output << agent_->output();
  ASSERT_TRUE(WaitUntil([&] { return JpegsIn("routes.db.robot1.photos") >= 5; }))
      << agent_->output();
  const Ended cancelled = Tool({"cancel", "robot1"});
  EXPECT_EQ(cancelled.status, 0) << cancelled.output;
  ASSERT_TRUE(agent_->WaitForOutput("cancelled by an operator; ")) << agent_->output();
  EXPECT_THAT(agent_->output(), HasSubstr(" photos"));
  server_ = Server("server.db", "server2");
  EXPECT_THAT(Listed("hall@2.5"), AllOf(HasSubstr("hall@0.5"), HasSubstr("first")));
}

TEST_F(PhotosTest, ThatCannotBeAreRefusedInWords) {
  const Ended unknown = Tool({"send", "robot1", "follow", "hall", "--photo-at", "attic"});
  EXPECT_EQ(unknown.status, 1) << unknown.output;
  EXPECT_THAT(unknown.output, HasSubstr("no place is called 'attic'"));
  EXPECT_EQ(Tool({"send", "robot1", "photo", "follow", "hall"}).status, 2);
  EXPECT_EQ(Tool({"photos", "--place", "hall@"}).status, 2);
  const Ended none = Tool({"photos", "--compare"});
  EXPECT_EQ(none.status, 4) << none.output;
  EXPECT_THAT(none.output, HasSubstr("from two missions"));
}

}  // namespace
}  // namespace trailcast::test
