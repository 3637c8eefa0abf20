#include "services/security/src/signing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::security {
namespace {

using testing::HasSubstr;

class SigningTest : public testing::Test {
 protected:
  const Time now_ = std::chrono::system_clock::now();
  const Validity year_{now_ - std::chrono::hours(1), now_ + std::chrono::hours(8760)};
  const Identity authority_ = MakeAuthority("authority", year_).value();
  const Identity stranger_ = MakeAuthority("authority", year_).value();  // of the same name
};

TEST_F(SigningTest, WhatWasSignedIsReadable) {
  const std::string document = Sign("<a>1</a>\n<b>2</b>\n", authority_).value();
  EXPECT_THAT(document, HasSubstr("<a>1</a>"));
  const auto opened = OpenSigned(document, authority_.certificate);
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_THAT(*opened, HasSubstr("<b>2</b>"));
}

TEST_F(SigningTest, WhatWasChangedOrSignedBySomebodyElseIsNot) {
  std::string document = Sign("<role>follower</role>\n", authority_).value();
  EXPECT_EQ(OpenSigned(document, stranger_.certificate).error().code, ErrorCode::kCorrupt);
  document.replace(document.find("follower"), 8, "operator");
  EXPECT_EQ(OpenSigned(document, authority_.certificate).error().code, ErrorCode::kCorrupt);
  EXPECT_EQ(OpenSigned("", authority_.certificate).error().code, ErrorCode::kCorrupt);
  EXPECT_EQ(OpenSigned("no document", authority_.certificate).error().code, ErrorCode::kCorrupt);
}

TEST_F(SigningTest, AnAuthorityThatCannotBeReadIsToldOfByItsPart) {
  const Identity no_key{authority_.certificate, "no key"};
  EXPECT_THAT(Sign("<a/>\n", no_key).error().message, HasSubstr("the authority's key: is no"));
  const Identity no_certificate{"no certificate", authority_.key};
  EXPECT_THAT(Sign("<a/>\n", no_certificate).error().message,
              HasSubstr("the authority's certificate: is no"));
  EXPECT_THAT(OpenSigned("", "no certificate").error().message,
              HasSubstr("the authority's certificate: is no"));
}

TEST_F(SigningTest, ACertificateSaysWhoAndHowLongAndByWhom) {
  const Identity member = Issue(authority_, "scout.4f2a9c0d11223344.1", year_).value();
  const CertificateFacts facts = ReadCertificate(member.certificate).value();
  EXPECT_EQ(facts.common_name, "scout.4f2a9c0d11223344.1");
  EXPECT_EQ(std::chrono::system_clock::to_time_t(facts.validity.until),
            std::chrono::system_clock::to_time_t(year_.until));
  EXPECT_TRUE(IsSignedBy(member.certificate, authority_.certificate).value());
  EXPECT_FALSE(IsSignedBy(member.certificate, stranger_.certificate).value());
  EXPECT_TRUE(KeyFits(member).value());
  EXPECT_FALSE(KeyFits({member.certificate, stranger_.key}).value());
  EXPECT_FALSE(ReadCertificate("-----BEGIN CERTIFICATE-----\nAAAA\n"));
}

}  // namespace
}  // namespace trailcast::security
