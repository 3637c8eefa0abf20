// Files that people upload, and the places that these take.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "services/console/runs.h"
#include "services/console/src/api/incoming_file.h"
#include "services/console/web.h"
#include "services/exchange/in_process_exchange.h"
#include "services/fleet/routes/route_export.h"
#include "tests/support/await.h"
#include "tests/support/described.h"
#include "tests/support/strangers/hostile_client.h"
#include "tests/support/temp_dir.h"

namespace trailcast::console {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// Where this process has its temporary files meanwhile.
class TemporaryFolder {
 public:
  TemporaryFolder() { setenv("TMPDIR", folder_.path().c_str(), 1); }
  ~TemporaryFolder() {
    if (before_) {
      setenv("TMPDIR", before_->c_str(), 1);
    } else {
      unsetenv("TMPDIR");
    }
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  // Nothing can be written to what programs have made here.
  void Empty() const {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_.path())) {
      fs::remove_all(entry);
    }
  }

 private:
  const std::optional<std::string> before_ =
      std::getenv("TMPDIR") == nullptr ? std::nullopt : std::optional(std::getenv("TMPDIR"));
  const test::TempDir folder_;
};

constexpr std::size_t kPlaces = 2;
static_assert(Runs::kMostUploadsAtOnce == kPlaces && Transfers::kMostAtOnce == kPlaces);

// By where they are uploaded to.
class UploadsTest : public testing::TestWithParam<const char*> {
 protected:
  // Its status, and its body.
  [[nodiscard]] std::pair<int, std::string> Upload() const {
    httplib::Client client("localhost", web_->port());
    client.set_logger(ExpectAsDescribed());
    client.set_read_timeout(test::kLongEnough);
    const auto got = client.Post(GetParam(), "no such file", "application/octet-stream");
    return got ? std::pair(got->status, got->body) : std::pair(0, httplib::to_string(got.error()));
  }

  TemporaryFolder temporary_;
  exchange::InProcessBus bus_;
  Desk desk_{AgentId("desk"), bus_.Open(ConsoleTopics())};
  Atlas atlas_{[this]() -> Result<fleet::OperatorPeer> {
    return fleet::OperatorPeer{AgentId("desk-map"), bus_.Open(fleet::ExporterTopics())};
  }};
  Runs runs_{""};
  std::unique_ptr<Web> web_ = Web::Open(
                                  desk_, atlas_, nullptr, "localhost", 0, {}, {},
                                  [](const exchange::TopicUse&) -> Result<fleet::OperatorPeer> {
                                    return Fail(ErrorCode::kUnavailable, "no network");
                                  },
                                  &runs_)
                                  .value();
};

TEST_P(UploadsTest, ThatBreaksOffGivesItsPlaceBack) {
  std::vector<std::unique_ptr<test::RawConnection>> halves;
  const auto begin_all = [&] {
    halves.clear();
    for (std::size_t i = 0; i < kPlaces; ++i) {
      halves.push_back(std::make_unique<test::RawConnection>(web_->port()));
      halves.back()->Send(fmt::format(
          "POST {} HTTP/1.1\r\nHost: localhost:{}\r\nContent-Type: application/octet-stream\r\n"
          "Content-Length: 100000\r\n\r\nthe beginning",
          GetParam(), web_->port()));
    }
  };
  // An upload that is taken was there before a half, which is then refused or has waited too long.
  ASSERT_TRUE(test::Await(
      [&] {
        begin_all();
        return Upload().first == 503;
      },
      "all places to be taken"));
  halves.clear();
  EXPECT_TRUE(test::Await([&] { return Upload().first == 202; }, "a place that was given back"));
}

TEST_P(UploadsTest, ThatFindsNoRoomGivesItsPlaceBack) {
  ASSERT_EQ(Upload().first, 202);
  temporary_.Empty();
  for (std::size_t i = 0; i < 3 * kPlaces; ++i) {
    const auto [status, body] = Upload();
    EXPECT_EQ(status, 503);
    EXPECT_THAT(body, HasSubstr("there is no room for the")) << "not that others upload already";
  }
}

INSTANTIATE_TEST_SUITE_P(Uploads, UploadsTest,
                         testing::Values("/api/runs", "/api/transfers/uploads"),
                         [](const auto& where) {
                           return std::string(where.index == 0 ? "Runs" : "Transfers");
                         });

class ReceiveIntoTest : public testing::Test {
 protected:
  // Receives a body that is read in `pieces`, and is `whole` or not.
  Result<void> Receive(const fs::path& path, const std::vector<std::string>& pieces, bool whole) {
    return Receive(path, [&](const httplib::ContentReceiver& receive) {
      return std::all_of(
                 pieces.begin(), pieces.end(),
                 [&](const std::string& piece) { return receive(piece.data(), piece.size()); }) &&
             whole;
    });
  }
  Result<void> Receive(const fs::path& path, const httplib::ContentReader::Reader& read) {
    return ReceiveInto(path, "log", desk_, httplib::ContentReader(read, nullptr));
  }

  test::TempDir folder_;
  exchange::InProcessBus bus_;
  Desk desk_{AgentId("desk"), bus_.Open(ConsoleTopics())};
};

TEST_F(ReceiveIntoTest, WritesWhatComes) {
  ASSERT_TRUE(Receive(folder_ / "file", {"one ", "two"}, true));
  std::ifstream file(folder_ / "file");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "one two");
}

TEST_F(ReceiveIntoTest, WhatBreaksOffFindsNoRoomOrThrowsIsAnError) {
  const auto broken_off = Receive(folder_ / "file", {"one "}, false);
  ASSERT_FALSE(broken_off);
  EXPECT_EQ(broken_off.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(broken_off.error().message, "the log did not come whole");
  const auto no_room = Receive("/dev/full", {std::string(1U << 20U, 'x')}, true);
  ASSERT_FALSE(no_room);
  EXPECT_EQ(no_room.error().code, ErrorCode::kUnavailable);
  EXPECT_EQ(no_room.error().message, "there is no room for the log here");
  const auto thrown = Receive(folder_ / "file", [](const auto&) -> bool {
    throw std::runtime_error("a header of no known kind");
  });
  ASSERT_FALSE(thrown);
  EXPECT_EQ(thrown.error().code, ErrorCode::kInternal);
  EXPECT_THAT(thrown.error().message, HasSubstr("a header of no known kind"));
}

TEST_F(ReceiveIntoTest, OfAConsoleThatEndsNothingMoreIsTaken) {
  desk_.Close();
  EXPECT_FALSE(Receive(folder_ / "file", {"one ", "two"}, true));
}

}  // namespace
}  // namespace trailcast::console
