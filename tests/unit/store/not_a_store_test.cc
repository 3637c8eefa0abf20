#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <map>
#include <random>

#include "services/store/route_store.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/store/pieces.h"

namespace trailcast::store {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string ReadFile(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

class NotAStore : public testing::Test {
 protected:
  void Write(const std::string& content) const {
    std::ofstream(file_, std::ios::binary) << content;
  }
  void Execute(const std::string& sql) const {
    sqlite3* db = nullptr;
    ASSERT_EQ(sqlite3_open(file_.c_str(), &db), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(db, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(db);
  }
  [[nodiscard]] std::map<std::string, std::string> Folder() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(dir_.path())) {
      files[entry.path().filename()] = entry.is_regular_file() ? ReadFile(entry.path()) : "";
    }
    return files;
  }
  // The message, with the folder proven to be as it was: same bytes, nothing new beside the file.
  [[nodiscard]] Error Refusal() const {
    const auto before = Folder();
    const auto store = OpenSqliteStore(file_);
    EXPECT_FALSE(store) << "opened";
    EXPECT_TRUE(Folder() == before) << "the folder was changed";
    if (store) return {};
    EXPECT_THAT(store.error().message, HasSubstr(file_.string()));
    return store.error();
  }

  test::TempDir dir_;
  const fs::path file_ = dir_ / "routes.db";
};

TEST_F(NotAStore, TextIsRefused) {
  Write("Buy milk.\n");
  EXPECT_EQ(Refusal().code, ErrorCode::kCorrupt);
  Write(std::string(10000, 'x'));
  EXPECT_THAT(Refusal().message, HasSubstr("is not a route store"));
}

TEST_F(NotAStore, RandomBytesAreRefused) {
  std::mt19937 random(1);
  std::string content(20000, '\0');
  for (char& byte : content) byte = static_cast<char>(random());
  Write(content);
  EXPECT_EQ(Refusal().code, ErrorCode::kCorrupt);
}

TEST_F(NotAStore, SomebodyElsesDatabaseIsRefused) {
  Execute("CREATE TABLE note (t TEXT); INSERT INTO note VALUES ('mine')");
  EXPECT_EQ(Refusal().code, ErrorCode::kCorrupt);
  Execute("PRAGMA journal_mode = WAL; INSERT INTO note VALUES ('too')");
  EXPECT_THAT(Refusal().message, HasSubstr("is not a route store"));
}

TEST_F(NotAStore, StoreOfAnotherVersionIsRefusedWithWhatToDo) {
  ASSERT_TRUE(OpenSqliteStore(file_));
  for (const char* version : {"6", "8"}) {
    Execute(std::string("PRAGMA user_version = ") + version);
    const Error error = Refusal();
    EXPECT_EQ(error.code, ErrorCode::kCorrupt);
    EXPECT_THAT(error.message, HasSubstr(std::string("has version ") + version +
                                         ", this program reads 7; teach its routes again, into "
                                         "another file"));
  }
}

TEST_F(NotAStore, StoreCutShortIsRefusedAtEveryLength) {
  ASSERT_TRUE(OpenSqliteStore(file_).value()->AppendSegments(Pieces({0, 1, 2, 3, 4, 5})));
  const std::string whole = ReadFile(file_);
  for (std::size_t length = whole.size() - 1; length > 0;
       length -= std::min<std::size_t>(length, 613)) {
    Write(whole.substr(0, length));
    ASSERT_EQ(Refusal().code, ErrorCode::kCorrupt) << "cut to " << length;
  }
}

TEST_F(NotAStore, FolderIsRefused) {
  fs::create_directory(file_);
  EXPECT_EQ(Refusal().code, ErrorCode::kCorrupt);
}

TEST_F(NotAStore, FolderThatDoesNotExistIsSaidToBeMissing) {
  const auto store = OpenSqliteStore(dir_ / "nowhere/routes.db");
  ASSERT_FALSE(store);
  EXPECT_EQ(store.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(store.error().message, HasSubstr("its folder must exist"));
}

// Root may write anywhere, so the test becomes somebody else for a moment.
class AsNobody {
 public:
  AsNobody() : was_root_(geteuid() == 0 && seteuid(65534) == 0) {}
  ~AsNobody() {
    if (was_root_ && seteuid(0) != 0) std::abort();
  }
  AsNobody(const AsNobody&) = delete;
  AsNobody& operator=(const AsNobody&) = delete;

 private:
  bool was_root_;
};

TEST_F(NotAStore, FolderThatCannotBeWrittenIsUnavailable) {
  fs::permissions(dir_.path(), fs::perms(0555));
  {
    const AsNobody nobody;
    const Error error = Refusal();
    EXPECT_EQ(error.code, ErrorCode::kUnavailable);
    EXPECT_THAT(error.message, HasSubstr("Permission denied"));
  }
  fs::permissions(dir_.path(), fs::perms(0755));
}

TEST_F(NotAStore, StoreInAFolderThatHasBecomeReadOnlyIsUnavailable) {
  ASSERT_TRUE(OpenSqliteStore(file_));
  fs::permissions(file_, fs::perms(0666));
  fs::permissions(dir_.path(), fs::perms(0555));
  {
    const AsNobody nobody;
    EXPECT_EQ(Refusal().code, ErrorCode::kUnavailable);
  }
  fs::permissions(dir_.path(), fs::perms(0755));
}

TEST_F(NotAStore, EmptyFileBecomesAStore) {
  Write("");
  EXPECT_TRUE(OpenSqliteStore(file_));
}

}  // namespace
}  // namespace trailcast::store
