#include "services/users/user.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "services/users/secret.h"
#include "services/users/user_file.h"
#include "tests/support/temp_dir.h"

namespace trailcast::users {
namespace {

using testing::HasSubstr;

TEST(Users, RolesIncludeThoseBefore) {
  EXPECT_TRUE(Includes(Role::kAdminister, Role::kOperate));
  EXPECT_TRUE(Includes(Role::kOperate, Role::kOperate));
  EXPECT_FALSE(Includes(Role::kLook, Role::kOperate));
  for (const Role role : {Role::kLook, Role::kOperate, Role::kAdminister}) {
    EXPECT_EQ(FindRole(NameOf(role)), role);
  }
  EXPECT_FALSE(FindRole("root"));
}

TEST(Users, AreReadAsTheyWereWritten) {
  const Users users{{"anna", {.role = Role::kOperate, .password = NobodysHash()}},
                    {"wall", {.role = Role::kLook}},
                    {"wms", {.role = Role::kAdminister, .token = DigestOf("x")}}};
  EXPECT_EQ(ParseUsers(TextOf(users)).value(), users);
  EXPECT_EQ(ParseUsers("").value(), Users{});
}

TEST(Users, WhatIsWrongInAFileIsSaidWithItsLine) {
  const auto wrong = [](const std::string& text) {
    const auto users = ParseUsers("wall look - -\n" + text);
    return users ? "" : users.error().message;
  };
  EXPECT_EQ(wrong("anna look - -\n"), "");
  EXPECT_THAT(wrong("anna look -\n"), HasSubstr("line 2 is not"));
  EXPECT_THAT(wrong("anna root - -\n"), HasSubstr("none of look"));
  EXPECT_THAT(wrong("an/na look - -\n"), HasSubstr("no name"));
  EXPECT_THAT(wrong(std::string(33, 'a') + " look - -\n"), HasSubstr("no name"));
  EXPECT_THAT(wrong("wall look - -\n"), HasSubstr("second time"));
  EXPECT_THAT(wrong("anna look secret -\n"), HasSubstr("password's hash"));
  EXPECT_THAT(wrong("anna look - secret\n"), HasSubstr("token's digest"));
  std::string many;
  for (int i = 0; i < 1000; ++i) many += "u" + std::to_string(i) + " look - -\n";
  EXPECT_THAT(wrong(many), HasSubstr("line 1001 is one user too many"));
}

TEST(Users, TheFileIsItsOwnersAlone) {
  const test::TempDir folder;
  const auto file = folder / "users";
  const auto add = [&](const std::string& name) {
    return ChangeUsers(file, [&](Users& users) -> Result<void> {
      users[name] = {};
      return {};
    });
  };
  ASSERT_TRUE(add("anna"));
  ASSERT_TRUE(add("bob"));
  struct stat status {};
  ASSERT_EQ(stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
  if (geteuid() == 0) {
    ASSERT_EQ(chown(folder.path().c_str(), 12345, 12345), 0);
    ASSERT_TRUE(add("bob"));
    ASSERT_EQ(stat(file.c_str(), &status), 0);
    EXPECT_EQ(status.st_uid, 12345U) << "who the folder is of reads it";
  }
  const auto refused = ChangeUsers(file, [](Users& users) -> Result<void> {
    users.clear();
    return Fail(ErrorCode::kNotFound, "no");
  });
  EXPECT_FALSE(refused);
  EXPECT_EQ(LoadUsers(file)->size(), 2U);
  EXPECT_EQ(LoadUsers(folder / "other").error().code, ErrorCode::kNotFound);
  std::ofstream(file) << "nonsense\n";
  EXPECT_FALSE(add("carl")) << "what is not understood is not overwritten";
}

}  // namespace
}  // namespace trailcast::users
