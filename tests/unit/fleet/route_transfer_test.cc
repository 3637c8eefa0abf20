// Routes to files and back, over the bus of one process and with stores.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <thread>

#include "services/archive/route_file.h"
#include "services/catalog/catalog.h"
#include "services/exchange/in_process_exchange.h"
#include "services/exchange/publish.h"
#include "services/exchange/route_keeper.h"
#include "services/fleet/routes/route_export.h"
#include "services/fleet/routes/route_import.h"
#include "services/fleet/routes/route_study.h"
#include "services/fleet/routes/route_summary.h"
#include "services/route/digest.h"
#include "services/route/labels.h"
#include "services/store/route_store.h"
#include "tests/support/keeper_thread.h"
#include "tests/support/taught_route.h"
#include "tests/support/temp_dir.h"

namespace trailcast::fleet {
namespace {

using archive::RouteFile;
using archive::RouteFileWriter;
using std::chrono::milliseconds;
using test::TaughtRoute;
using test::TeachSamples;
using testing::AllOf;
using testing::HasSubstr;

// The same id and revision, taught elsewhere.
TaughtRoute AnotherTeaching(std::uint32_t segments) { return TeachSamples(segments, 3); }

class RouteTransferTest : public testing::Test {
 protected:
  void Serve() { server_ = test::KeepRoutes(bus_, *store_); }
  void StopServer() { server_ = {}; }

  // Puts into the server's store what it holds from before.
  void Hold(const TaughtRoute& taught, std::size_t segments) {
    ASSERT_TRUE(store_->AppendSegments({taught.pieces.data(), segments}));
  }
  void Hold(const TaughtRoute& taught) {
    Hold(taught, taught.pieces.size());
    ASSERT_TRUE(store_->PutRoute(taught.info));
  }

