#include "services/bag/src/db3_file.h"

#include <sqlite3.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace trailcast::bag {
namespace {

constexpr const char* kDamaged = "messages that cannot be read: the file is damaged or cut off";
constexpr const char* kNoLog = "the newest messages, in the file -wal beside it, cannot be read";
// Rows are numbered one by one, and no recording has more.
constexpr std::int64_t kFarthestJump = std::int64_t{1} << 40U;

bool IsDamage(const SQLite::Exception& exception) {
  const int code = exception.getErrorCode() & 0xFF;
  return code == SQLITE_CORRUPT || code == SQLITE_NOTADB || code == SQLITE_TOOBIG;
}

std::string Uri(const std::filesystem::path& file) {
  std::string uri = "file:";
  for (const char c : file.string()) {
    if (c == '%' || c == '?' || c == '#') {
      uri += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    } else {
      uri += c;
    }
  }
  return uri;
}

// How a file is opened. This depends on what is beside it and on whether anything may be written
// there.
enum class Way {
  kShared,  // with its log, while a recorder may still write
  // The file is on a read-only disk, with its log. SQLite then does without the file of shared
  // memory, which requires that it has the database to itself, and without locks.
  kAlone,
  kWithoutLog,  // as a file that nobody writes, so that SQLite writes nothing beside it
};

std::unique_ptr<SQLite::Database> OpenWith(const std::filesystem::path& file, Way way) {
  std::string name = Uri(file);
  if (way == Way::kAlone) name += "?vfs=unix-none";
  if (way == Way::kWithoutLog) name += "?immutable=1";
  auto db = std::make_unique<SQLite::Database>(name, SQLite::OPEN_READONLY | SQLite::OPEN_URI);
  if (way == Way::kAlone) db->exec("PRAGMA locking_mode = EXCLUSIVE");
  sqlite3_limit(db->getHandle(), SQLITE_LIMIT_LENGTH, static_cast<int>(kMostMessageBytes));
  db->exec("PRAGMA trusted_schema = OFF");
  db->exec("PRAGMA cell_size_check = ON");
  db->exec("PRAGMA writable_schema = ON");  // a file that is shorter than its header says can then
                                            // be read
  return db;
}

// A view or a virtual table with these names could run anything.
bool HasTables(SQLite::Database& db) {
  SQLite::Statement count(db,
                          "SELECT count(*) FROM sqlite_schema WHERE type = 'table' AND name IN "
                          "('topics', 'messages') AND sql LIKE 'CREATE TABLE%'");
  return count.executeStep() && count.getColumn(0).getInt() == 2;
}

std::map<std::int64_t, Topic> ReadTopics(SQLite::Database& db) {
  std::map<std::int64_t, Topic> topics;
  SQLite::Statement select(db, "SELECT id, name, type, serialization_format FROM topics");
  while (select.executeStep()) {
    topics[select.getColumn(0).getInt64()] = {select.getColumn(1).getString(),
                                              select.getColumn(2).getString(),
                                              select.getColumn(3).getString(), 0};
  }
  return topics;
}

Error Unreadable(const std::filesystem::path& file, const std::string& why) {
  return {ErrorCode::kCorrupt,
          fmt::format("{} cannot be read as a rosbag2 file: {}", file.string(), why)};
}

}  // namespace

Result<std::unique_ptr<Db3File>> Db3File::Open(const std::filesystem::path& file) {
  std::error_code unknown;
  const std::filesystem::path log = file.string() + "-wal";
  const bool has_log =
      std::filesystem::exists(log, unknown) && std::filesystem::file_size(log, unknown) > 0;
  std::vector<Way> ways{Way::kWithoutLog};
  if (has_log) ways = {Way::kShared, Way::kAlone, Way::kWithoutLog};
  for (const Way way : ways) {
    try {
      auto db = OpenWith(file, way);
      if (!HasTables(*db)) {
        return tl::unexpected(Unreadable(file, "it has no tables 'topics' and 'messages'"));
      }
      auto topics = ReadTopics(*db);
      std::unique_ptr<Db3File> opened(new Db3File(std::move(db), std::move(topics)));
      if (has_log && way == Way::kWithoutLog) opened->NoteDamage(kNoLog);
      return opened;
    } catch (const SQLite::Exception& exception) {
      if (way == ways.back()) return tl::unexpected(Unreadable(file, exception.what()));
    }
  }
  return tl::unexpected(Unreadable(file, "it cannot be opened"));
}

