#include "services/fleet/photo_client.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "services/exchange/in_process_exchange.h"
#include "services/route/digest.h"
#include "tests/unit/photos/a_photo.h"

namespace trailcast::fleet {
namespace {

using photos::APhoto;
using photos::SomeJpeg;
using std::chrono::milliseconds;
using testing::HasSubstr;

const AgentId kClient("operator-p1");

KnownPhoto Known(char digit, std::size_t bytes) {
  return {AgentId("barn"), APhoto(digit, SomeJpeg(bytes))};
}

exchange::PhotoPiece PieceOf(const KnownPhoto& known, std::size_t offset, std::size_t bytes) {
  return {.holder = known.server,
          .client = kClient,
          .photo = known.photo.id,
          .offset = static_cast<std::uint32_t>(offset),
          .bytes = SomeJpeg(bytes)};
}

TEST(PhotoFetch, AsksForWhatLacksUntilItHasAll) {
  const KnownPhoto known = Known('a', 1000);
  PhotoFetch fetch(kClient, known);
  EXPECT_EQ(fetch.Asks().offset, 0U);
  EXPECT_EQ(fetch.Asks().holder, known.server);
  EXPECT_TRUE(fetch.Hear(PieceOf(known, 0, 600)));
  EXPECT_FALSE(fetch.Hear(PieceOf(known, 0, 600))) << "the same once more";
  EXPECT_EQ(fetch.Asks().offset, 600U);
  EXPECT_FALSE(fetch.outcome());
  EXPECT_TRUE(fetch.Hear(PieceOf(known, 600, 400)));
  ASSERT_TRUE(fetch.outcome() && *fetch.outcome());
  EXPECT_EQ(**fetch.outcome(), SomeJpeg(1000));
}

TEST(PhotoFetch, SaysWhyThereIsNoneAndWhatIsDamaged) {
  const KnownPhoto known = Known('a', 1000);
  PhotoFetch gone(kClient, known);
  exchange::PhotoPiece piece = PieceOf(known, 0, 0);
  EXPECT_FALSE(gone.Hear(piece)) << "an empty piece is none";
  piece.error = "there is no photo";
  EXPECT_TRUE(gone.Hear(piece));
  EXPECT_EQ(gone.outcome()->error().code, ErrorCode::kNotFound);
  PhotoFetch damaged(kClient, known);
  piece = PieceOf(known, 0, 1000);
  piece.bytes[500] = 8;
  EXPECT_TRUE(damaged.Hear(piece));
  EXPECT_EQ(damaged.outcome()->error().code, ErrorCode::kCorrupt);
}

TEST(PhotoFetch, HeedsOnlyItsServerAndItsPhoto) {
  const KnownPhoto known = Known('a', 1000);
  PhotoFetch fetch(kClient, known);
  EXPECT_FALSE(fetch.Hear(PieceOf(Known('b', 1000), 0, 600)));
  exchange::PhotoPiece piece = PieceOf(known, 0, 600);
  piece.client = AgentId("operator-p2");
  EXPECT_FALSE(fetch.Hear(piece));
  piece = PieceOf(known, 0, 600);
  piece.holder = AgentId("stranger");
  EXPECT_FALSE(fetch.Hear(piece));
}

// Two servers have photos, page by page, and one has none.
TEST(AskForPhotos, AsksAllServersForAllPagesAndTakesTheLast) {
  exchange::InProcessBus bus;
  const auto serve = [&bus](const char* name, std::vector<std::string> lines) {
    return std::jthread(
        [&bus, name = std::string(name), lines = std::move(lines)](const std::stop_token& stop) {
          const auto exchange = bus.Open(exchange::ServerTopics());
          while (!stop.stop_requested()) {
            for (const exchange::Message& message : exchange->Take(milliseconds(5))) {
              const auto* asked = std::get_if<exchange::NetworkRequest>(&message);
              if (asked == nullptr) continue;
              exchange::NetworkReply reply{
                  .server = AgentId(name), .client = asked->client, .request = asked->request};
              if (asked->first < lines.size()) reply.lines = {lines[asked->first]};
              reply.next = asked->first + 1 < lines.size() ? asked->first + 1 : 0;
              if (asked->words != "photos route hall") reply.error = "is asked otherwise";
              (void)exchange->Publish(reply);
            }
          }
        });
  };
  const auto line = [](char digit) { return ToText(APhoto(digit, SomeJpeg(10))); };
  const auto barn = serve("barn", {line('c'), "a line of a later version", line('a')});
  const auto shed = serve("shed", {line('b')});
  const auto attic = serve("attic", {});
  exchange::TopicUse use = exchange::NetworkTopics();
  const auto exchange = bus.Open(use);
  const auto found = AskForPhotos(*exchange, kClient, {.route = "hall"}, 10, milliseconds(20'000));
  ASSERT_TRUE(found) << found.error().message;
  std::vector<std::string> ids;
  for (const KnownPhoto& known : *found) ids.push_back(known.server.value() + known.photo.id[0]);
  EXPECT_THAT(ids, testing::ElementsAre("barnc", "shedb", "barna"));
}

TEST(Photos, AreATableForPeopleAndForPrograms) {
  KnownPhoto known = Known('a', 123'456);
  known.photo.place = "dock";
  known.photo.sure = false;
  const std::vector<KnownPhoto> photos{known};
  EXPECT_THAT(PhotosTable(photos), HasSubstr("dock"));
  EXPECT_THAT(PhotosTable(photos), HasSubstr("123.5  hall at 12.6 m, not sure"));
  EXPECT_EQ(PhotosTable({}), "no photos\n");
  EXPECT_EQ(PhotosJson(photos)[0]["spot_m"], 12.5);
  EXPECT_EQ(FileNameOf(known.photo), "2023-11-14T22-13-20Z-dock-robot2-aaaa.jpg");
  EXPECT_THAT(PhotosCsv(photos),
              HasSubstr("\n2023-11-14T22-13-20Z-dock-robot2-aaaa.jpg,2023-11-14T22:13:20Z,robot2,"
                        "4f2a09c1,hall,3,dock,12.50,12.61,0,0,640,480,123456,"));
}

}  // namespace
}  // namespace trailcast::fleet
