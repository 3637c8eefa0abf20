#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "services/dds/src/domain/domain_config.h"
#include "services/dds/src/entities.h"
#include "services/dds/src/qos_table.h"
#include "services/dds/src/wire.h"
#include "services/exchange/bounds.h"
#include "services/exchange/topics.h"
#include "tests/contract/network.h"
#include "tests/support/pieces.h"
#include "trailcast.h"

namespace trailcast::dds {
namespace {

using exchange::Message;

// A C string that may be written to a wire struct.
template <std::size_t n>
char* Raw(const char (&text)[n]) {
  return const_cast<char*>(text);
}

// Somebody who writes to our topics whatever they like: bare DDS, none of our checks.
class Stranger {
 public:
  explicit Stranger(const std::string& tag, exchange::Topic topic)
      : domain_(Domain::Create(DomainConfig(test::LoopbackOptions(tag), {}, "").value()).value()),
        participant_(Participant::Create(domain_, "stranger").value()),
        topic_(Topic::Create(participant_, TypeOf(topic), exchange::NameOf(topic)).value()),
        writer_(Writer::Create(participant_, topic_, MakeQos(QosOf(topic))).value()) {}

  void Write(const void* sample) {
    const auto written = writer_.Write(sample);
    ASSERT_TRUE(written) << written.error().message;
  }

 private:
  Domain domain_;
  Participant participant_;
  Topic topic_;
  Writer writer_;
};

class DdsHostilityTest : public testing::Test {
 protected:
  // Each spoilt sample must be dropped and counted, and a good message still come through after it.
  template <typename Sample>
  void ExpectAllDropped(exchange::Topic topic, const std::vector<Sample>& spoilt,
                        const Sample& good) {
    Stranger stranger(tag_, topic);
    const auto reader =
        OpenDdsExchange(test::LoopbackOptions(tag_), {.write = {}, .read = {topic}}).value();
    // The good one, until it arrives: endpoints find each other in the background.
    bool heard = false;
    const auto hear = [&](const Message&) { heard = true; };
    ASSERT_TRUE(test::TakeUntil(*reader, hear, [&] {
      if (!heard) stranger.Write(&good);
      return heard;
    }));
    (void)reader->Take(std::chrono::milliseconds(100));  // the rest of the good ones
    for (std::size_t i = 0; i < spoilt.size(); ++i) {
      stranger.Write(&spoilt[i]);
      std::vector<Message> accepted;
      const auto keep = [&](const Message& message) { accepted.push_back(message); };
      ASSERT_TRUE(test::TakeUntil(*reader, keep, [&] { return reader->dropped() == i + 1; }))
          << "sample " << i << " was not counted";
      EXPECT_TRUE(accepted.empty()) << "sample " << i << " was let through";
    }
    heard = false;
    stranger.Write(&good);
    EXPECT_TRUE(test::TakeUntil(*reader, hear, [&] { return heard; }));
  }

