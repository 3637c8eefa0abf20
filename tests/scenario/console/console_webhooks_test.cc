// A console tells another program of an alert, also when that program was away at first.
#include <csignal>

#include "services/http/server.h"
#include "services/webhooks/hook.h"
#include "tests/scenario/console/console_fleet.h"

namespace trailcast::test {
namespace {

// This is the other program.
class Receiver {
 public:
  explicit Receiver(int port = 0) : server_({.body_bytes = 65'536}, [](const Error&) {}) {
    server_.Post("/robots", [this](const httplib::Request& request, httplib::Response&) {
      const std::scoped_lock lock(mutex_);
      told_.push_back(request);
    });
    EXPECT_TRUE(server_.Listen("127.0.0.1", port));
  }
  [[nodiscard]] int port() const { return server_.port(); }
  // Returns the first request of this event.
  std::optional<httplib::Request> Told(const std::string& event) {
    const std::scoped_lock lock(mutex_);
    for (const httplib::Request& request : told_) {
      if (request.get_header_value("Trailcast-Event") == event) return request;
    }
    return std::nullopt;
  }

 private:
  std::mutex mutex_;
  std::vector<httplib::Request> told_;
  http::Server server_;
};

class ConsoleWebhooksTest : public ConsoleFleetTest {};

TEST_F(ConsoleWebhooksTest, AProgramIsToldOfAServerThatIsGoneAlsoAfterItWasAwayItself) {
  auto receiver = std::make_unique<Receiver>();
  const int port = receiver->port();
  std::ofstream(Path("hooks.json")) << fmt::format(
      R"([{{"url": "http://127.0.0.1:{}/robots", "secret": "s", "events": ["alert"]}}])", port);
  const Words words{"--webhooks", Path("hooks.json"), "--alerts", Path("alerts.json")};
  StartConsole(words);
  server_ = Server();
  ASSERT_TRUE(WaitUntil([&] { return !State()["servers"].empty(); })) << State().dump();
  server_->Signal(SIGKILL);
  (void)End(*server_);
  ASSERT_TRUE(WaitUntil([&] { return receiver->Told("alert.began").has_value(); }))
      << console_->output();
  const httplib::Request began = *receiver->Told("alert.began");
  const json body = json::parse(began.body);
  EXPECT_EQ(body["alert"]["kind"], "server-offline");
  EXPECT_EQ(body["alert"]["server"], "server");
  const std::string signature = began.get_header_value("Trailcast-Signature");
  const std::int64_t at_s = std::stoll(signature.substr(2));
  EXPECT_EQ(signature, webhooks::SignatureOf("s", at_s, began.body));

  receiver.reset();
  server_ = Server();
  ASSERT_TRUE(console_->WaitForOutput("is not told of alert.ended")) << console_->output();
  console_->Signal(SIGTERM);
  EXPECT_EQ(End(*console_).status, 0);
  receiver = std::make_unique<Receiver>(port);
  StartConsole(words);
  EXPECT_TRUE(WaitUntil([&] { return receiver->Told("alert.ended").has_value(); }))
      << console_->output();
  EXPECT_FALSE(receiver->Told("alert.began")) << "it is told once";
}

}  // namespace
}  // namespace trailcast::test
