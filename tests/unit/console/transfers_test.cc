// Routes as files, over HTTP, to and from a server in this process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <thread>

#include "services/archive/route_file.h"
#include "services/archive/route_file_writer.h"
#include "services/console/web.h"
#include "services/exchange/in_process_exchange.h"
#include "services/fleet/routes/route_export.h"
#include "services/route/digest.h"
#include "services/store/route_store.h"
#include "tests/support/await.h"
#include "tests/support/keeper_thread.h"
#include "tests/support/taught_route.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/console/replied.h"

namespace trailcast::console {
namespace {

using archive::RouteFile;
using archive::RouteFileWriter;
using nlohmann::json;
using std::chrono::milliseconds;
using std::chrono::steady_clock;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class TransfersTest : public testing::Test {
 protected:
  void Hold(const test::TaughtRoute& taught) {
    ASSERT_TRUE(store_->AppendSegments(taught.pieces));
    ASSERT_TRUE(store_->PutRoute(taught.info));
  }
  void Serve() { server_ = test::KeepRoutes(bus_, *store_); }
  std::string FileOf(const test::TaughtRoute& taught) {
    const auto path = folder_ / "given.trailcast";
    auto writer = RouteFileWriter::Create(path, taught.info, RouteFileWriter::Existing::kReplace);
    EXPECT_TRUE(writer);
    for (const auto& piece : taught.pieces) EXPECT_TRUE(writer->Add(piece));
    EXPECT_TRUE(writer->Finish());
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  [[nodiscard]] httplib::Client Client() const {
    return ClientOf(web_->port(), std::chrono::seconds(20));
  }
  [[nodiscard]] Replied Upload(const std::string& bytes) const {
    return ReplyOf(Client().Post("/api/transfers/uploads", bytes, "application/octet-stream"));
  }
  // Returns the transfer as it is once it is over.
  [[nodiscard]] json AtItsEnd(const json& begun) const {
    const std::string path = "/api/transfers/" + begun.value("transfer", "none");
    Replied now;
    test::Await(
        [&] {
          now = ReplyOf(Client().Get(path));
          return now.status != 200 || now.body["state"] != "under way";
        },
        "the transfer's end");
    return now.body;
  }

  test::TempDir folder_;
  std::unique_ptr<store::RouteStore> store_ = store::OpenSqliteStore(folder_ / "routes.db").value();
  exchange::InProcessBus bus_;
  std::jthread server_;
  Desk desk_{AgentId("desk"), bus_.Open(ConsoleTopics()),
             Desk::Options{.answer_within = milliseconds(200), .reply_within = milliseconds(5000)}};
  Atlas atlas_{[this]() -> Result<fleet::OperatorPeer> {
    return fleet::OperatorPeer{AgentId("desk-map"), bus_.Open(fleet::ExporterTopics())};
  }};
  std::unique_ptr<Web> web_ = Web::Open(desk_, atlas_, nullptr, "localhost", 0, {}, {},
                                        [this](const exchange::TopicUse& use) {
                                          return Result<fleet::OperatorPeer>(fleet::OperatorPeer{
                                              AgentId("courier"), bus_.Open(use)});
                                        })
                                  .value();
};

TEST_F(TransfersTest, ARouteIsDownloadedWhole) {
  const test::TaughtRoute taught = test::TeachSamples(30);
  Hold(taught);
  Serve();
  const json wanted{{"route", taught.info.key.route.value()}, {"teaching", "2"}};
  const Replied begun = ReplyOf(Client().Post("/api/transfers", wanted.dump(), "application/json"));
  ASSERT_EQ(begun.status, 202) << begun.body;
  EXPECT_EQ(begun.body["total_bytes"], taught.info.bytes);
  const json end = AtItsEnd(begun.body);
  ASSERT_EQ(end["state"], "done") << end;
  EXPECT_EQ(end["done_bytes"], taught.info.bytes);
  const auto got = Client().Get("/api/transfers/" + end["transfer"].get<std::string>() + "/file");
  ASSERT_TRUE(got);
  EXPECT_THAT(got->get_header_value("Content-Disposition"), HasSubstr("hall-r2.trailcast"));
  const auto file = RouteFile::Open(
      std::span(reinterpret_cast<const std::uint8_t*>(got->body.data()), got->body.size()));
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->info().manifest_digest, taught.info.manifest_digest);

  const auto post = [&](const json& body) {
    return ReplyOf(Client().Post("/api/transfers", body.dump(), "application/json")).status;
  };
  EXPECT_EQ(post({{"route", taught.info.key.route.value()}, {"teaching", "3"}}), 404);
  EXPECT_EQ(post({{"route", "hall"}, {"teaching", "2"}}), 400);
  EXPECT_EQ(post({{"route", taught.info.key.route.value()}, {"teaching", "x"}}), 400);
  EXPECT_EQ(Client().Get("/api/transfers/0123456789abcdef")->status, 404);
  EXPECT_EQ(Client().Get("/api/transfers/0123456789abcdef/file")->status, 404);
}

TEST_F(TransfersTest, ARouteIsUploadedAndDelivered) {
  Serve();
  const test::TaughtRoute taught = test::TeachSamples(30, 40);
  const std::string file = FileOf(taught);
  ASSERT_GT(file.size(), 64U << 10U) << "more than other requests may bring";
  const Replied begun = Upload(file);
  ASSERT_EQ(begun.status, 202) << begun.body;
  const json end = AtItsEnd(begun.body);
  ASSERT_EQ(end["state"], "done") << end;
  EXPECT_EQ(end["route"], "hall");
  EXPECT_THAT(end["detail"].get<std::string>(), HasSubstr("is there now: server 'barn'"));
  const auto known = store_->FindRoute(taught.info.key);
  ASSERT_TRUE(known && *known);
  EXPECT_EQ((*known)->state, route::RouteState::kComplete);
  EXPECT_THAT(AtItsEnd(Upload(file).body)["detail"].get<std::string>(),
              HasSubstr("was there already"));
}

TEST_F(TransfersTest, WhatIsNoRouteFileIsRefusedAndHarmsNobody) {
  Serve();
  const std::string file = FileOf(test::TeachSamples(3));
  for (const std::string& bytes : {std::string("no route"), file.substr(0, file.size() / 2)}) {
    const Replied begun = Upload(bytes);
    ASSERT_EQ(begun.status, 202) << begun.body;
    const json end = AtItsEnd(begun.body);
    EXPECT_EQ(end["state"], "failed");
    EXPECT_THAT(end["detail"].get<std::string>(),
                AllOf(HasSubstr("no whole route file"), HasSubstr("the file"), Not(HasSubstr("/"))))
        << "nothing of this machine";
  }
  EXPECT_EQ(ReplyOf(Client().Post("/api/transfers/uploads", file, "text/plain")).status, 415);
  EXPECT_EQ(AtItsEnd(Upload(file).body)["state"], "done");
}

}  // namespace
}  // namespace trailcast::console