std::uintmax_t Db3File::WholeBytes(std::uintmax_t size, std::span<const std::uint8_t> beginning) {
  // https://www.sqlite.org/fileformat.html, section 1.3: the page size has two bytes, big-endian; 1
  // stands for 65536.
  constexpr std::size_t kPageSizeAt = 16;
  if (beginning.size() < kPageSizeAt + 2) return size;
  const unsigned stored = beginning[kPageSizeAt] * 256U + beginning[kPageSizeAt + 1];
  const unsigned page_bytes = stored == 1 ? 65536U : std::max(stored, 1U);
  return size - size % page_bytes;
}

void Db3File::Select(const std::string& columns, const std::set<std::int64_t>& topics) {
  rows_ = std::make_unique<SQLite::Statement>(
      *db_, fmt::format("SELECT {} FROM messages WHERE id > ? AND topic_id IN ({}) ORDER BY id",
                        columns, fmt::join(topics, ",")));
  last_id_ = std::numeric_limits<std::int64_t>::min();
  jump_ = 1;
  rows_->bind(1, last_id_);
}

bool Db3File::SkipDamage(const SQLite::Exception& damage) {
  if (!IsDamage(damage)) throw damage;
  NoteDamage(kDamaged);
  (void)rows_->tryReset();
  last_id_ = std::max<std::int64_t>(last_id_, 0) + jump_;
  jump_ *= 2;
  rows_->bind(1, last_id_);
  return jump_ < kFarthestJump;
}

bool Db3File::Step() {
  while (true) {
    try {
      if (!rows_->executeStep()) return false;
      last_id_ = rows_->getColumn(0).getInt64();
      jump_ = 1;
      return true;
    } catch (const SQLite::Exception& exception) {
      if (!SkipDamage(exception)) return false;
    }
  }
}

Result<Contents> Db3File::Survey(const Bag::Tell&) {
  std::set<std::int64_t> all;
  for (auto& [id, topic] : topics_) {
    topic.messages = 0;
    all.insert(id);
  }
  std::optional<std::int64_t> first_ns;
  std::int64_t last_ns = 0;
  try {
    Select("id, topic_id, timestamp", all);
    while (Step()) {
      ++topics_[rows_->getColumn(1).getInt64()].messages;
      const std::int64_t at_ns = rows_->getColumn(2).getInt64();
      first_ns = std::min(first_ns.value_or(at_ns), at_ns);
      last_ns = std::max(last_ns, at_ns);
    }
  } catch (const SQLite::Exception& exception) {
    return tl::unexpected(Unreadable(db_->getFilename(), exception.what()));
  }
  Contents contents;
  contents.first_at = std::chrono::nanoseconds(first_ns.value_or(0));
  contents.last_at = std::chrono::nanoseconds(last_ns);
  for (const auto& [id, topic] : topics_) contents.topics.push_back(topic);
  return contents;
}

void Db3File::Begin(const Topic& topic, std::chrono::nanoseconds from) {
  rows_.reset();
  from_ns_ = from.count();
  wanted_.clear();
  for (const auto& [id, one] : topics_) {
    if (one.name == topic.name && one.type == topic.type) wanted_.insert(id);
  }
}

std::optional<Message> Db3File::Unpacked(std::span<const std::uint8_t> bytes) {
  Message message{std::chrono::nanoseconds(rows_->getColumn(1).getInt64()), bytes};
  if (!IsZstd(bytes)) return message;  // CDR begins with a zero
  Decompressed decompressed = Decompress(Compression::kZstd, bytes, kMostMessageBytes);
  if (!decompressed.whole) {
    NoteDamage("a compressed message that does not unpack");
    return std::nullopt;
  }
  message_ = std::move(decompressed.bytes);
  message.bytes = message_;
  return message;
}

Result<std::optional<Message>> Db3File::Next() {
  try {
    if (!rows_) Select("id, timestamp, data", wanted_);
    while (Step()) {
      if (rows_->getColumn(1).getInt64() < from_ns_) continue;
      const SQLite::Column data = rows_->getColumn(2);
      const auto* begin = static_cast<const std::uint8_t*>(data.getBlob());
      const auto message = Unpacked({begin, static_cast<std::size_t>(data.getBytes())});
      if (message) return message;
    }
    return std::nullopt;
  } catch (const SQLite::Exception& exception) {
    return tl::unexpected(Unreadable(db_->getFilename(), exception.what()));
  }
}

}  // namespace trailcast::bag
