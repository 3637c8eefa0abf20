#include "agent/diagnosis/run_log_reader.h"

#include <string>

#include "agent/diagnosis/run_log_format.h"

namespace trailcast::agent {
namespace {

constexpr std::size_t kDamageKept = 20;

struct Line {
  std::string text;
  bool whole = false;     // ends in a line end
  bool too_long = false;  // `text` is its beginning
};

// Never holds more of a line than a line may have.
std::optional<Line> NextLine(std::istream& stream) {
  Line line;
  std::streambuf& bytes = *stream.rdbuf();
  for (int c = bytes.sbumpc(); c != std::char_traits<char>::eof(); c = bytes.sbumpc()) {
    if (c == '\n') {
      line.whole = true;
      return line;
    }
    if (line.text.size() < kLongestLogLine) {
      line.text += static_cast<char>(c);
    } else {
      line.too_long = true;
    }
  }
  if (line.text.empty()) return std::nullopt;
  return line;
}

class Reader {
 public:
  explicit Reader(const ReadLimits& limits) : limits_(limits) {}

  void Take(std::size_t number, const Line& line) {
    Result<void> taken;
    if (line.too_long) {
      taken = Fail(ErrorCode::kCorrupt, "longer than {} characters", kLongestLogLine);
    } else if (!line.whole) {
      taken = Fail(ErrorCode::kCorrupt, "cut off: the file ends within this line");
    } else {
      taken = Take(line.text);
    }
    if (!taken) Note(number, taken.error().message);
  }
  void Note(std::size_t number, std::string what) {
    ++log_.damaged_lines;
    if (log_.damage.size() < kDamageKept) log_.damage.push_back({number, std::move(what)});
  }
  [[nodiscard]] RunLog Finish() && { return std::move(log_); }

 private:
  Result<void> Take(const std::string& line) {
    if (line.rfind("# ", 0) == 0) return TakeHeader(line);
    if (line.rfind("! ", 0) == 0) return TakeEvent(line);
    if (columns_.empty()) {
      return Fail(ErrorCode::kCorrupt, "a row before the header has listed its columns");
    }
    auto row = ParseRow(line, columns_);
    if (!row) return tl::unexpected(row.error());
    if (!log_.frames.empty() && row->frame <= log_.frames.back().frame) {
      return Fail(ErrorCode::kCorrupt, "frame {} after frame {}", row->frame,
                  log_.frames.back().frame);
    }
    log_.frames.push_back(*row);
    return {};
  }
  Result<void> TakeHeader(const std::string& line) {
    const std::size_t key_end = std::min(line.find(' ', 2), line.size());
    const std::string key = line.substr(2, key_end - 2);
    const std::string value = line.substr(std::min(key_end + 1, line.size()));
    if (key != "columns") {
      log_.header.Add(key, value);
      return {};
    }
    auto columns = ParseColumns(value);
    if (!columns) return tl::unexpected(columns.error());
    columns_ = std::move(*columns);
    return {};
  }
  Result<void> TakeEvent(const std::string& line) {
    auto event = ParseEvent(line);
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

  const ReadLimits& limits_;
  RunLog log_;
  std::vector<std::string> columns_;
};

}  // namespace

Result<RunLog> ReadRunLog(std::istream& stream, const ReadLimits& limits) {
  const auto first = NextLine(stream);
  if (auto checked = CheckFirstLine(first ? first->text : ""); !checked) {
    return tl::unexpected(checked.error());
  }
  Reader reader(limits);
  std::size_t number = 1;
  while (const auto line = NextLine(stream)) {
    ++number;
    if (number > limits.lines) {
      reader.Note(number, "more lines than are read: the rest is left out");
      break;
    }
    reader.Take(number, *line);
  }
  return std::move(reader).Finish();
}

}  // namespace trailcast::agent