  [[nodiscard]] std::filesystem::path Path(const std::string& name) const { return folder_ / name; }
  RouteFileWriter Writer(const std::string& name, const route::RouteInfo& info) {
    return RouteFileWriter::Create(Path(name), info, RouteFileWriter::Existing::kKeep).value();
  }
  RouteFile FileOf(const TaughtRoute& taught) {
    RouteFileWriter writer = Writer("given.trailcast", taught.info);
    for (const auto& piece : taught.pieces) EXPECT_TRUE(writer.Add(piece));
    EXPECT_TRUE(writer.Finish());
    return RouteFile::Open(Path("given.trailcast")).value();
  }
  [[nodiscard]] std::string Bytes(const std::string& name) const {
    std::ifstream in(Path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  Result<Imported> Import(const RouteFile& file, milliseconds timeout = milliseconds(20'000)) {
    OperatorPeer peer{AgentId("operator-1"), bus_.Open(ImporterTopics())};
    TransferWatch watch;
    watch.timeout = timeout;
    return ImportToServer(file, peer, watch);
  }
  Result<std::uint64_t> Export(const route::RouteInfo& info, const TransferWatch& watch) {
    OperatorPeer peer{AgentId("operator-2"), bus_.Open(ExporterTopics())};
    return ExportFromServer(peer, info, Writer("fetched.trailcast", info), watch);
  }

  test::TempDir folder_;
  std::unique_ptr<store::RouteStore> store_ = store::OpenSqliteStore(folder_ / "server.db").value();
  exchange::InProcessBus bus_;
  std::jthread server_;
};

TEST_F(RouteTransferTest, ARouteGoesToAServerAndComesBackByteForByte) {
  const RouteFile file = FileOf(TeachSamples(300, 2));
  Serve();
  const auto imported = Import(file);
  ASSERT_TRUE(imported) << imported.error().message;
  EXPECT_FALSE(imported->was_there);
  EXPECT_EQ(imported->holder, "server 'barn'");
  std::atomic<std::uint64_t> seen{0};
  TransferWatch watch;
  watch.progress = [&seen](std::uint64_t done) { seen = done; };
  const auto exported = Export(file.info(), watch);
  ASSERT_TRUE(exported) << exported.error().message;
  EXPECT_EQ(*exported, file.file_bytes());
  EXPECT_EQ(seen, file.info().bytes);
  EXPECT_EQ(Bytes("fetched.trailcast"), Bytes("given.trailcast"));
  StopServer();
  const auto held = store_->FindRoute(file.info().key).value();
  ASSERT_TRUE(held);
  EXPECT_TRUE(route::SameTeaching(*held, file.info()));
}

TEST_F(RouteTransferTest, ARouteIsLookedIntoWhereItIs) {
  const TaughtRoute taught = TeachSamples(5, 2);
  Hold(taught);
  Serve();
  OperatorPeer peer{AgentId("operator-3"), bus_.Open(exchange::FollowerTopics())};
  const auto study = StudyRoute(peer, taught.info, {});
  ASSERT_TRUE(study) << study.error().message;
  // Samples are of noise: none is like the next.
  ASSERT_FALSE(study->weak_places.empty());
  EXPECT_EQ(study->weak_places.front().begin, 0.0);
  EXPECT_LE(study->weak_places.back().end, taught.info.length_m + 1e-9);
}

TEST_F(RouteTransferTest, WhatTheServerHasAlreadyIsSaidToBeThere) {
  const TaughtRoute taught = TeachSamples(4);
  Hold(taught);
  Serve();
  const auto imported = Import(FileOf(taught));
  ASSERT_TRUE(imported) << imported.error().message;
  EXPECT_TRUE(imported->was_there);
}

TEST_F(RouteTransferTest, WhatAnOperatorDeletedThereIsRefused) {
  const TaughtRoute taught = TeachSamples(4);
  route::RouteInfo tombstone = taught.info;
  tombstone.standing = route::Standing::kDeleted;
  tombstone.edition = 1;
  ASSERT_TRUE(store_->PutRoute(tombstone));
  Serve();
  const auto imported = Import(FileOf(taught));
  ASSERT_FALSE(imported);
  EXPECT_EQ(imported.error().code, ErrorCode::kConflict);
  EXPECT_THAT(imported.error().message, HasSubstr("deleted"));
}

TEST_F(RouteTransferTest, UnderAnotherNameItIsThereTooOrInConflict) {
  TaughtRoute renamed = TeachSamples(4, 1, "lobby");
  Hold(renamed);
  Serve();
  const auto same = Import(FileOf(TeachSamples(4)));
  ASSERT_TRUE(same) << same.error().message;
  EXPECT_TRUE(same->was_there);
  std::filesystem::remove(Path("given.trailcast"));
  const auto other = Import(FileOf(AnotherTeaching(4)));
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().code, ErrorCode::kConflict);
}

TEST_F(RouteTransferTest, WhatTheServerHasInPartIsFilledUp) {
  const TaughtRoute taught = TeachSamples(6);
  Hold(taught, 3);
  Serve();
  const auto imported = Import(FileOf(taught));
  ASSERT_TRUE(imported) << imported.error().message;
  EXPECT_FALSE(imported->was_there);
  StopServer();
  EXPECT_EQ(store_->HeldSegments(taught.info.key).value().size(), 6U);
}

TEST_F(RouteTransferTest, AnotherTeachingUnderTheSameIdIsAConflict) {
  Hold(AnotherTeaching(4));
  Serve();
  const auto imported = Import(FileOf(TeachSamples(4)));
  ASSERT_FALSE(imported);
  EXPECT_EQ(imported.error().code, ErrorCode::kConflict);
  EXPECT_THAT(imported.error().message,
              AllOf(HasSubstr("server 'barn' has other segments"), HasSubstr("'hall'"),
                    HasSubstr("00112233445566778899aabbccddeeff"), HasSubstr("revision 2")));
  StopServer();
  EXPECT_EQ(store_->FindRoute(TeachSamples(1).info.key).value(), AnotherTeaching(4).info);
}

TEST_F(RouteTransferTest, PartOfAnotherTeachingIsAConflictToo) {
  Hold(AnotherTeaching(4), 2);
  Serve();
  const auto imported = Import(FileOf(TeachSamples(4)), milliseconds(3000));
  ASSERT_FALSE(imported);
  EXPECT_EQ(imported.error().code, ErrorCode::kConflict);
  EXPECT_THAT(imported.error().message, HasSubstr("server 'barn' has other segments"));
}

TEST_F(RouteTransferTest, NoServerIsTold) {
  const auto imported = Import(FileOf(TeachSamples(2)), milliseconds(150));
  ASSERT_FALSE(imported);
  EXPECT_EQ(imported.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(imported.error().message, HasSubstr("no route server answered"));
}

TEST_F(RouteTransferTest, AServerThatFallsSilentIsTold) {
  // It answers the catalog's question, and nothing else.
  server_ = std::jthread([this](const std::stop_token& stop) {
    const auto exchange = bus_.Open(exchange::ServerTopics());
    while (!stop.stop_requested()) {
      for (const exchange::Message& message : exchange->Take(milliseconds(5))) {
        const auto* request = std::get_if<exchange::CatalogRequest>(&message);
        if (request != nullptr) {
          (void)exchange->Publish(catalog::Answer(*request, AgentId("barn"), *store_));
        }
      }
    }
  });
  const auto imported = Import(FileOf(TeachSamples(2)), milliseconds(3000));
  ASSERT_FALSE(imported);
  EXPECT_EQ(imported.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(imported.error().message, HasSubstr("confirmed 0 of 2 segments"));
}

TEST_F(RouteTransferTest, AnExportThatNobodyAnswersOrThatIsStoppedLeavesNoFile) {
  TransferWatch watch;
  watch.timeout = milliseconds(150);
  const route::RouteInfo info = TeachSamples(3).info;
  const auto alone = Export(info, watch);
  ASSERT_FALSE(alone);
  EXPECT_EQ(alone.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(alone.error().message, HasSubstr("0 of 3 segments"));
  watch.timeout = milliseconds(20'000);
  watch.stop = [] { return true; };
  EXPECT_THAT(Export(info, watch).error().message, HasSubstr("interrupted"));
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    EXPECT_THAT(entry.path().string(), testing::Not(HasSubstr("trailcast.")));
    EXPECT_NE(entry.path().filename(), "fetched.trailcast");
  }
}

TEST_F(RouteTransferTest, AStoreTakesARouteUpAndGivesItBack) {
  const RouteFile file = FileOf(TeachSamples(5));
  const auto imported = ImportIntoStore(file, *store_, "route store x");
  ASSERT_TRUE(imported) << imported.error().message;
  EXPECT_FALSE(imported->was_there);
  ASSERT_TRUE(ExportFromStore(*store_, file.info(), Writer("fetched.trailcast", file.info())));
  EXPECT_EQ(Bytes("fetched.trailcast"), Bytes("given.trailcast"));
  EXPECT_TRUE(ImportIntoStore(file, *store_, "route store x").value().was_there);
}

TEST_F(RouteTransferTest, AStoreKeepsWhatItHas) {
  const RouteFile file = FileOf(TeachSamples(4));
  Hold(AnotherTeaching(4), 4);
  const auto part = ImportIntoStore(file, *store_, "route store x");
  ASSERT_FALSE(part);
  EXPECT_EQ(part.error().code, ErrorCode::kConflict);
  EXPECT_FALSE(store_->FindRoute(file.info().key).value());
  Hold(AnotherTeaching(4));
  const auto whole = ImportIntoStore(file, *store_, "route store x");
  ASSERT_FALSE(whole);
  EXPECT_EQ(whole.error().code, ErrorCode::kConflict);
  EXPECT_THAT(whole.error().message, HasSubstr("route store x has other segments"));
}

TEST_F(RouteTransferTest, AFileIsDescribedForPeopleAndPrograms) {
  const RouteFile file = FileOf(TeachSamples(2));
  EXPECT_THAT(FileText("hall.trailcast", file),
              AllOf(HasSubstr("hall.trailcast is whole"), HasSubstr("hall revision 2"),
                    HasSubstr("2023-11-14 22:13 UTC by scout-1"), HasSubstr("east night"),
                    HasSubstr("48.25 N, 11.5 E")));
  const auto given = FileJson("a", RouteFile::Open(Path("given.trailcast")));
  EXPECT_EQ(given["whole"], true);
  EXPECT_EQ(given["route"]["segments"], 2);
  const auto absent = FileJson("a", RouteFile::Open(Path("absent")));
  EXPECT_EQ(absent["whole"], false);
  EXPECT_THAT(absent["error"].get<std::string>(), HasSubstr("No such file"));
}

}  // namespace
}  // namespace trailcast::fleet
