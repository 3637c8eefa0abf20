#pragma once

#include <httplib.h>

#include <csignal>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/scenario/console/console_fleet.h"
#include "tests/scenario/console/webdriver.h"
#include "tests/support/await.h"
#include "tests/support/places.h"
#include "tests/support/strangers/self_signed.h"

namespace trailcast::test {

inline constexpr const char* kPassword = "correct horse";

// This is a console with users, who reach it over TLS.
class ConsoleUsersTest : public ConsoleFleetTest {
 protected:
  // OpenSSL raises SIGPIPE when it says farewell to a console that has hung up.
  void SetUp() override { std::signal(SIGPIPE, SIG_IGN); }

  Words UsersWords(const Words& words) const {
    return With(With({"users"}, words), {"--users", Path("users")});
  }
  // `input` comes on its standard input.
  Ended Users(const Words& words, const std::string& input = kPassword) {
    std::string line = "printf '%s\\n' \"$0\" | \"$@\"";
    Words argv{"/bin/sh", "-c", line, input, ProgramsDir() + "/trailcast-console"};
    Process process(With(std::move(argv), UsersWords(words)), Path("users.log"));
    return End(process);
  }
  void AddUser(const std::string& name, const std::string& role) {
    const Ended added = Users({"add", name, "--role", role});
    ASSERT_EQ(added.status, 0) << added.output;
  }
  void StartWithTls() {
    StartConsole({"--users", Path("users"), "--tls-certificate", files_.certificate.string(),
                  "--tls-key", files_.key.string()});
  }
  std::unique_ptr<httplib::SSLClient> Client() {
    auto client = std::make_unique<httplib::SSLClient>("localhost", port_);
    client->set_ca_cert_path(files_.certificate.c_str());
    client->enable_server_certificate_verification(true);
    client->set_connection_timeout(20);
    client->set_read_timeout(test::kLongEnough);
    client->set_logger(console::ExpectAsDescribed());
    return client;
  }
  struct Replied {
    int status = 0;
    json body{};
    std::string cookie{};
  };
  static Replied Of(const httplib::Result& got) {
    if (!got) return {};
    const std::string set = got->get_header_value("Set-Cookie");
    return {got->status, json::parse(got->body, nullptr, false), set.substr(0, set.find(';'))};
  }
  Replied Get(const std::string& path, const httplib::Headers& headers = {}) {
    return Of(Client()->Get(path, headers));
  }
  Replied Post(const std::string& path, const httplib::Headers& headers = {},
               const json& body = json::object()) {
    return Of(Client()->Post(path, headers, body.dump(), "application/json"));
  }
  Replied LogIn(const std::string& user, const std::string& password) {
    return Post("/api/log-in", {}, {{"user", user}, {"password", password}});
  }
  // Returns the headers of a user who is logged in, as the page sends them.
  httplib::Headers As(const std::string& user) {
    return {{"Cookie", LogIn(user, kPassword).cookie},
            {"Origin", "https://localhost:" + std::to_string(port_)}};
  }
  // Types their name and password into the page.
  static bool LogInPage(Browser& browser, const std::string& user,
                        const std::string& password = kPassword) {
    const std::string enter = "\xEE\x80\x87";
    return browser.WaitForText("Log in to see the robots") &&
           browser.Type("//input[@name='user']", user) &&
           browser.Type("//input[@name='password']", password + enter);
  }

  SelfSigned files_ = MakeSelfSigned(folder_ / "");
};

}  // namespace trailcast::test
