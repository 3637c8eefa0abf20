#include "services/http/post.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "services/http/server.h"
#include "tests/support/strangers/self_signed.h"
#include "tests/support/temp_dir.h"

namespace trailcast::http {
namespace {

using testing::HasSubstr;

constexpr std::chrono::seconds kLong{20};

class PostTest : public testing::Test {
 protected:
  void Begin() {
    server_.Post("/hook", [](const httplib::Request& request, httplib::Response& response) {
      const bool is_as_sent = request.body == "{}" && request.get_header_value("X-Kind") == "a" &&
                              request.get_header_value("Content-Type") == "application/json";
      response.status = is_as_sent ? 202 : 400;
    });
    server_.Post("/moved", [](const httplib::Request&, httplib::Response& response) {
      response.set_redirect("/hook");
    });
    ASSERT_TRUE(server_.Listen("127.0.0.1", 0));
  }
  [[nodiscard]] Result<int> To(const std::string& scheme, const std::string& path) const {
    const auto to = ParseUrl(scheme + "://localhost:" + std::to_string(server_.port()) + path);
    return Post(*to, {{"X-Kind", "a"}}, "{}", kLong);
  }

  test::TempDir folder_;
  Server server_{{.body_bytes = 1000}, [](const Error&) {}};
};

TEST_F(PostTest, ReturnsTheAnswersStatusAndFollowsNoRedirection) {
  Begin();
  EXPECT_EQ(To("http", "/hook").value(), 202);
  EXPECT_EQ(To("http", "/nowhere").value(), 404);
  EXPECT_EQ(To("http", "/moved").value(), 302);
}

TEST_F(PostTest, BelievesNobodyWhomNoAuthorityVouchesFor) {
  const test::SelfSigned files = test::MakeSelfSigned(folder_.path());
  server_.Speak(Tls::Load(files.certificate, files.key).value());
  Begin();
  const auto answer = To("https", "/hook");
  ASSERT_FALSE(answer);
  EXPECT_EQ(answer.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(answer.error().message, HasSubstr("https://localhost"));
}

TEST_F(PostTest, NobodyThereIsNoAnswer) {
  int port = 0;
  {
    Server gone({}, [](const Error&) {});
    ASSERT_TRUE(gone.Listen("127.0.0.1", 0));
    port = gone.port();
  }
  const auto to = ParseUrl("http://127.0.0.1:" + std::to_string(port));
  EXPECT_EQ(Post(*to, {}, "{}", kLong).error().code, ErrorCode::kUnavailable);
}

}  // namespace
}  // namespace trailcast::http
