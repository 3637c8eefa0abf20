// A fleet manager that speaks VDA 5050 drives a robot over an MQTT broker, which is killed
// meanwhile.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/scenario/robots.h"
#include "tests/support/strangers/self_signed.h"

namespace trailcast::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr const char* kBroker = "/usr/sbin/mosquitto";
constexpr const char* kListens = "/usr/bin/mosquitto_sub";
constexpr const char* kSends = "/usr/bin/mosquitto_pub";
constexpr const char* kTopic = "vda5050/v3/acme/robot1/";

// One that nobody listens on now.
int FreePort() {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  EXPECT_EQ(::bind(socket, any, size), 0);
  EXPECT_EQ(::getsockname(socket, any, &size), 0);
  close(socket);
  return ntohs(address.sin_port);
}

class Vda5050Test : public RobotsTest {
 protected:
  void SetUp() override {
    for (const char* program : {kBroker, kListens, kSends}) {
      if (!std::filesystem::exists(program)) GTEST_SKIP() << program << " is not installed";
    }
    port_ = std::to_string(FreePort());
    std::ofstream(Path("mosquitto.conf")) << "listener " << port_ << " 127.0.0.1\n"
                                          << BrokerSettings();
    BeginBroker();
    Teach();
    server_ = Server();
    const Ended delivered = RunAgent({"deliver", "--store", Path("routes.db"), "--name", "scout"});
    ASSERT_EQ(delivered.status, 0) << delivered.output;
    robot_ = Robot("robot1", {"--sim-truth", Path("truth.csv"), "--sim-battery", BatteryMinutes()});
    agent_ = Serve("robot1");
    ASSERT_TRUE(agent_->WaitForOutput("available as 'robot1'")) << agent_->output();
  }
  [[nodiscard]] virtual std::string BatteryMinutes() const { return "60"; }
  [[nodiscard]] virtual std::string BrokerSettings() { return "allow_anonymous true\n"; }
  // Returns how a fleet manager's clients connect.
  [[nodiscard]] virtual Words Connection() const { return {"-h", "127.0.0.1", "-p", port_}; }
  void BeginBroker() {
    const std::string log = Path("broker" + std::to_string(++started_) + ".log");
    broker_ = std::make_unique<Process>(Words{kBroker, "-c", Path("mosquitto.conf")}, log);
    ASSERT_TRUE(broker_->WaitForOutput("running")) << broker_->output();
  }
  // Hears what is told from now on, and what the broker has kept.
  void Listen() {
    heard_ =
        std::make_unique<Process>(With(With({kListens}, Connection()), {"-v", "-t", "vda5050/#"}),
                                  Path("heard" + std::to_string(++started_) + ".log"));
  }
  std::unique_ptr<Process> Gateway(const std::string& log) {
    return Start(
        "trailcast-vda5050",
        {"--vouch-for-emergency-stops", "--manufacturer", "acme", "--broker", "127.0.0.1:" + port_},
        log);
  }
  void Send(const std::string& topic, json message) {
    message["headerId"] = 1;
    message["timestamp"] = "2026-11-30T12:00:00.000Z";
    message["version"] = "3.0.0";
    message["manufacturer"] = "acme";
    message["serialNumber"] = "robot1";
    Process sent(With(With({kSends}, Connection()), {"-t", kTopic + topic, "-m", message.dump()}),
                 Path("sent" + std::to_string(++started_) + ".log"));
    ASSERT_EQ(End(sent).status, 0) << sent.output();
  }
  void Order(const std::string& id, const std::vector<std::string>& nodes) {
    json order{{"orderId", id}, {"orderUpdateId", 0}};
    order["nodes"] = json::array();
    order["edges"] = json::array();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto step = [&](const char* name, const std::string& value, std::size_t sequence) {
        return json{{name, value},
                    {"sequenceId", sequence},
                    {"released", true},
                    {"actions", json::array()}};
      };
      order["nodes"].push_back(step("nodeId", nodes[i], 2 * i));
      if (i > 0) order["edges"].push_back(step("edgeId", "to " + nodes[i], 2 * i - 1));
    }
    Send("order", order);
  }
  void Act(const std::string& type) {
    Send("instantActions",
         {{"actions",
           json::array({{{"actionType", type}, {"actionId", type}, {"blockingType", "NONE"}}})}});
  }
  // Until the last message on that topic is so.
  bool Told(const std::string& topic, const std::function<bool(const json&)>& is) {
    return WaitUntil([&] {
      json last;
      std::istringstream lines(heard_->output());
      for (std::string line; std::getline(lines, line);) {
        const std::string begins = kTopic + topic + " ";
        json message = line.starts_with(begins)
                           ? json::parse(line.substr(begins.size()), nullptr, false)
                           : json();
        if (message.is_object()) last = std::move(message);  // the last line may not be whole
      }
      return last.is_object() && is(last);
    });
  }
  bool Connected(const std::string& how) {
    return Told("connection", [&](const json& told) { return told["connectionState"] == how; });
  }
  bool Did(const std::string& action) {
    return Told("state", [&](const json& told) {
      for (const json& each : told["instantActionStates"]) {
        if (each["actionId"] == action) return each["actionStatus"] == "FINISHED";
      }
      return false;
    });
  }

  std::string port_;
  int started_ = 0;
  std::unique_ptr<Process> broker_;
  std::unique_ptr<Process> server_;
  std::unique_ptr<Process> robot_;
  std::unique_ptr<Process> agent_;
  std::unique_ptr<Process> heard_;
};

