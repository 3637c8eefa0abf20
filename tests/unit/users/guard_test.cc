#include "services/users/guard.h"

#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <fstream>
#include <mutex>
#include <new>
#include <thread>
#include <vector>

#include "services/users/secret.h"
#include "tests/support/await.h"
#include "tests/support/temp_dir.h"

namespace trailcast::users {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::seconds;

class GuardTest : public testing::Test {
 protected:
  void SetUp() override {
    Change([](Users& users) {
      users["anna"] = {.role = Role::kOperate, .password = HashOf("correct horse")};
      users["wms"] = {.role = Role::kLook, .token = DigestOf("its token")};
    });
    guard_ =
        Guard::Open(
            folder_ / "users", [this](const Error&) { ++complaints_; },
            {.clock = [this] { return Guard::Time{} + hours(1000) + milliseconds(passed_ms_); },
             .matches = [this](const std::string& password,
                               const std::string& hash) { return Match(password, hash); }})
            .value();
  }
  // In place of what takes a quarter of a second.
  static std::string HashOf(const std::string& password) {
    return "scrypt:32768:8:3:" + std::string(32, '0') + ":" + DigestOf(password).substr(7);
  }
  bool Match(const std::string& password, const std::string& hash) {
    ++hashed_;
    if (no_memory_) throw std::bad_alloc();
    std::unique_lock lock(mutex_);
    goes_on_.wait(lock, [this] { return !held_; });
    return HashOf(password) == hash;
  }
  void Hold(bool held) {
    const std::scoped_lock lock(mutex_);
    held_ = held;
    goes_on_.notify_all();
  }
  void Change(const std::function<void(Users&)>& change) {
    ASSERT_TRUE(ChangeUsers(folder_ / "users", [&](Users& users) -> Result<void> {
      change(users);
      return {};
    }));
  }
  void Pass(milliseconds time) { passed_ms_ += time.count(); }
  // A session's token; empty where it was refused, and `turned_` says why.
  std::string LogIn(const std::string& name, const std::string& password,
                    const std::string& address = "192.0.2.1") {
    const auto in = guard_->LogIn(name, password, address);
    if (const auto* turned = std::get_if<Turned>(&in)) {
      turned_ = *turned;
      return "";
    }
    return std::get<std::string>(in);
  }

