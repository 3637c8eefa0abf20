#include "services/security/revocation_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/base/durable_file.h"
#include "services/security/authority.h"
#include "tests/support/temp_dir.h"

namespace trailcast::security {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class RevocationListTest : public testing::Test {
 protected:
  // Lists of the authority's that revoke as many made-up certificates, issued an hour ago.
  std::string Text(std::uint64_t number, std::size_t certificates = 1) const {
    return TextFrom(authority_, number, certificates, now_ - std::chrono::hours(1));
  }
  std::string TextFrom(const Identity& authority, std::uint64_t number, std::size_t certificates,
                       Time issued) const {
    std::vector<std::string> serials;
    for (std::size_t i = 0; i < certificates; ++i) serials.push_back(fmt::format("{:032X}", i + 1));
    return MakeRevocationList(authority, serials, number, {issued, ends_}).value();
  }
  RevocationList List(std::uint64_t number) const {
    return ReadRevocationList(Text(number), authority_.certificate).value();
  }
  Result<RevocationList> Offered(const std::string& text, std::uint64_t held) const {
    return CheckOffered(text, authority_.certificate, List(held), now_);
  }

  const Time now_ = std::chrono::system_clock::now();
  const Time ends_ = now_ + std::chrono::hours(8760);
  const Identity authority_ =
      MakeAuthority("authority", {now_ - std::chrono::hours(2), ends_}).value();
  const Identity stranger_ =  // of the same name
      MakeAuthority("authority", {now_ - std::chrono::hours(2), ends_}).value();
  test::TempDir folder_;
};

TEST_F(RevocationListTest, SaysWhoIsRevokedAndWhichListItIs) {
  const RevocationList list = List(3);
  EXPECT_THAT(list.serials, ElementsAre("01"));
  EXPECT_EQ(list.number, 3U);
  EXPECT_EQ(list.issued,
            std::chrono::time_point_cast<std::chrono::seconds>(now_ - std::chrono::hours(1)));
  EXPECT_THAT(Describe(list), HasSubstr("list 3 of revoked keys (1 certificate, 20"));
  const auto empty = ReadRevocationList(Text(1, 0), authority_.certificate);
  ASSERT_TRUE(empty) << empty.error().message;
  EXPECT_THAT(empty->serials, IsEmpty());
}

TEST_F(RevocationListTest, IsReadWithoutWhatStandsAroundIt) {
  const auto list = ReadRevocationList("</CRL>\n" + Text(3) + "more", authority_.certificate);
  ASSERT_TRUE(list) << list.error().message;
  EXPECT_TRUE(list->text.starts_with("-----BEGIN X509 CRL-----\n"));
  EXPECT_TRUE(list->text.ends_with("-----END X509 CRL-----\n"));
}

TEST_F(RevocationListTest, IsNewerByItsNumberAndWhereThatIsTheSameByItsDate) {
  EXPECT_TRUE(IsNewer({.number = 2}, {.number = 1, .issued = now_}));
  EXPECT_FALSE(IsNewer({.number = 1, .issued = now_}, {.number = 2}));
  EXPECT_TRUE(IsNewer({.issued = now_}, {.issued = now_ - std::chrono::hours(1)}));
  EXPECT_FALSE(IsNewer({.number = 1, .issued = now_}, {.number = 1, .issued = now_}));
}

TEST_F(RevocationListTest, ANewerOneThatIsOfferedIsTakenAndTheSameIsNoTrouble) {
  EXPECT_EQ(Offered(Text(3), 2)->number, 3U);
  EXPECT_EQ(Offered(Text(3), 3)->number, 3U);
}

TEST_F(RevocationListTest, WhatIsOfferedAndIsNoNewerListOfTheAuthoritysIsRefused) {
  const auto code = [&](const std::string& text) { return Offered(text, 2).error().code; };
  EXPECT_EQ(code(Text(1)), ErrorCode::kConflict);
  EXPECT_EQ(code(TextFrom(stranger_, 9, 1, now_ - std::chrono::hours(1))), ErrorCode::kCorrupt);
  EXPECT_EQ(code(TextFrom(authority_, 9, 1, now_ + std::chrono::hours(1))),
            ErrorCode::kUnavailable);
  EXPECT_EQ(code(""), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code(Text(3) + std::string(kMaxRevocationListBytes, ' ')), ErrorCode::kInvalidArgument);
  // A bit of what was signed, or of the signature.
  for (const double where : {0.3, 0.9}) {
    std::string changed = Text(3);
    char& letter = changed[static_cast<std::size_t>(where * static_cast<double>(changed.size()))];
    letter = letter == 'A' ? 'B' : 'A';
    EXPECT_FALSE(Offered(changed, 2)) << where;
  }
  EXPECT_THAT(Offered(Text(1), 2).error().message,
              testing::AllOf(HasSubstr("list 1 of revoked keys"), HasSubstr("is older than"),
                             HasSubstr("copy revoked.pem")));
}

TEST_F(RevocationListTest, UnderAPasswordIsNoneAndNobodyIsAskedForIt) {
  std::string text = Text(3);
  text.insert(text.find('\n') + 1,
              "Proc-Type: 4,ENCRYPTED\nDEK-Info: AES-128-CBC,00112233445566778899AABBCCDDEEFF\n\n");
  EXPECT_EQ(Offered(text, 2).error().code, ErrorCode::kInvalidArgument);
}

TEST_F(RevocationListTest, OneThatNobodyCouldReadIsNotMade) {
  const std::vector<std::string> serials(30'000, std::string(32, 'A'));
  const auto list = MakeRevocationList(authority_, serials, 2, {now_, ends_});
  ASSERT_FALSE(list);
  EXPECT_THAT(list.error().message, HasSubstr("30000 revoked certificates"));
}

TEST_F(RevocationListTest, IsKeptWholeUnlessOneAsNewIsThere) {
  ASSERT_TRUE(ReplaceFile(folder_ / "authority.pem", authority_.certificate));
  const auto number = [&] { return RevocationListIn(folder_.path())->number; };
  ASSERT_TRUE(KeepRevocationList(folder_.path(), List(2)));
  EXPECT_EQ(number(), 2U);
  ASSERT_TRUE(KeepRevocationList(folder_.path(), List(3)));
  EXPECT_EQ(number(), 3U);
  ASSERT_TRUE(KeepRevocationList(folder_.path(), List(2)));
  EXPECT_EQ(number(), 3U);
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& each : fs::directory_iterator(folder_.path())) ++files;
  EXPECT_EQ(files, 2U) << "nothing else is left behind";
}

TEST_F(RevocationListTest, ThatCannotBeKeptLeavesTheFolderAsItWas) {
  ASSERT_TRUE(ReplaceFile(folder_ / "authority.pem", authority_.certificate));
  // Nobody, root neither, replaces a folder with things in it by a file.
  fs::create_directories(folder_ / "revoked.pem" / "inside");
  const auto kept = KeepRevocationList(folder_.path(), List(2));
  ASSERT_FALSE(kept);
  EXPECT_EQ(kept.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(kept.error().message, HasSubstr("cannot write"));
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& each : fs::directory_iterator(folder_.path())) ++files;
  EXPECT_EQ(files, 2U);
}

TEST_F(RevocationListTest, EachOfTheAuthoritysHasANumberMore) {
  const auto fleet = Authority::Create(folder_ / "fleet", now_, 3650).value();
  const fs::path scout = fleet.Add("robot1", Role::kScout, now_, 30).value();
  ASSERT_TRUE(fleet.Add("robot2", Role::kScout, now_, 30));
  EXPECT_EQ(RevocationListIn(fleet.folder())->number, 1U);
  ASSERT_TRUE(fleet.Revoke("robot2", now_));
  ASSERT_TRUE(fleet.Renew("robot1", Role::kFollower, now_, 30));
  const auto list = RevocationListIn(scout);
  ASSERT_TRUE(list) << list.error().message;
  EXPECT_EQ(list->number, 3U);
  EXPECT_EQ(list->serials.size(), 2U);
}

}  // namespace
}  // namespace trailcast::security