TEST_F(Vda5050Test, AnOrderIsDrivenThoughTheBrokerIsKilledAndItsRobotObeys) {
  Listen();
  auto gateway = Gateway("gateway");
  ASSERT_TRUE(Connected("ONLINE")) << gateway->output() << heard_->output();
  ASSERT_TRUE(Told("factsheet", [](const json& told) {
    return told["typeSpecification"]["navigationTypes"] == json::array({"VIRTUAL_LINE_GUIDED"});
  }));
  Order("o1", {"hall:0", "attic:3"});
  ASSERT_TRUE(Told("state", [](const json& told) {
    return !told["errors"].empty() && told["errors"][0]["errorType"] == "NO_ROUTE_TO_TARGET";
  })) << heard_->output();

  Order("o2", {"hall:0", "hall:1", "hall:3"});
  ASSERT_TRUE(Told("state",
                   [](const json& told) {
                     return told["orderId"] == "o2" && told["driving"] == true &&
                            told["errors"].empty();
                   }))
      << heard_->output() << agent_->output();
  broker_->Signal(SIGKILL);
  (void)End(*broker_);
  ASSERT_TRUE(agent_->WaitForOutput("where it was to end")) << agent_->output();
  EXPECT_NEAR(Along_m("truth.csv"), 4.0, 0.25) << "what is released is driven";
  BeginBroker();
  Listen();
  ASSERT_TRUE(Told("state",
                   [](const json& told) {
                     return told["lastNodeId"] == "hall:3" && told["nodeStates"].empty();
                   }))
      << heard_->output() << gateway->output();
  EXPECT_TRUE(Connected("ONLINE")) << heard_->output();

  Act("startPause");
  ASSERT_TRUE(Did("startPause")) << heard_->output();
  ASSERT_TRUE(Told("state", [](const json& told) { return told["paused"] == true; }));
  Order("o3", {"hall:3", "hall:3.4"});
  ASSERT_TRUE(Told("state", [](const json& told) { return told["orderId"] == "o3"; }));
  Act("cancelOrder");
  ASSERT_TRUE(Did("cancelOrder")) << heard_->output() << agent_->output();
  ASSERT_TRUE(Told("state", [](const json& told) { return told["nodeStates"].empty(); }));
  Act("stopPause");
  ASSERT_TRUE(Did("stopPause")) << heard_->output();
  EXPECT_NEAR(Along_m("truth.csv"), 4.0, 0.25) << "it stood";

  gateway->Signal(SIGTERM);
  EXPECT_EQ(End(*gateway).status, 0) << gateway->output();
  EXPECT_TRUE(Connected("OFFLINE")) << heard_->output();
  gateway = Gateway("gateway2");
  ASSERT_TRUE(Connected("ONLINE")) << gateway->output();
  gateway->Signal(SIGKILL);
  EXPECT_TRUE(Connected("CONNECTION_BROKEN")) << heard_->output();
}

class Vda5050ChargingTest : public Vda5050Test {
 protected:
  std::string BatteryMinutes() const override { return "3"; }
};

