#include <algorithm>
#include <fstream>
#include <sstream>

#include "agent/diagnosis/run_log_reader.h"
#include "agent/diagnosis/src/viewer_messages.h"
#include "services/bag/bag.h"

namespace trailcast::agent {
namespace {

constexpr std::string_view kMcapBegins = "\x89MCAP";
// Of a file that says what it is not, no more is held.
constexpr std::size_t kMostTextBytes = std::size_t{2} << 30U;

bool IsMcap(std::istream& stream) {
  std::string beginning(kMcapBegins.size(), '\0');
  stream.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  const bool is = stream && beginning == kMcapBegins;
  stream.clear();
  stream.seekg(0);
  return is;
}

// The log as text, which a log as MCAP has in a topic of its own.
Result<RunLog> ReadMcap(const std::filesystem::path& file) {
  auto bag = bag::Bag::Open(file, [](const std::string&) {});
  if (!bag) return tl::unexpected(bag.error());
  const auto& topics = (*bag)->topics();
  const auto log = std::find_if(topics.begin(), topics.end(),
                                [](const bag::Topic& topic) { return topic.name == kRunLogTopic; });
  if (log == topics.end()) {
    return Fail(
        ErrorCode::kInvalidArgument,
        "no replay's log: it has no topic {}, which 'trailcast-agent replay --log FILE.mcap' "
        "writes",
        kRunLogTopic);
  }
  (*bag)->Begin(*log);
  std::string text;
  while (text.size() < kMostTextBytes) {
    const auto message = (*bag)->Next();
    if (!message) return tl::unexpected(message.error());
    if (!*message) break;
    text += ReadTextMessage((*message)->bytes).value_or("a message that is no text\n");
  }
  std::istringstream stream(std::move(text));
  return ReadRunLog(stream);
}

}  // namespace

Result<RunLog> ReadRunLog(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file)) {
    return Fail(ErrorCode::kNotFound, "cannot read {}", file.string());
  }
  auto log = IsMcap(stream) ? ReadMcap(file) : ReadRunLog(stream);
  if (!log) return Wrap(log.error(), file.string());
  return log;
}

}  // namespace trailcast::agent