  const std::string tag_ = test::UniqueTag();
  char* const route_id_ = Raw("0123456789abcdef0123456789abcdef");
};

TEST_F(DdsHostilityTest, AnnouncementsOutOfBoundsAreDroppedAndCounted) {
  using Sample = trailcast_wire_RouteAnnouncement;
  Sample good{};
  good.holder = Raw("server-1");
  good.key = {.route = route_id_, .teaching = 1};
  good.info.name = Raw("corridor");
  good.info.scout = Raw("scout-1");
  good.info.camera = Raw("webcam");
  const auto with = [&](const auto& spoil) {
    Sample sample = good;
    spoil(sample);
    return sample;
  };
  static const std::string long_text(100'000, 'x');
  const std::vector<Sample> spoilt = {
      with([](Sample& s) { s.holder = Raw(""); }),
      with([](Sample& s) { s.holder = Raw("not a name"); }),
      with([](Sample& s) { s.info.name = Raw("../../etc/passwd"); }),
      with([](Sample& s) { s.info.name = const_cast<char*>(long_text.c_str()); }),
      with([](Sample& s) { s.info.camera = Raw("\xC3\x28"); }),
      with([](Sample& s) { s.info.camera = Raw("\x1B]0;owned\x07"); }),
      with([](Sample& s) { s.info.camera = const_cast<char*>(long_text.c_str()); }),
      with([](Sample& s) { s.key.route = Raw("short"); }),
      with([](Sample& s) { s.key.teaching = 0; }),
      with([](Sample& s) { s.info.state = 7; }),
      with([](Sample& s) { s.info.segment_count = ~0U; }),
      with([](Sample& s) { s.info.image_width_px = ~0U; }),
      with([](Sample& s) { s.info.length_m = std::numeric_limits<double>::quiet_NaN(); })};
  ExpectAllDropped(exchange::Topic::kRoutes, spoilt, good);
}

TEST_F(DdsHostilityTest, SegmentsOutOfBoundsAreDroppedAndCounted) {
  using Sample = trailcast_wire_SegmentBatch;
  using Piece = trailcast_wire_SegmentPiece;
  static std::array<std::uint8_t, 8> few{1, 2, 3};
  static std::vector<std::uint8_t> many(exchange::kMaxPieceBytes + 1);
  Piece whole{};
  whole.key = {.route = route_id_, .teaching = 1};
  whole.digest[0] = 1;
  whole.bytes._buffer = few.data();
  whole.bytes._length = whole.bytes._maximum = few.size();
  const auto piece = [&](const auto& spoil) {
    Piece spoilt_piece = whole;
    spoil(spoilt_piece);
    return spoilt_piece;
  };
  std::vector<Piece> pieces = {
      whole, piece([](Piece& p) { p.digest[0] = 0; }), piece([](Piece& p) {
        p.bytes._buffer = many.data();
        p.bytes._length = p.bytes._maximum = static_cast<std::uint32_t>(many.size());
      }),
      piece([](Piece& p) { p.index = ~0U; }),
      piece([](Piece& p) { p.key.route = Raw("0123456789ABCDEF0123456789ABCDEF"); })};
  std::vector<Sample> spoilt;
  for (Piece& one : pieces) {
    Sample sample{};
    sample.sender = Raw("scout-1");
    sample.pieces._buffer = &one;
    sample.pieces._length = sample.pieces._maximum = 1;
    spoilt.push_back(sample);
  }
  const Sample good = spoilt.front();
  spoilt.front().sender = Raw("caf\xE9");
  Sample empty = good;
  empty.pieces._length = 0;
  spoilt.push_back(empty);
  std::vector<Piece> crowd(exchange::kMaxPiecesPerBatch + 1, whole);
  Sample crowded = good;
  crowded.pieces._buffer = crowd.data();
  crowded.pieces._length = crowded.pieces._maximum = static_cast<std::uint32_t>(crowd.size());
  spoilt.push_back(crowded);
  ExpectAllDropped(exchange::Topic::kSegments, spoilt, good);
}

TEST_F(DdsHostilityTest, StatusesOutOfBoundsAreDroppedAndCounted) {
  using Sample = trailcast_wire_AgentStatus;
  Sample good{};
  good.agent = Raw("agent-1");
  good.route = good.detail = good.on.route = Raw("");
  const auto with = [&](const auto& spoil) {
    Sample sample = good;
    spoil(sample);
    return sample;
  };
  const std::vector<Sample> spoilt = {with([](Sample& s) { s.role = 255; }),
                                      with([](Sample& s) { s.mode = 255; }),
                                      with([](Sample& s) { s.progress = 1e300; }),
                                      with([](Sample& s) { s.speed_mps = 1e9; }),
                                      with([](Sample& s) { s.detail = Raw("two\nlines"); }),
                                      with([](Sample& s) { s.on.route = Raw("no id"); }),
                                      with([](Sample& s) { s.agent = Raw("\xFF\xFE"); })};
  ExpectAllDropped(exchange::Topic::kAgents, spoilt, good);
}

}  // namespace
}  // namespace trailcast::dds
