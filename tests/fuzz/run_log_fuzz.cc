// The messages of logs of replays, and what is told of them. The target `bag` has the files.
#include <algorithm>
#include <span>

#include "agent/diagnosis/run_log_reader.h"
#include "agent/diagnosis/src/run_log_messages.h"
#include "services/bag/mcap_writer.h"
#include "services/explain/story.h"
#include "tests/fuzz/fuzz.h"

using trailcast::fuzz::Require;
namespace agent = trailcast::agent;
namespace bag = trailcast::bag;

namespace {

// The input as a log: of each message its topic, a byte, its length, a byte, and its bytes.
bag::Bytes LogOf(std::span<const std::uint8_t> input) {
  bag::McapWriter writer(bag::Compression::kNone, "");
  for (const char* topic : {agent::kHeaderTopic, agent::kFrameTopic, agent::kEventTopic}) {
    writer.AddChannel(0, topic, "protobuf");
  }
  while (input.size() >= 2) {
    const auto channel = static_cast<bag::McapWriter::Id>(1 + input[0] % 3);
    const std::size_t length = std::min<std::size_t>(input[1], input.size() - 2);
    writer.Put(channel, std::chrono::nanoseconds(input.size()), input.subspan(2, length));
    input = input.subspan(2 + length);
  }
  writer.End();
  return writer.TakeBytes();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = trailcast::fuzz::AsFile(LogOf({data, size}), "run.mcap");
  const auto log = agent::ReadRunLog(file);
  Require(log.has_value() && agent::ReadRunEnds(file), "every log of messages is read");
  Require(log->damage.size() <= log->damaged, "damage is counted");
  for (const agent::FrameRow& row : log->frames) {
    const std::string text = agent::FrameMessage(row);
    const auto again =
        agent::ReadFrame({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    Require(again && again->frame == row.frame && again->phase == row.phase,
            "a row that was read can be written and read");
  }
  for (const bool all : {false, true}) {
    Require(!trailcast::explain::TellStory(*log, all).empty(), "every log has a story");
  }
  constexpr std::size_t kFrames = 50;
  for (std::size_t row = 0; row < std::min(kFrames, log->frames.size()); ++row) {
    Require(!trailcast::explain::TellFrame(*log, row).empty(), "every frame has its words");
  }
  return 0;
}
