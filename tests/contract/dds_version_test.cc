// Programs of two versions of the protocol that meet say so, in words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "services/dds/src/domain/domain_config.h"
#include "services/dds/src/domain/user_data.h"
#include "services/dds/src/entities.h"
#include "tests/contract/network.h"
#include "tests/support/await.h"

namespace trailcast::dds {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;
using Clock = std::chrono::steady_clock;

class Program {
 public:
  explicit Program(DdsOptions options) {
    options.tell_of_version = [this](const std::string& line) { told_.push_back(line); };
    exchange_ = OpenDdsExchange(options, test::EveryTopic()).value();
  }
  void Live() { (void)exchange_->Take(milliseconds(20)); }
  [[nodiscard]] const std::vector<std::string>& told() const { return told_; }

 private:
  std::vector<std::string> told_;
  std::unique_ptr<exchange::RouteExchange> exchange_;
};

class DdsVersionTest : public testing::Test {
 protected:
  DdsOptions Options(const std::string& name, std::uint32_t version) {
    DdsOptions options = test::LoopbackOptions(tag_);
    options.self = AgentId(name);
    options.protocol_version = version;
    return options;
  }
  static void LiveUntilTold(const std::vector<Program*>& programs) {
    const auto deadline = Clock::now() + test::kLongEnough;
    const auto has_been_told = [](const Program* one) { return !one->told().empty(); };
    while (!std::all_of(programs.begin(), programs.end(), has_been_told)) {
      ASSERT_LT(Clock::now(), deadline);
      for (Program* program : programs) program->Live();
    }
  }

  std::string tag_ = test::UniqueTag();
};

TEST_F(DdsVersionTest, BothTellOnce) {
  Program older(Options("robot1", kProtocolVersion));
  Program newer(Options("server", kProtocolVersion + 1));
  LiveUntilTold({&older, &newer});
  // One that comes later is told of alone: of the others nothing more is said.
  Program another(Options("robot2", kProtocolVersion + 2));
  const auto deadline = Clock::now() + test::kLongEnough;
  while (older.told().size() < 2 || newer.told().size() < 2) {
    ASSERT_LT(Clock::now(), deadline);
    for (Program* program : {&older, &newer, &another}) program->Live();
  }
  EXPECT_THAT(older.told(), ElementsAre(HasSubstr("'server' speaks version"),
                                        HasSubstr("'robot2' speaks version")));
  EXPECT_THAT(newer.told(), ElementsAre(HasSubstr("'robot1' speaks version"),
                                        HasSubstr("'robot2' speaks version")));
  EXPECT_THAT(older.told().front(), HasSubstr("update this program"));
  EXPECT_THAT(newer.told().front(), HasSubstr("update it"));
}

// A process that calls changes what it says of itself.
TEST_F(DdsVersionTest, WhoCallsAgainAndAgainIsToldOfOnce) {
  const Domain domain = Domain::Create(DomainConfig(Options("x", 1), {}, "").value()).value();
  auto agent = Participant::Create(domain, ToText({"robot1", kProtocolVersion + 1})).value();
  Program program(Options("server", kProtocolVersion));
  LiveUntilTold({&program});
  for (int calls = 0; calls < 9; ++calls) {
    ASSERT_TRUE(agent.Call());
    program.Live();
  }
  const auto last = Participant::Create(domain, ToText({"robot2", kProtocolVersion + 2})).value();
  const auto deadline = Clock::now() + test::kLongEnough;
  while (program.told().size() < 2 && Clock::now() < deadline) program.Live();
  EXPECT_THAT(program.told(), ElementsAre(HasSubstr("'robot1' speaks version"),
                                          HasSubstr("'robot2' speaks version")));
}

TEST_F(DdsVersionTest, ProgramsOfBeforeAreToldOfAndThoseThatAreNotOursAreNot) {
  const Domain domain = Domain::Create(DomainConfig(Options("x", 1), {}, "").value()).value();
  const auto nameless = Participant::Create(domain, "").value();
  const auto ros_node = Participant::Create(domain, "enclave=/;").value();
  const auto before = Participant::Create(domain, "robot1").value();
  Program program(Options("server", kProtocolVersion));
  Program same(Options("robot2", kProtocolVersion));
  LiveUntilTold({&program, &same});
  EXPECT_THAT(program.told(), ElementsAre(HasSubstr("'robot1' speaks a version before")));
}

}  // namespace
}  // namespace trailcast::dds
