#include "services/users/secret.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::users {
namespace {

TEST(Secret, APasswordMatchesItsOwnHashAlone) {
  const std::string hash = HashPassword("correct horse").value();
  EXPECT_TRUE(IsPasswordHash(hash)) << hash;
  EXPECT_TRUE(Matches("correct horse", hash));
  EXPECT_FALSE(Matches("correct hors", hash));
  EXPECT_FALSE(Matches("", hash));
  EXPECT_NE(HashPassword("correct horse").value(), hash) << "each has its own salt";
  EXPECT_FALSE(Matches("", NobodysHash()));
}

// As Python's hashlib.scrypt has it, with the salt's digits as its bytes.
TEST(Secret, HashesAsOthersDo) {
  EXPECT_TRUE(Matches("correct horse",
                      "scrypt:32768:8:3:00112233445566778899aabbccddeeff:97d1565175"
                      "6d8d025ae90b505f9eb49ae717fdc2f832b6c1a6e4f011adc2ada9"));
}

TEST(Secret, WhatIsNoHashMatchesNothing) {
  const std::string hash = NobodysHash();
  for (const std::string& text :
       {std::string(), std::string("-"), hash.substr(1), hash + "0", hash.substr(0, 20),
        std::string("scrypt:16384:8:3:") + hash.substr(17),
        hash.substr(0, hash.size() - 1) + "g"}) {
    EXPECT_FALSE(IsPasswordHash(text)) << text;
    EXPECT_FALSE(Matches("", text)) << text;
  }
}

TEST(Secret, PasswordsThatAreGuessedAtOnceAreRefused) {
  EXPECT_TRUE(CheckPassword("anna", "correct horse"));
  EXPECT_FALSE(CheckPassword("anna", "short"));
  EXPECT_FALSE(CheckPassword("anna", "aaaaaaaaaaaa"));
  EXPECT_FALSE(CheckPassword("anna", "anna12345678"));
  EXPECT_FALSE(CheckPassword("anna", std::string(kLongestPassword, 'x') + "yz"));
}

TEST(Secret, TokensAreLongAndKeptAsDigests) {
  const std::string token = DrawToken();
  EXPECT_EQ(token.size(), 64U);
  EXPECT_NE(token, DrawToken());
  EXPECT_TRUE(IsDigest(DigestOf(token)));
  EXPECT_EQ(DigestOf("abc"),
            "sha256:ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_FALSE(IsDigest(token));
}

}  // namespace
}  // namespace trailcast::users
