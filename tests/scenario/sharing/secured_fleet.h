#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "services/security/authority.h"
#include "tests/scenario/programs.h"

namespace trailcast::test {

// This is a fleet with keys: a server, a scout "robot1", a follower "robot2", an operator "desk"
// and an observer "guest".
class SecuredFleetTest : public ProgramsTest {
 protected:
  using Role = security::Role;
  static security::Time Now() { return std::chrono::system_clock::now(); }
  // Members' keys are this old, for members whose clocks are behind, and hold for thirty days more.
  static constexpr int kAge_days = 20;
  static security::Time LongAgo() { return Now() - std::chrono::hours(24 * kAge_days); }

  std::string Add(const std::string& name, Role role) {
    return authority_.Add(name, role, LongAgo(), kAge_days + 30).value().string();
  }
  [[nodiscard]] std::string Keys(const std::string& name) const {
    return (authority_.folder() / "members" / name).string();
  }
  // Runs the program as that member.
  std::unique_ptr<Process> StartAs(const std::string& keys, const std::string& program,
                                   const Words& words, const std::string& log) {
    return Start(program, With({"--security", keys}, words), log);
  }
  Ended RunAs(const std::string& keys, const std::string& program, const Words& words) {
    return End(*StartAs(keys, program, words, "run"));
  }
  std::unique_ptr<Process> SecuredServer(const std::string& log = "server") {
    auto server = StartAs(Keys("server"), "trailcast-server", {"--store", Path("server.db")}, log);
    EXPECT_TRUE(server->WaitForOutput("ready")) << server->output();
    return server;
  }
  Ended Teach(const std::string& keys, const std::string& store = "scout.db") {
    return RunAs(keys, "trailcast-agent",
                 With(TeachWords(Walk("taught", kTaughtFrames), store), {"--server"}));
  }
  // Fetches the route that robot1 taught into a store of its own.
  Words FetchWords(const std::string& store) {
    return {"fetch", "--route", "hall", "--store", Path(store), "--wait", "15"};
  }

  const security::Authority authority_ =
      security::Authority::Create(folder_ / "fleet", LongAgo(), 3650).value();
  const std::string server_keys_ = Add("server", Role::kServer);
  const std::string scout_keys_ = Add("robot1", Role::kScout);
  const std::string follower_keys_ = Add("robot2", Role::kFollower);
  const std::string operator_keys_ = Add("desk", Role::kOperator);
  const std::string observer_keys_ = Add("guest", Role::kObserver);
};

}  // namespace trailcast::test
