// These test how a robot's photos get to a server, over a link that loses what the test says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "agent/link/photo_sender.h"
#include "route_server/fleet/photo_registry.h"
#include "services/exchange/bounds.h"
#include "tests/support/await.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/photos/a_photo.h"

namespace trailcast::agent {
namespace {

using photos::APhoto;
using photos::Photo;
using photos::PhotoFolder;
using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class PhotoDeliveryTest : public testing::Test {
 protected:
  static constexpr std::uint64_t kMost = 10'000'000;

  PhotoDeliveryTest() { StartServer(); }
  void StartServer(std::uint64_t most_bytes = kMost) {
    server_.emplace(AgentId("server"), *PhotoFolder::Open(folder_ / "server", most_bytes));
  }
  Photo Keep(char digit, std::size_t bytes = 100'000) {
    const auto jpeg = photos::SomeJpeg(bytes, static_cast<std::uint8_t>(digit));
    const Photo photo = APhoto(digit, jpeg);
    EXPECT_TRUE(robots_->Add(photo, jpeg));
    return photo;
  }
  // Returns what the server tells of a piece, which of the last one it does once it has written the
  // photo.
  exchange::PhotoRequest Told(const exchange::PhotoPiece& piece) {
    if (auto at_once = server_->Take(piece)) return *std::move(at_once);
    std::vector<exchange::PhotoRequest> kept;
    test::Await(
        [&] {
          kept = server_->TakeKept();
          return !kept.empty();
        },
        "the photo is written");
    return kept.empty() ? exchange::PhotoRequest{} : kept.front();
  }
  // Lets so much time pass in steps of 10 ms. Returns the pieces that were sent.
  int Pass(milliseconds time) {
    int pieces = 0;
    for (const auto end = now_ + time; now_ < end; now_ += milliseconds(10)) {
      for (const exchange::Message& message : sender_.Due(now_, heard_)) {
        EXPECT_TRUE(exchange::CheckBounds(message));
        ++pieces;
        if (loses_piece()) continue;
        const auto answer = Told(std::get<exchange::PhotoPiece>(message));
        if (loses_answer()) continue;
        EXPECT_TRUE(exchange::CheckBounds(answer));
        sender_.Handle(answer, now_ + answers_after_);
      }
    }
    return pieces;
  }

  test::TempDir folder_;
  std::unique_ptr<PhotoFolder> robots_ = *PhotoFolder::Open(folder_ / "robot", kMost);
  std::optional<server::PhotoRegistry> server_;
  PhotoSender sender_{AgentId("robot2"), *robots_};
  PhotoSender::Time now_{};
  std::optional<AgentId> heard_ = AgentId("server");
  milliseconds answers_after_{5};
  std::function<bool()> loses_piece = [] { return false; };
  std::function<bool()> loses_answer = [] { return false; };
};

TEST_F(PhotoDeliveryTest, TheServerHasAllAndTheRobotForgetsThem) {
  const Photo first = Keep('a');
  const Photo second = Keep('b', 1);
  Pass(milliseconds(1000));
  EXPECT_EQ(robots_->size(), 0U);
  EXPECT_EQ(server_->folder().Get(first.id), first);
  EXPECT_EQ(server_->folder().Get(second.id), second);
  EXPECT_EQ(*server_->folder().Read(first.id, 0, 1'000'000), photos::SomeJpeg(100'000, 'a'));
  EXPECT_EQ(Pass(milliseconds(60'000)), 0) << "nothing is left to send";
}

TEST_F(PhotoDeliveryTest, WithoutAServerTheRobotKeepsThemAndSendsNothing) {
  heard_.reset();
  Keep('a');
  EXPECT_EQ(Pass(milliseconds(10'000)), 0);
  EXPECT_EQ(robots_->size(), 1U);
}

TEST_F(PhotoDeliveryTest, LossesCostTimeAndNoPhoto) {
  int count = 0;
  loses_piece = [&count] { return ++count % 3 == 0; };
  int answers = 0;
  loses_answer = [&answers] { return ++answers % 4 == 0; };
  Keep('a');
  Keep('b');
  Pass(milliseconds(120'000));
  EXPECT_EQ(robots_->size(), 0U);
  EXPECT_EQ(server_->folder().size(), 2U);
}

TEST_F(PhotoDeliveryTest, GoesOnAfterACutWhereTheServerLacks) {
  const Photo photo = Keep('a');
  int pieces = 0;
  loses_piece = [&pieces] { return ++pieces > 3; };
  Pass(milliseconds(500));
  ASSERT_EQ(robots_->size(), 1U);
  loses_piece = [] { return false; };
  std::size_t sent = 0;
  while (robots_->size() > 0) {
    for (const exchange::Message& message : sender_.Due(now_, heard_)) {
      const auto& piece = std::get<exchange::PhotoPiece>(message);
      sent += piece.bytes.size();
      sender_.Handle(Told(piece), now_);
    }
    now_ += milliseconds(10);
  }
  EXPECT_LT(sent, photo.bytes - 2 * PhotoSender::kSmallestPiece);
}

TEST_F(PhotoDeliveryTest, BeginsAPhotoAnewWhenTheServerHasStartedAgain) {
  const Photo photo = Keep('a');
  int pieces = 0;
  loses_piece = [&pieces] { return ++pieces > 3; };
  Pass(milliseconds(500));
  StartServer();
  loses_piece = [] { return false; };
  Pass(milliseconds(10'000));
  EXPECT_EQ(server_->folder().Get(photo.id), photo);
}

// A robot whose disk lost power before it heard that its photo was kept sends it again.
TEST_F(PhotoDeliveryTest, APhotoThatTheServerHasIsConfirmedAtItsFirstPiece) {
  Keep('a');
  Pass(milliseconds(1000));
  Keep('a');
  EXPECT_EQ(Pass(milliseconds(1000)), 1);
  EXPECT_EQ(robots_->size(), 0U);
}

TEST_F(PhotoDeliveryTest, HasOnePieceUnderWayWhichIsSmallOnASlowLink) {
  answers_after_ = milliseconds(600);
  Keep('a');
  for (int i = 0; i < 20; ++i) {
    for (const exchange::Message& message : sender_.Due(now_, heard_)) {
      const auto& piece = std::get<exchange::PhotoPiece>(message);
      EXPECT_EQ(piece.bytes.size(), PhotoSender::kSmallestPiece);
      EXPECT_THAT(sender_.Due(now_ + milliseconds(10), heard_), IsEmpty());
      now_ += answers_after_;
      sender_.Handle(*server_->Take(piece), now_);
    }
  }
  EXPECT_EQ(robots_->size(), 1U) << "20 pieces are not all of it";
}

TEST_F(PhotoDeliveryTest, StaysWithTheRobotWhileTheServerCannotKeepItAndSaysWhyOnce) {
  StartServer(1000);
  Keep('a');
  Pass(milliseconds(200'000));
  EXPECT_EQ(robots_->size(), 1U);
  const auto news = sender_.TakeNews();
  ASSERT_THAT(news, SizeIs(1));
  EXPECT_THAT(news.front(), HasSubstr("larger than all photos may be"));
  StartServer();
  Pass(milliseconds(120'000));
  EXPECT_EQ(robots_->size(), 0U);
}

TEST_F(PhotoDeliveryTest, OneThatIsDamagedOnTheRobotsDiskKeepsNoOthersWaiting) {
  const Photo damaged = Keep('a');
  Keep('b');
  std::ofstream(folder_ / "robot" / (damaged.id + ".jpg")) << std::string(damaged.bytes, 'x');
  Pass(milliseconds(5000));
  EXPECT_EQ(robots_->size(), 0U);
  EXPECT_EQ(server_->folder().size(), 1U);
  EXPECT_THAT(sender_.TakeNews(), testing::ElementsAre(HasSubstr("damaged on the disk")));
}

TEST_F(PhotoDeliveryTest, OnlyTheServerThatItIsSentToConfirmsAPhoto) {
  const Photo photo = Keep('a');
  (void)sender_.Due(now_, heard_);
  for (const char* stranger : {"server2", "robot1"}) {
    sender_.Handle(exchange::PhotoRequest{.client = AgentId(stranger),
                                          .holder = AgentId("robot2"),
                                          .photo = photo.id,
                                          .kept = true},
                   now_);
  }
  EXPECT_EQ(robots_->size(), 1U);
}

TEST_F(PhotoDeliveryTest, AServerTakesNothingThatIsNotTheRobotsOwnOrIsTooLarge) {
  Photo photo = APhoto('a', photos::SomeJpeg(10));
  const auto told = [&](const AgentId& robot) {
    return server_->Take({.holder = robot,
                          .client = AgentId("server"),
                          .photo = photo.id,
                          .words = ToText(photo),
                          .bytes = photos::SomeJpeg(10)});
  };
  EXPECT_THAT(told(AgentId("robot1"))->refusal, HasSubstr("another robot's"));
  photo.bytes = exchange::kMaxPhotoBytes + 1;
  EXPECT_THAT(told(photo.robot)->refusal, HasSubstr("too large"));
  photo.bytes = 5;
  EXPECT_EQ(told(photo.robot)->offset, 0U) << "a piece with more than there is";
  EXPECT_FALSE(server_->Take({.holder = photo.robot, .client = AgentId("server2")}));
  EXPECT_EQ(server_->folder().size(), 0U);
}

TEST_F(PhotoDeliveryTest, AnOperatorIsGivenWhatThereIsAndToldWhatThereIsNot) {
  const Photo photo = Keep('a');
  Pass(milliseconds(1000));
  const auto list = [&](const char* words) {
    return server_->Answer({.client = AgentId("o"), .request = 7, .words = words});
  };
  const auto reply = list("photos robot robot2");
  EXPECT_EQ(reply.request, 7U);
  EXPECT_THAT(reply.lines, testing::ElementsAre(ToText(photo)));
  EXPECT_THAT(list("photos robot robot1").lines, IsEmpty());
  EXPECT_THAT(list("photos colour red").error, HasSubstr("'colour'"));
  const auto given = server_->Give(
      {.client = AgentId("o"), .holder = AgentId("server"), .photo = photo.id, .offset = 40'000});
  ASSERT_TRUE(given);
  EXPECT_EQ(given->bytes, photos::SomeJpeg(60'000, 'a'));
  EXPECT_EQ(given->words, ToText(photo));
  const auto none = server_->Give(
      {.client = AgentId("o"), .holder = AgentId("server"), .photo = std::string(16, 'b')});
  ASSERT_TRUE(none);
  EXPECT_THAT(none->error, HasSubstr("there is no photo"));
  EXPECT_FALSE(server_->Give({.holder = AgentId("server2"), .photo = photo.id}));
}

}  // namespace
}  // namespace trailcast::agent
