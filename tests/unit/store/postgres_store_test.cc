// These test what a store in PostgreSQL promises beyond the contract of all stores.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <array>
#include <pqxx/pqxx>
#include <thread>

#include "services/store/open_store.h"
#include "services/store/postgres_url.h"
#include "services/store/src/postgres/postgres_schema.h"
#include "tests/support/await.h"
#include "tests/support/postgres_server.h"
#include "tests/unit/store/pieces.h"

namespace trailcast::store {
namespace {

using test::PostgresServer;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string MessageOf(const Result<std::unique_ptr<RouteStore>>& opened) {
  return opened ? "opened" : opened.error().message;
}

route::RouteInfo Deleted(route::RouteInfo info) {
  info.standing = route::Standing::kDeleted;
  ++info.edition;
  return info;
}

class PostgresStore : public testing::Test {
 protected:
  [[nodiscard]] std::unique_ptr<RouteStore> Open() const { return OpenPostgresStore(url_).value(); }
  [[nodiscard]] int Count(const std::string& table) const {
    pqxx::connection connection(url_);
    return pqxx::nontransaction(connection)
        .exec1("SELECT count(*) FROM trailcast." + table)[0]
        .as<int>();
  }
  void Execute(const std::string& sql) const { PostgresServer::Execute(url_, sql); }