TEST_F(Vda5050ChargingTest, ARobotThatItsServerHasSentToADockIsToldAsCharging) {
  Listen();
  const auto gateway = Gateway("gateway");
  const auto charging = [&](bool is) {
    return Told("state",
                [&](const json& told) { return told["powerSupply"]["charging"] == json(is); });
  };
  ASSERT_TRUE(charging(false)) << gateway->output() << heard_->output();
  const auto tool = [&](const Words& words) {
    const Ended ended = End(*Start("trailcast", words, "tool" + std::to_string(++started_)));
    EXPECT_EQ(ended.status, 0) << ended.output;
  };
  tool({"network", "name", "dock1", "hall@1", "dock"});
  tool({"send", "robot1", "follow", "hall", "..0.8", "--wait"});
  tool({"network", "charge", "below", "98", "until", "99"});
  EXPECT_TRUE(charging(true)) << heard_->output() << server_->output() << agent_->output();
  tool({"network", "charge", "never"});
  EXPECT_TRUE(charging(false)) << "nobody says so any more";
}

TEST_F(Vda5050Test, WhatRobotsDoNotTellIsVouchedForOrRefused) {
  const Ended refused = End(*Start("trailcast-vda5050", {}, "refused"));
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.output, HasSubstr("--vouch-for-emergency-stops says that none is"));
  const auto other = Robot("robot2", {});
  const auto agent = Serve("robot2", "duty2", {}, "robot2.db");
  ASSERT_TRUE(agent->WaitForOutput("available as 'robot2'")) << agent->output();
  const auto gateway = Gateway("gateway");
  EXPECT_TRUE(gateway->WaitForOutput("robot2 is not presented: it tells no battery"))
      << gateway->output();
  EXPECT_TRUE(gateway->WaitForOutput("robot1 is presented as")) << gateway->output();
}

// The broker asks for TLS, and for a user and a password.
class Vda5050DoorsTest : public Vda5050Test {
 protected:
  static constexpr const char* kPassword = "correct horse";

  std::string BrokerSettings() override {
    files_ = MakeSelfSigned(folder_.path());
    std::ofstream(Path("password")) << kPassword << "\n";
    std::ofstream(Path("wrong")) << "correct mule\n";
    std::ofstream(Path("users")) << "gateway:" << kPassword << "\n";
    EXPECT_EQ(End(*std::make_unique<Process>(
                      Words{"/usr/bin/mosquitto_passwd", "-U", Path("users")}, Path("users.log")))
                  .status,
              0);
    std::filesystem::permissions(Path("users"), std::filesystem::perms::owner_read);
    // As root, the broker would read its files as another user.
    const char* const user = geteuid() == 0 ? "user root\n" : "";
    return fmt::format("{}certfile {}\nkeyfile {}\nallow_anonymous false\npassword_file {}\n", user,
                       files_.certificate.string(), files_.key.string(), Path("users"));
  }
  Words Connection() const override {
    return {"-h", "localhost", "-p", port_,    "--cafile", files_.certificate.string(),
            "-u", "gateway",   "-P", kPassword};
  }
  std::unique_ptr<Process> Through(const std::string& password, const Words& trust) {
    return Start(
        "trailcast-vda5050",
        With({"--vouch-for-emergency-stops", "--manufacturer", "acme", "--broker",
              "localhost:" + port_, "--user", "gateway", "--password-file", Path(password)},
             trust),
        "gateway" + std::to_string(++started_));
  }

  SelfSigned files_;
};

TEST_F(Vda5050DoorsTest, WithItsPasswordItComesInByTlsAndOtherwiseSaysWhyNot) {
  const Words trusts{"--tls-ca", files_.certificate.string()};
  const auto stranger = Through("wrong", trusts);
  EXPECT_TRUE(stranger->WaitForOutput("not authorised")) << stranger->output();
  const SelfSigned others = MakeSelfSigned(folder_.path(), "other");
  const auto misled = Through("password", {"--tls-ca", others.certificate.string()});
  EXPECT_TRUE(misled->WaitForOutput("certificate")) << misled->output();
  const auto plain = Through("password", {});
  EXPECT_TRUE(plain->WaitForOutput("TLS")) << plain->output();

  Listen();
  const auto gateway = Through("password", trusts);
  ASSERT_TRUE(Connected("ONLINE")) << gateway->output() << heard_->output();
  Order("o1", {"hall:0", "hall:1"});
  EXPECT_TRUE(Told("state", [](const json& told) {
    return told["lastNodeId"] == "hall:1" && told["nodeStates"].empty();
  })) << heard_->output();
}

}  // namespace
}  // namespace trailcast::test