  std::mutex mutex_;
  std::condition_variable goes_on_;
  bool held_ = false;
  std::atomic<bool> no_memory_{false};
  std::atomic<int> hashed_{0};
  test::TempDir folder_;
  std::atomic<std::int64_t> passed_ms_{0};
  std::atomic<int> complaints_{0};
  std::unique_ptr<Guard> guard_;
  Turned turned_;
};

TEST_F(GuardTest, LetsUsersInAndKnowsThemAgain) {
  const std::string session = LogIn("anna", "correct horse");
  ASSERT_NE(session, "");
  EXPECT_EQ(guard_->WhoIn(session)->name, "anna");
  EXPECT_EQ(guard_->WhoIn(session)->role, Role::kOperate);
  EXPECT_FALSE(guard_->WhoIn("another"));
  guard_->LogOut(session);
  EXPECT_FALSE(guard_->WhoIn(session));
  EXPECT_EQ(guard_->WhoseToken("its token")->name, "wms");
  EXPECT_FALSE(guard_->WhoseToken(""));
  EXPECT_FALSE(guard_->WhoseToken("another"));
  EXPECT_EQ(LogIn("anna", "wrong horse"), "");
  EXPECT_EQ(turned_.why, Turned::Why::kWrong);
  EXPECT_EQ(LogIn("nobody", "correct horse"), "");
  EXPECT_EQ(turned_.why, Turned::Why::kWrong);
  EXPECT_EQ(LogIn("wms", ""), "") << "it has no password";
  EXPECT_EQ(turned_.why, Turned::Why::kWrong);
  EXPECT_EQ(LogIn("anna", std::string(100'000, 'x')), "");
}

TEST_F(GuardTest, APasswordThatCannotBeLookedAtLocksNobodyOut) {
  no_memory_ = true;
  EXPECT_EQ(LogIn("anna", "correct horse"), "");
  EXPECT_EQ(turned_.why, Turned::Why::kBusy);
  no_memory_ = false;
  EXPECT_NE(LogIn("anna", "correct horse"), "");
}

TEST_F(GuardTest, AnotherPasswordRoleOrNoUserAtAllCountsAtOnce) {
  const std::string session = LogIn("anna", "correct horse");
  Change([](Users& users) { users["anna"].role = Role::kLook; });
  Pass(seconds(1));
  EXPECT_EQ(guard_->WhoIn(session)->role, Role::kLook);
  Change([](Users& users) { users["anna"].password = HashOf("other horse"); });
  Pass(seconds(1));
  EXPECT_FALSE(guard_->WhoIn(session));
  const std::string second = LogIn("anna", "other horse");
  EXPECT_TRUE(guard_->WhoIn(second));
  Change([](Users& users) { users.clear(); });
  Pass(seconds(1));
  EXPECT_FALSE(guard_->WhoIn(second));
  EXPECT_FALSE(guard_->WhoseToken("its token"));
}

TEST_F(GuardTest, AFileThatCannotBeReadLocksNobodyOut) {
  const std::string session = LogIn("anna", "correct horse");
  std::ofstream(folder_ / "users") << "nonsense\n";
  for (int i = 0; i < 3; ++i) {
    Pass(seconds(1));
    EXPECT_TRUE(guard_->WhoIn(session));
  }
  EXPECT_EQ(complaints_, 1);
  EXPECT_FALSE(Guard::Open(folder_ / "users", [](const Error&) {}));
  std::ofstream(folder_ / "users") << "# nobody\n";
  EXPECT_EQ(Guard::Open(folder_ / "users", [](const Error&) {}).error().code, ErrorCode::kNotFound);
}

// The same for a name that is nobody's: who guesses does not learn which there are.
TEST_F(GuardTest, WhoGuessesWaitsLongerEachTime) {
  for (const char* name : {"anna", "nobody"}) {
    const std::string address = std::string("of ") + name;
    for (int i = 0; i < 6; ++i) {
      EXPECT_EQ(LogIn(name, "wrong", address), "");
      EXPECT_EQ(turned_.why, Turned::Why::kWrong) << name << i;
    }
    EXPECT_EQ(LogIn(name, "correct horse", address), "") << "even that";
    EXPECT_EQ(turned_.why, Turned::Why::kTooOften) << name;
    EXPECT_EQ(turned_.wait, seconds(1)) << name;
    EXPECT_EQ(LogIn(name, "correct horse", "192.0.2.77"), "") << "from elsewhere, too";
    EXPECT_EQ(turned_.why, Turned::Why::kTooOften) << name;
  }
  Pass(seconds(1));
  EXPECT_NE(LogIn("anna", "correct horse"), "");
}

TEST_F(GuardTest, WhoGuessesElsewhereKeepsNobodyOutWhereTheyLoggedInBefore) {
  ASSERT_NE(LogIn("anna", "correct horse", "desk"), "");
  for (int i = 0; i < 6; ++i) EXPECT_EQ(LogIn("anna", "wrong", "stranger"), "");
  EXPECT_EQ(LogIn("anna", "correct horse", "phone"), "");
  EXPECT_EQ(turned_.why, Turned::Why::kTooOften);
  EXPECT_NE(LogIn("anna", "correct horse", "desk"), "");
}

TEST_F(GuardTest, ANameThatIsNobodysIsHashedLikeAnother) {
  EXPECT_EQ(LogIn("nobody", "guess"), "");
  EXPECT_EQ(LogIn("wms", "guess"), "");
  EXPECT_EQ(LogIn("anna", "guess"), "");
  EXPECT_EQ(hashed_, 3);
}

// Users who are logged in are known while others' passwords are hashed, one at a time; few wait for
// that.
TEST_F(GuardTest, ManyAtOnceAreSentAwayAndHoldUpNobodyWhoIsIn) {
  const std::string session = LogIn("anna", "correct horse");
  Hold(true);
  constexpr int kMany = 20;
  std::atomic<int> busy{0};
  std::vector<std::thread> strangers;
  for (int i = 0; i < kMany; ++i) {
    strangers.emplace_back([&, i] {
      const auto in = guard_->LogIn("name" + std::to_string(i), "guess", std::to_string(i));
      const auto* turned = std::get_if<Turned>(&in);
      if (turned != nullptr && turned->why == Turned::Why::kBusy) ++busy;
    });
  }
  test::Await(
      [&] {
        EXPECT_TRUE(guard_->WhoIn(session));
        return busy >= kMany - Guard::kMostWaiting - 1 && hashed_ >= 2;
      },
      "those to be sent away who are too many");
  EXPECT_EQ(hashed_, 2) << "one of the strangers'";
  Hold(false);
  for (std::thread& stranger : strangers) stranger.join();
  EXPECT_EQ(busy, kMany - Guard::kMostWaiting - 1);
  EXPECT_EQ(hashed_, 2 + Guard::kMostWaiting);
}

TEST(Guard, HashesForItself) {
  const test::TempDir folder;
  ASSERT_TRUE(ChangeUsers(folder / "users", [](Users& users) -> Result<void> {
    users["anna"].password = HashPassword("correct horse").value();
    return {};
  }));
  const auto guard = Guard::Open(folder / "users", [](const Error&) {}).value();
  EXPECT_TRUE(std::holds_alternative<std::string>(guard->LogIn("anna", "correct horse", "desk")));
  EXPECT_TRUE(std::holds_alternative<Turned>(guard->LogIn("anna", "wrong horse", "desk")));
}

}  // namespace
}  // namespace trailcast::users
