#include "agent/diagnosis/run_log_reader.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>
#include <string>

#include "agent/diagnosis/src/run_log_messages.h"
#include "services/bag/bag.h"

namespace trailcast::agent {
namespace {

using std::chrono::nanoseconds;

constexpr std::size_t kDamageKept = 20;
constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
// These bound what is read of a log for a list.
constexpr std::chrono::seconds kEnd{2};
constexpr std::size_t kMostAtTheEnd = 10'000;

// A log whose program was killed before its first frame has no topics yet.
bool IsLog(const bag::Bag& bag) {
  const auto& topics = bag.topics();
  const bool begun = std::any_of(topics.begin(), topics.end(), [](const bag::Topic& topic) {
    return topic.name == kHeaderTopic;
  });
  return begun || (topics.empty() && !bag.damage().empty());
}

Result<std::unique_ptr<bag::Bag>> OpenLog(const std::filesystem::path& file) {
  auto bag = OpenMcap(file);
  if (!bag && bag.error().code != ErrorCode::kCorrupt) return bag;
  if (bag && IsLog(**bag)) return bag;
  return Fail(ErrorCode::kCorrupt,
              "not a replay's log: {}; 'trailcast-agent replay --log FILE.mcap' writes one",
              bag ? fmt::format("it has no topic {}", kHeaderTopic) : bag.error().message);
}

class Reader {
 public:
  Reader(bag::Bag& bag, const ReadLimits& limits) : bag_(bag), limits_(limits) {}

  Result<void> Header() { return Read(kHeaderTopic, &Reader::TakeHeader, {}, 1); }
  // Reads at most so many from that time on.
  Result<void> Frames(nanoseconds from = {}, std::size_t most = kAll) {
    return Read(kFrameTopic, &Reader::TakeFrame, from, most);
  }
  Result<void> Events(nanoseconds from = {}, std::size_t most = kAll) {
    return Read(kEventTopic, &Reader::TakeEvent, from, most);
  }
  // `name` is the file's, with which lines on its damage begin.
  [[nodiscard]] RunLog Finish(const std::string& name) && {
    for (std::string what : bag_.damage()) {
      if (what.starts_with(name + ": ")) what.erase(0, name.size() + 2);
      Note(std::move(what));
    }
    return std::move(log_);
  }

 private:
  using Message = std::span<const std::uint8_t>;
  using Take = Result<void> (Reader::*)(Message);

  Result<void> Read(const char* name, Take take, nanoseconds from, std::size_t most) {
    const auto& topics = bag_.topics();
    const auto topic = std::find_if(topics.begin(), topics.end(),
                                    [&](const bag::Topic& each) { return each.name == name; });
    if (topic == topics.end()) return {};
    bag_.Begin(*topic, std::max(from, nanoseconds(0)));
    for (std::size_t count = 0; count < most; ++count) {
      const auto message = bag_.Next();
      if (!message) return tl::unexpected(message.error());
      if (!*message) break;
      bytes_ += (*message)->bytes.size();
      if (count == limits_.messages || bytes_ > limits_.bytes) {
        Note(fmt::format("{} has more than is read: the rest is left out", name));
        break;
      }
      if (const auto taken = (this->*take)((*message)->bytes); !taken) {
        Note(fmt::format("message {} of {}: {}", count + 1, name, taken.error().message));
      }
    }
    return {};
  }
  void Note(std::string what) {
    ++log_.damaged;
    if (log_.damage.size() < kDamageKept) log_.damage.push_back(std::move(what));
  }

  Result<void> TakeHeader(Message message) {
    return ReadHeader(message).map([this](Fields header) { log_.header = std::move(header); });
  }
  Result<void> TakeFrame(Message message) {
    const auto row = ReadFrame(message);
    if (!row) return tl::unexpected(row.error());
    if (!log_.frames.empty() && row->frame <= log_.frames.back().frame) {
      return Fail(ErrorCode::kCorrupt, "frame {} after frame {}", row->frame,
                  log_.frames.back().frame);
    }
    log_.frames.push_back(*row);
    return {};
  }
  Result<void> TakeEvent(Message message) {
    auto event = ReadEvent(message);
    if (!event) return tl::unexpected(event.error());
    if (event->what == "end") {
      log_.ending = std::move(*event);
    } else if (log_.events.size() >= limits_.events) {
      return Fail(ErrorCode::kCorrupt, "more events than are read");
    } else {
      log_.events.push_back(std::move(*event));
    }
    return {};
  }

  bag::Bag& bag_;
  const ReadLimits& limits_;
  RunLog log_;
  std::size_t bytes_ = 0;
};

Result<RunLog> ReadAs(const std::filesystem::path& file, const ReadLimits& limits, bool ends) {
  const auto bag = OpenLog(file);
  if (!bag) return Wrap(bag.error(), file.string());
  Reader reader(**bag, limits);
  auto read = reader.Header();
  if (read && ends) read = reader.Frames({}, 1);
  const nanoseconds from = ends ? (*bag)->last_at() - kEnd : nanoseconds(0);
  const std::size_t most = ends ? kMostAtTheEnd : kAll;
  if (read) read = reader.Frames(from, most);
  if (read) read = reader.Events(from, most);
  if (!read) return Wrap(read.error(), file.string());
  return std::move(reader).Finish(file.filename().string());
}

}  // namespace

Result<RunLog> ReadRunLog(const std::filesystem::path& file, const ReadLimits& limits) {
  return ReadAs(file, limits, false);
}

Result<RunLog> ReadRunEnds(const std::filesystem::path& file) {
  return ReadAs(file, {}, true).map([](RunLog log) {
    // A short log's first frame is also one of its last, and was read twice.
    log.damage.clear();
    log.damaged = 0;
    return log;
  });
}

}  // namespace trailcast::agent
