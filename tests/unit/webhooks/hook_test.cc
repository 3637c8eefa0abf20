#include "services/webhooks/hook.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::webhooks {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string Refusal(const std::string& json) {
  const auto hooks = ParseHooks(json);
  return hooks ? "" : hooks.error().message;
}

TEST(Hooks, HaveAUrlAndIfAtAllASecretAndEvents) {
  const auto hooks = ParseHooks(
      R"([{"url": "https://example.org:8443/a?b=1", "secret": "s", "events": ["alert", "mission.failed"]},
          {"url": "http://10.0.0.7"}])");
  ASSERT_TRUE(hooks) << hooks.error().message;
  ASSERT_EQ(hooks->size(), 2U);
  EXPECT_EQ((*hooks)[0].to.origin, "https://example.org:8443");
  EXPECT_EQ((*hooks)[0].to.path, "/a?b=1");
  EXPECT_EQ((*hooks)[0].secret, "s");
  EXPECT_EQ((*hooks)[1].to.path, "/");
}

TEST(Hooks, AreToldWhatTheyAskFor) {
  const auto hooks = ParseHooks(
      R"([{"url": "http://a", "events": ["alert", "mission.failed"]}, {"url": "http://b"}])");
  const Hook& some = (*hooks)[0];
  EXPECT_TRUE(some.Wants("alert.began"));
  EXPECT_TRUE(some.Wants("mission.failed"));
  EXPECT_FALSE(some.Wants("mission.arrived"));
  EXPECT_TRUE((*hooks)[1].Wants("mission.arrived")) << "without events it gets all";
}

TEST(Hooks, SayWhatIsWrongWithThem) {
  EXPECT_THAT(Refusal("{}"), HasSubstr("expected a list in JSON"));
  EXPECT_THAT(Refusal("[{]"), HasSubstr("expected a list in JSON"));
  EXPECT_THAT(Refusal(R"([{"url": "http://a"}, {"url": "ftp://b"}])"),
              AllOf(HasSubstr("hook 2"), HasSubstr("neither with http:// nor with https://")));
  EXPECT_THAT(Refusal(R"([{}])"), HasSubstr("\"url\""));
  EXPECT_THAT(Refusal(R"([{"url": "http:///path"}])"), HasSubstr("names no host"));
  EXPECT_THAT(Refusal(R"([{"url": "http://u:p@host/"}])"), HasSubstr("has a user in it"));
  EXPECT_THAT(Refusal(R"([{"url": "http://a b/"}])"), HasSubstr("blanks"));
  EXPECT_THAT(Refusal(R"([{"url": "http://a", "secrets": "s"}])"), HasSubstr("'secrets'"));
  EXPECT_THAT(Refusal(R"([{"url": "http://a", "events": ["route"]}])"),
              HasSubstr("other than alert, mission"));
  EXPECT_THAT(Refusal(R"([{"url": "http://a"}, {"url": "http://a"}])"),
              HasSubstr("the URL of an earlier one"));
}

// The code is `printf '1700000000.{}' | openssl dgst -sha256 -hmac secret`.
TEST(Hooks, ASignatureIsOverTheTimeAndTheBody) {
  EXPECT_EQ(SignatureOf("secret", 1'700'000'000, "{}"),
            "t=1700000000,v1=b8569b78799ff9e3cbff0fc2d63a33a2b57f3282abd07c37ae5e8e7d79a5f163");
  EXPECT_NE(SignatureOf("secret", 1'700'000'001, "{}"), SignatureOf("secret", 1'700'000'000, "{}"));
}

}  // namespace
}  // namespace trailcast::webhooks
