#include "services/program/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

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
