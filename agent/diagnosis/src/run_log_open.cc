#include <algorithm>
#include <fstream>
#include <sstream>

#include "agent/diagnosis/run_log_format.h"
#include "agent/diagnosis/run_log_reader.h"
#include "agent/diagnosis/src/viewer_messages.h"
#include "services/bag/bag.h"

namespace trailcast::agent {
namespace {

// Of both ends of a log that are read for a list.
constexpr std::size_t kEndBytes = std::size_t{64} << 10U;
constexpr std::chrono::seconds kEnd{2};

// The log as text, which a log as MCAP has in a topic of its own.
class McapText {
 public:
  static Result<McapText> Open(const std::filesystem::path& file) {
    auto bag = bag::Bag::Open(
        file, [](const std::string&) {}, kMostGrowth);
    if (!bag) return tl::unexpected(bag.error());
    const auto& topics = (*bag)->topics();
    const auto log = std::find_if(topics.begin(), topics.end(), [](const bag::Topic& topic) {
      return topic.name == kRunLogTopic;
    });
    if (log != topics.end()) return McapText(std::move(*bag), *log);
    return Fail(
        ErrorCode::kInvalidArgument,
        "no replay's log: it has no topic {}, which 'trailcast-agent replay --log FILE.mcap' "
        "writes",
        kRunLogTopic);
  }
  [[nodiscard]] std::chrono::nanoseconds last_at() const { return bag_->last_at(); }

  // From then on, until there is so much of it.
  Result<std::string> Read(std::chrono::nanoseconds from, std::size_t bytes) {
    bag_->Begin(topic_, std::max(from, std::chrono::nanoseconds(0)));
    std::string text;
    while (text.size() < bytes) {
      const auto message = bag_->Next();
      if (!message) return tl::unexpected(message.error());
      if (!*message) break;
      text += ReadTextMessage((*message)->bytes).value_or("a message that is no text\n");
    }
    return text;
  }

 private:
  McapText(std::unique_ptr<bag::Bag> bag, bag::Topic topic)
      : bag_(std::move(bag)), topic_(std::move(topic)) {}

  std::unique_ptr<bag::Bag> bag_;
  bag::Topic topic_;
};

Result<RunLog> ReadText(std::string text, const ReadLimits& limits = {}) {
  std::istringstream stream(std::move(text));
  return ReadRunLog(stream, limits);
}

Result<RunLog> ReadMcap(const std::filesystem::path& file, const ReadLimits& limits) {
  auto mcap = McapText::Open(file);
  if (!mcap) return tl::unexpected(mcap.error());
  auto text = mcap->Read({}, limits.text_bytes);
  if (!text) return tl::unexpected(text.error());
  return ReadText(*std::move(text), limits);
}

// From line end to line end.
std::string WholeLines(const std::string& text, bool from_beginning) {
  const std::size_t begin = from_beginning ? 0 : text.find('\n') + 1;
  const std::size_t end = text.rfind('\n') + 1;
  return begin < end ? text.substr(begin, end - begin) : std::string();
}

// As one log.
Result<RunLog> Joined(const std::string& head, const std::string& tail) {
  auto log = ReadText(head);
  if (!log || tail.empty()) return log;
  const std::size_t columns = head.find("\n# columns ");
  if (columns == std::string::npos) return log;
  const std::size_t end = std::min(head.find('\n', columns + 1), head.size() - 1);
  auto rest = ReadText(FirstLine() + head.substr(columns + 1, end - columns) + tail);
  if (!rest) return log;
  const int last = log->frames.empty() ? -1 : log->frames.back().frame;
  for (const FrameRow& row : rest->frames) {
    if (row.frame > last) log->frames.push_back(row);
  }
  log->ending = std::move(rest->ending);
  return log;
}

Result<RunLog> ReadMcapEnds(const std::filesystem::path& file) {
  auto mcap = McapText::Open(file);
  if (!mcap) return tl::unexpected(mcap.error());
  const auto head = mcap->Read({}, kEndBytes);
  if (!head) return tl::unexpected(head.error());
  const auto tail = mcap->Read(mcap->last_at() - kEnd, 16 * kEndBytes);
  if (!tail) return tl::unexpected(tail.error());
  return Joined(*head, *tail);
}

Result<RunLog> ReadTextEnds(std::istream& stream) {
  std::string head(kEndBytes, '\0');
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (!stream) {
    head.resize(static_cast<std::size_t>(stream.gcount()));
    return ReadText(std::move(head));
  }
  stream.seekg(0, std::ios::end);
  const auto left = static_cast<std::size_t>(stream.tellg()) - head.size();
  std::string tail(std::min(left, kEndBytes), '\0');
  stream.seekg(-static_cast<std::streamoff>(tail.size()), std::ios::end);
  stream.read(tail.data(), static_cast<std::streamsize>(tail.size()));
  return Joined(WholeLines(head, true), left > tail.size() ? WholeLines(tail, false) : tail);
}

}  // namespace

Result<RunLog> ReadRunLog(const std::filesystem::path& file, const ReadLimits& limits) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file)) {
    return Fail(ErrorCode::kNotFound, "cannot read {}", file.string());
  }
  auto log = IsMcap(stream) ? ReadMcap(file, limits) : ReadRunLog(stream, limits);
  if (!log) return Wrap(log.error(), file.string());
  return log;
}

Result<RunLog> ReadRunEnds(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return Fail(ErrorCode::kNotFound, "cannot read {}", file.string());
  auto log = IsMcap(stream) ? ReadMcapEnds(file) : ReadTextEnds(stream);
  if (!log) return Wrap(log.error(), file.string());
  return log;
}

}  // namespace trailcast::agent
