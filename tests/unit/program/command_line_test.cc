#include "services/program/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/temp_dir.h"

namespace trailcast::program {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// A program with a command, which has options of its own group besides.
struct HelpfulProgram {
  HelpfulProgram() {
    AddCommonOptions(app, common);
    app.add_option("--store", store, "Where routes are kept");
    command = app.add_subcommand("replay", "Follow a route");
    command->add_option("--route", route, "Which route it follows");
    command->add_option("--camera-roll", roll, "How the camera is turned")->group("Camera");
  }
  std::string Told(const char* flag) {
    try {
      app.parse(std::string("replay ") + flag);
    } catch (const CLI::Success& shown) {
      std::ostringstream out;
      app.exit(shown, out, out);
      return out.str();
    }
    return "no help";
  }

  CommonOptions common;
  std::string store;
  std::string route;
  double roll = 0.0;
  CLI::App app{"A program", "program"};
  CLI::App* command = nullptr;
};

TEST(Help, ExplainsWhatAFirstUserNeedsAndNamesTheRest) {
  EXPECT_THAT(HelpfulProgram().Told("--help"),
              AllOf(HasSubstr("Which route it follows"), HasSubstr("Where routes are kept"),
                    HasSubstr("\n  Camera: --camera-roll\n"), HasSubstr("\n  Network: --domain "),
                    Not(HasSubstr("How the camera is turned")), Not(HasSubstr("DDS domain"))));
}

TEST(Help, ExplainsAllOptionsWhenAskedTo) {
  EXPECT_THAT(HelpfulProgram().Told("--help-all"),
              AllOf(HasSubstr("Which route it follows"), HasSubstr("Where routes are kept"),
                    HasSubstr("How the camera is turned"), HasSubstr("DDS domain"),
                    Not(HasSubstr("More options"))));
}

class RefusedTest : public testing::Test {
 protected:
  RefusedTest() {
    AddCommonOptions(program_.app, program_.common);
    program_.app.add_option("--within", within_)->check(CLI::PositiveNumber);
    CLI::App* command = program_.app.add_subcommand("drive");
    command->add_option("--speed", speed_)->check(CLI::Range(0.1, 3.0));
  }
  // Returns what is said of a command line, with --config if `config` has anything.
  std::string Told(std::vector<std::string> words, const std::string& config = "") {
    const test::TempDir folder;
    if (!config.empty()) {
      std::ofstream(folder / "c.toml") << config;
      words.insert(words.begin(), {"--config", (folder / "c.toml").string()});
    }
    std::vector<char*> argv{program_name_.data()};
    for (std::string& word : words) argv.push_back(word.data());
    testing::internal::CaptureStderr();
    const auto status = Parse(program_.app, static_cast<int>(argv.size()), argv.data());
    std::string said = testing::internal::GetCapturedStderr();
    EXPECT_EQ(status.has_value(), !said.empty());
    return said;
  }

  struct {
    CommonOptions common;
    CLI::App app{"A program", "program"};
  } program_;
  std::string program_name_ = "program";
  double within_ = 1.0;
  double speed_ = 1.0;
};

TEST_F(RefusedTest, WhatIsNoNumber) {
  for (const char* text : {"nan", "NaN", "-nan", "nan(1)", "inf"}) {
    EXPECT_THAT(Told({"drive", "--speed", text}), HasSubstr("--speed")) << text;
    EXPECT_THAT(Told({"--within", text, "drive"}), HasSubstr("--within")) << text;
    EXPECT_THAT(Told({"drive"}, fmt::format("[drive]\nspeed = {}\n", text)), HasSubstr("--speed"))
        << text;
  }
  EXPECT_EQ(Told({"--within", "2e3", "drive", "--speed", "0.5"}), "");
  EXPECT_EQ(speed_, 0.5);
}

TEST_F(RefusedTest, WhatIsMistypedOrWasCalledSoOnceIsAnsweredByItsName) {
  EXPECT_THAT(Told({"drivee"}), HasSubstr("not understood: drivee; did you mean 'drive'?"));
  EXPECT_THAT(Told({"reverse"}), Not(HasSubstr("did you mean")));
  EXPECT_THAT(Told({"glance", "robot1"}), Not(HasSubstr("did you mean")));
  program_.app.add_subcommand("snapshot");
  EXPECT_THAT(Told({"glance", "robot1"}),
              HasSubstr("not understood: glance robot1; did you mean 'snapshot'?"));
  EXPECT_THAT(Told({"drive", "drivee"}), Not(HasSubstr("did you mean"))) << "it has a command";
  EXPECT_THAT(Told({"drive", "--sped=1"}), HasSubstr("; did you mean '--speed'?"));
}

TEST_F(RefusedTest, SectionsAndKeysThatAreNotKnownByName) {
  EXPECT_THAT(Told({"drive"}, "[drvie]\nspeed = 1\n"),
              AllOf(HasSubstr("section '[drvie]'"), HasSubstr("in [drive]: ")));
  EXPECT_THAT(Told({"drive"}, "[drive]\nspede = 1\n"), HasSubstr("key 'drive.spede'"));
  EXPECT_LT(Told({"drive"}, std::string(100'000, 'a') + " = 1\n").size(), 2000U);
}

TEST(WithRevision, TakesItFromEitherPlace) {
  EXPECT_EQ(WithRevision("hall", 0)->revision, 0U);
  EXPECT_EQ(WithRevision("hall", 3)->revision, 3U);
  EXPECT_EQ(WithRevision("hall@3", 0)->revision, 3U);
  EXPECT_EQ(WithRevision("hall@3", 3)->route, "hall");
}

TEST(WithRevision, RefusesTwoThatDiffer) {
  const auto both = WithRevision("hall@3", 2);
  ASSERT_FALSE(both);
  EXPECT_THAT(both.error().message, HasSubstr("'hall@3' is revision 3, and --revision says 2"));
}

}  // namespace
}  // namespace trailcast::program
