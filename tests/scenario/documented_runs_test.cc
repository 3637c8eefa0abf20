// Commands that documents show do what they say: they are typed as they stand there, each page's in
// a fresh folder that holds two drives.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "tests/scenario/programs.h"
#include "tests/support/documents.h"

namespace trailcast::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

// The lines of shell below a heading, without comments. All headings count if it is empty.
std::vector<std::string> ShellBelow(const Document& page, const std::string& heading) {
  std::vector<std::string> lines;
  bool below = heading.empty();
  for (const DocumentLine& line : page.lines) {
    if (line.kind == LineKind::kHeading && !heading.empty()) below = line.text.ends_with(heading);
    if (!below || line.kind != LineKind::kCode) continue;
    if (line.text.starts_with('#')) continue;
    std::string text = line.text.substr(0, line.text.find(" #"));
    text.erase(text.find_last_not_of(' ') + 1);
    if (!text.empty()) lines.push_back(std::move(text));
  }
  return lines;
}

Document PageAt(const std::string& path) {
  std::ifstream in(fs::path(SourceDir()) / path);
  return ReadDocument(path, in);
}

class DocumentedRuns : public ProgramsTest {
 protected:
  // To judge recordings takes some seconds, and minutes on a machine that is busy.
  static constexpr std::chrono::seconds kTyped{200};

  void WriteDrives() {
    WriteWalk(folder_ / "drive1", kTaughtFrames);
    WriteWalk(folder_ / "drive2", kFollowerFrames);
    fs::copy_file(folder_ / "drive1" / "00060.png", folder_ / "now.png");
  }

  // Types each line and waits for its end. One that ends with '&' goes on until the test is over.
  void Type(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) {
      SCOPED_TRACE(line);
      if (line.starts_with("export ")) {
        exported_ += line + "; ";
        continue;
      }
      const bool goes_on = line.ends_with(" &");
      auto process = Shell(goes_on ? "exec " + line.substr(0, line.size() - 2) : line);
      if (goes_on) {
        ASSERT_TRUE(process->WaitForOutput("ready")) << process->output();
        running_.push_back(std::move(process));
      } else {
        const auto status = process->Wait(kTyped);
        ASSERT_EQ(status.value_or(-1), 0) << process->output();
      }
    }
  }

  // A page's "other site" is a network of this test's own, too.
  std::unique_ptr<Process> Shell(std::string line) {
    const std::size_t other = line.find("other-site");
    if (other != std::string::npos) line.replace(other, 10, OtherTag());
    const std::string script = "cd '" + folder_.path().string() + "'; PATH='" + ProgramsDir() +
                               "':\"$PATH\"; export TRAILCAST_NETWORK_INTERFACE=lo " +
                               "TRAILCAST_DDS_TAG=" + tag_ + "; " + exported_ + line;
    return std::make_unique<Process>(std::vector<std::string>{"/bin/bash", "-c", script},
                                     Path("typed" + std::to_string(++typed_) + ".log"));
  }
  [[nodiscard]] std::string OtherTag() const { return tag_ + "-other"; }
  [[nodiscard]] bool Has(const std::string& file) const { return fs::exists(folder_ / file); }

 private:
  std::string exported_;
  int typed_ = 0;
  std::vector<std::unique_ptr<Process>> running_;
};

TEST_F(DocumentedRuns, TheReadmeTeachesAndFollowsWithPicturesOfOnesOwn) {
  WriteDrives();
  const auto lines = ShellBelow(PageAt("README.md"), "Teach and follow with your own pictures");
  ASSERT_THAT(lines, SizeIs(3));
  Type(lines);
  EXPECT_TRUE(Has("turns.csv"));
  EXPECT_TRUE(Has("run.png"));
}

TEST_F(DocumentedRuns, TheFirstRouteIsTaughtFollowedSharedAndJudged) {
  WriteDrives();
  std::vector<std::string> lines = ShellBelow(PageAt("docs/tutorials/first-route.md"), "");
  // Trials are tests of their own, and one here has a world of the reader's own.
  lines.erase(std::remove_if(lines.begin(), lines.end(),
                             [](const auto& line) { return line.starts_with("trailcast trial"); }),
              lines.end());
  ASSERT_THAT(lines, SizeIs(13));
  const auto other_server = Shell("exec trailcast-server --store other.db --dds-tag other-site");
  ASSERT_TRUE(other_server->WaitForOutput("ready")) << other_server->output();
  Type(lines);
  EXPECT_TRUE(Has("hall.trailcast"));
  EXPECT_TRUE(Has("judged.png"));
}

TEST_F(DocumentedRuns, ARunIsExplained) {
  WriteDrives();
  Type({"trailcast-agent teach --frames drive1/ --route hall --store scout.db"});
  const auto lines = ShellBelow(PageAt("docs/how-to/explain.md"), "");
  ASSERT_THAT(lines, SizeIs(3));
  Type(lines);
  EXPECT_TRUE(Has("seen"));
}

TEST_F(DocumentedRuns, AFleetGetsKeysAndAStolenOneIsRevoked) {
  const Document page = PageAt("docs/tutorials/keys.md");
  for (const char* heading : {"The authority", "A member each", "One is stolen"}) {
    const auto lines = ShellBelow(page, heading);
    ASSERT_FALSE(lines.empty()) << heading;
    Type(lines);
  }
  EXPECT_TRUE(Has("fleet/members/server/identity.pem"));
  EXPECT_TRUE(Has("fleet/revoked.pem"));
}

TEST_F(DocumentedRuns, RobotsAreSentAtSetTimes) {
  std::vector<std::string> lines = ShellBelow(PageAt("docs/how-to/schedules.md"), "");
  ASSERT_THAT(lines, SizeIs(10));
  for (std::string& line : lines) {
    // No robot is here.
    const bool names_robots = line.find("schedule add") != std::string::npos ||
                              line.find("schedule change") != std::string::npos;
    if (names_robots) line += " --unheard";
  }
  const auto server = Shell("exec trailcast-server --store server.db");
  ASSERT_TRUE(server->WaitForOutput("ready")) << server->output();
  Type(lines);
}

TEST_F(DocumentedRuns, LinesBelowAHeadingAreFound) {
  std::istringstream text("# One\n\n    a  # why\n\n# Two\n\ntext\n\n    b &\n    # c\n");
  const Document page = ReadDocument("page.md", text);
  EXPECT_THAT(ShellBelow(page, "Two"), ElementsAre("b &"));
  EXPECT_THAT(ShellBelow(page, ""), ElementsAre("a", "b &"));
  EXPECT_THAT(ShellBelow(page, "Three"), IsEmpty());
}

}  // namespace
}  // namespace trailcast::test