  std::string url_ = PostgresServer::Shared().CreateDatabase();
};

TEST_F(PostgresStore, WhatIsWrongIsSaidAndThePasswordIsNot) {
  PostgresServer& server = PostgresServer::Shared();
  const auto wrong = OpenStore(server.Url("postgres", "guess-work"));
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(wrong.error().message, AllOf(HasSubstr("password authentication failed"),
                                           HasSubstr("~/.pgpass"), Not(HasSubstr("guess-work"))));
  const auto missing = OpenStore(server.Url("nowhere"));
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(missing.error().message,
              AllOf(HasSubstr("createdb"), Not(HasSubstr(PostgresServer::kPassword))));
  const auto nobody = OpenStore("postgresql://u:guess-work@localhost:1/routes");
  ASSERT_FALSE(nobody);
  EXPECT_EQ(nobody.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(nobody.error().message,
              AllOf(HasSubstr("postgresql://u@localhost:1/routes"),
                    HasSubstr("is PostgreSQL running there"), Not(HasSubstr("guess-work"))));
  for (const char* url : {"postgresql://u:guess@work@h/r", "postgresql://u:guess/work@h/r",
                          "postgresql://u:guess:work@h/r", "postgresql://u:guess-work@h:99999/r",
                          "postgresql://h/r?password=guess-work&pass=guess-work"}) {
    const auto refused = OpenStore(url);
    ASSERT_FALSE(refused) << url;
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
    EXPECT_THAT(refused.error().message, AllOf(HasSubstr("expected postgresql://"),
                                               Not(HasSubstr("guess")), Not(HasSubstr("work"))));
  }
}

TEST_F(PostgresStore, ALimitIsRefusedAsItWouldNotHold) {
  EXPECT_THAT(MessageOf(OpenStore(url_, {.max_bytes = 1})), HasSubstr("takes no limit"));
}

TEST_F(PostgresStore, OtherVersionsAndEncodingsAreRefused) {
  EXPECT_THAT(CheckServer(9'06'00, "UTF8", "db").error().message,
              AllOf(HasSubstr("version 9"), HasSubstr("expected 13")));
  const std::string latin =
      PostgresServer::Shared().CreateDatabase("ENCODING 'LATIN1' LOCALE 'C' TEMPLATE template0");
  EXPECT_THAT(MessageOf(OpenStore(latin)), HasSubstr("is in LATIN1, expected UTF8"));
  (void)Open();
  Execute("UPDATE trailcast.store SET version = 77");
  EXPECT_THAT(MessageOf(OpenStore(url_)), HasSubstr("has version 77, this program reads 4"));
}

TEST_F(PostgresStore, OpenedForReadingItWritesNothing) {
  EXPECT_THAT(MessageOf(OpenPostgresStore(url_, {.read_only = true})),
              HasSubstr("there is none in this database"));
  ASSERT_TRUE(Open()->PutRoute(Complete(1)));
  const auto store = OpenPostgresStore(url_, {.read_only = true}).value();
  EXPECT_EQ(store->FindRoute(kYard).value(), Complete(1));
  EXPECT_FALSE(store->AppendSegments(Pieces({0})));
  EXPECT_THAT(store->HeldSegments(kYard).value(), IsEmpty());
}

TEST_F(PostgresStore, ServersThatStartAtOnceMakeTheTablesOnce) {
  std::array<Result<std::unique_ptr<RouteStore>>, 4> opened;
  {
    std::vector<std::jthread> threads;
    threads.reserve(opened.size());
    for (auto& each : opened) threads.emplace_back([&] { each = OpenStore(url_); });
  }
  for (const auto& each : opened) EXPECT_EQ(MessageOf(each), "opened");
  EXPECT_EQ(Count("store"), 1);
}

TEST_F(PostgresStore, RevisionsShareTheBytesThatTheyHaveInCommon) {
  const auto store = Open();
  auto other = Pieces({0, 1, 2});
  for (route::SegmentPiece& piece : other) piece.key.teaching = TeachingId(2);
  ASSERT_TRUE(store->AppendSegments(Pieces({0, 1, 2, 3})));
  ASSERT_TRUE(store->AppendSegments(other));
  EXPECT_EQ(Count("segment"), 7);
  EXPECT_EQ(Count("content"), 4);
  ASSERT_TRUE(store->PutRoute(Deleted(Teaching(4))));
  EXPECT_EQ(Count("content"), 3) << "what the other revision has stays";
  EXPECT_EQ(store->ReadSegment(other[2].key, SegmentIndex(2)).value(), other[2]);
  route::RouteInfo second = Deleted(Teaching(3));
  second.key.teaching = TeachingId(2);
  ASSERT_TRUE(store->PutRoute(second));
  EXPECT_EQ(Count("content"), 0);
}

TEST_F(PostgresStore, DamageIsFoundAndStoringAgainMendsIt) {
  const auto store = Open();
  ASSERT_TRUE(store->AppendSegments(Pieces({0, 1, 2})));
  ASSERT_TRUE(store->PutRoute(Complete(3)));
  Execute(
      "UPDATE trailcast.content SET bytes = set_byte(bytes, 7, 255 - get_byte(bytes, 7)) "
      "WHERE digest = (SELECT digest FROM trailcast.segment WHERE number = 1)");
  Execute("UPDATE trailcast.segment SET number = 9 WHERE number = 2");
  Execute("UPDATE trailcast.route SET scout = 'scout-2'");
  EXPECT_EQ(store->ReadSegment(kYard, SegmentIndex(1)).error().code, ErrorCode::kCorrupt);
  EXPECT_EQ(store->ReadSegment(kYard, SegmentIndex(9)).error().code, ErrorCode::kCorrupt);
  EXPECT_EQ(store->FindRoute(kYard).error().code, ErrorCode::kCorrupt);
  EXPECT_EQ(store->Verify().value().size(), 3U);
  Execute("DELETE FROM trailcast.segment WHERE number = 9");
  ASSERT_TRUE(store->AppendSegments(Pieces({0, 1, 2})));
  ASSERT_TRUE(store->PutRoute(Complete(3)));
  EXPECT_EQ(store->ReadSegment(kYard, SegmentIndex(1)).value(), Piece(1));
  EXPECT_THAT(store->Verify().value(), IsEmpty());
}

// Each appends and labels as fast as it can; the others do so of the same revisions.
TEST_F(PostgresStore, ServersWritingTheSameAtOnceAgree) {
  constexpr std::uint32_t kServers = 3;
  constexpr std::uint32_t kBatches = 20;
  std::vector<std::string> errors(kServers);
  const auto write = [&](std::uint32_t server) {
    const auto store = Open();
    for (std::uint32_t i = 0; i < kBatches; ++i) {
      const auto pieces = Pieces({2 * i, 2 * i + 1});
      if (auto done = store->AppendSegments(pieces); !done) errors[server] = done.error().message;
      route::SegmentPiece other = pieces.front();
      other.key.teaching = TeachingId(2 + (i + server) % 2);
      if (auto done = store->AppendSegments({&other, 1}); !done) {
        errors[server] = done.error().message;
      }
      route::RouteInfo info = Teaching(2 * i + 2);
      info.edition = kServers * i + server;
      info.description = fmt::format("{}", info.edition);
      if (auto done = store->PutRoute(info); !done) errors[server] = done.error().message;
      info.key.teaching = TeachingId(2 + i % 2);
      if (i + 2 < kBatches) continue;
      if (auto done = store->PutRoute(Deleted(info)); !done) errors[server] = done.error().message;
    }
  };
  {
    std::vector<std::jthread> threads;
    for (std::uint32_t server = 0; server < kServers; ++server) threads.emplace_back(write, server);
  }
  for (const std::string& error : errors) {
    EXPECT_TRUE(error.empty() || error.find("was deleted and takes no segments") != error.npos)
        << error;
  }
  const auto store = Open();
  EXPECT_EQ(store->HeldSegments(kYard).value().size(), 2 * kBatches);
  const auto info = store->FindRoute(kYard).value();
  ASSERT_TRUE(info);
  EXPECT_EQ(info->segment_count, 2 * kBatches);
  EXPECT_EQ(info->edition, kServers * kBatches - 1) << "the last edition, whoever came last";
  EXPECT_THAT(store->Verify().value(), IsEmpty());
  EXPECT_EQ(Count("segment"), 2 * static_cast<int>(kBatches)) << "none of what was deleted";
  EXPECT_EQ(Count("content"), 2 * static_cast<int>(kBatches));
}

TEST_F(PostgresStore, OfTwoThatGiveOneSegmentOtherBytesOneIsRefused) {
  std::array<Result<void>, 2> appended;
  for (std::uint32_t index = 0; index < 20; ++index) {
    {
      const auto append = [&](std::uint32_t salt) {
        appended[salt] = Open()->AppendSegments(std::vector{Piece(index, salt)});
      };
      const std::jthread other(append, 1U);
      append(0);
    }
    ASSERT_NE(appended[0].has_value(), appended[1].has_value());
    const std::uint32_t winner = appended[0] ? 0 : 1;
    EXPECT_EQ(appended[1 - winner].error().code, ErrorCode::kConflict);
    EXPECT_EQ(Open()->ReadSegment(kYard, SegmentIndex(index)).value(), Piece(index, winner));
  }
}

TEST_F(PostgresStore, WhatIsDoneExclusivelyIsDoneByOneAtATimeAndAllOrNothing) {
  constexpr std::uint32_t kTimes = 20;
  ASSERT_TRUE(Open()->PutRoute(Complete(1)));
  const auto count_up = [&] {
    const auto store = Open();
    for (std::uint32_t i = 0; i < kTimes; ++i) {
      EXPECT_TRUE(store->Exclusively([&]() -> Result<void> {
        route::RouteInfo info = *store->FindRoute(kYard).value();
        ++info.edition;
        return store->PutRoute(info);
      }));
    }
  };
  {
    const std::jthread other(count_up);
    count_up();
  }
  const auto store = Open();
  EXPECT_EQ(store->FindRoute(kYard).value()->edition, 2 * kTimes);
  EXPECT_FALSE(store->Exclusively([&]() -> Result<void> {
    EXPECT_TRUE(store->AppendSegments(Pieces({0})));
    EXPECT_TRUE(store->RememberAnswer("operator/1", "changed"));
    return Fail(ErrorCode::kConflict, "thought better of it");
  }));
  EXPECT_THAT(store->HeldSegments(kYard).value(), IsEmpty());
  EXPECT_EQ(store->FindAnswer("operator/1").value(), std::nullopt);
  ASSERT_TRUE(store->RememberAnswer("operator/1", "changed"));
  EXPECT_EQ(Open()->FindAnswer("operator/1").value(), "changed");
}

TEST(PostgresStoreSilence, AServerThatHangsIsTakenForLostAndTakenUpAgain) {
  PostgresServer server;
  PostgresOptions options;
  options.patience = std::chrono::milliseconds(3000);  // for one that is busy, too
  const auto store = OpenPostgresStore(server.CreateDatabase(), options).value();
  ASSERT_TRUE(store->AppendSegments(Pieces({0})));
  server.Freeze();
  const auto began = std::chrono::steady_clock::now();
  const auto refused = store->AppendSegments(Pieces({1}));
  const auto took = std::chrono::steady_clock::now() - began;
  server.Thaw();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kUnavailable) << refused.error().message;
  EXPECT_GE(took, options.patience);
  EXPECT_LT(took, test::kLongEnough);
  test::Await([&] { return store->AppendSegments(Pieces({1})).has_value(); }, "PostgreSQL is back");
  EXPECT_EQ(store->HeldSegments(kYard).value(), Indices({0, 1}));
}

TEST(PostgresStoreRestart, GoesOnWhenPostgresIsBackAndSaysWhileItIsNot) {
  PostgresServer server(PostgresServer::Sync::kOn);
  const std::string url = server.CreateDatabase();
  const auto store = OpenPostgresStore(url).value();
  ASSERT_TRUE(store->AppendSegments(Pieces({0})));
  server.Stop(SIGINT);
  server.Start();
  EXPECT_TRUE(store->AppendSegments(Pieces({1}))) << "back before anybody asked";
  server.Stop(SIGKILL);
  for (int time = 0; time < 2; ++time) {
    const auto refused = store->AppendSegments(Pieces({2}));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kUnavailable);
    EXPECT_THAT(refused.error().message, HasSubstr("is PostgreSQL running there"));
    EXPECT_EQ(store->HeldSegments(kYard).error().code, ErrorCode::kUnavailable);
  }
  server.Start();
  test::Await([&] { return store->AppendSegments(Pieces({2})).has_value(); }, "PostgreSQL is back");
  EXPECT_EQ(store->HeldSegments(kYard).value(), Indices({0, 1, 2}));
  EXPECT_THAT(store->Verify().value(), IsEmpty());
}

}  // namespace
}  // namespace trailcast::store
