#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "services/bag/compression.h"
#include "services/bag/mcap_writer.h"

// These write recordings as rosbag2 does.
namespace trailcast::test {

class BagWriter {
 public:
  virtual ~BagWriter() = default;
  virtual void Put(const std::string& topic, const std::string& type,
                   std::chrono::nanoseconds logged_at, const bag::Bytes& message) = 0;
};

inline void WriteBytes(const std::filesystem::path& file, const bag::Bytes& bytes) {
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  if (!stream.flush()) throw std::runtime_error("cannot write " + file.string());
}

inline bag::Bytes ReadBytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// This writes the tables of rosbag2's SQLite storage. `zstd` compresses each message.
class Db3Writer final : public BagWriter {
 public:
  explicit Db3Writer(const std::filesystem::path& file, bool zstd = false)
      : db_(file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE), zstd_(zstd) {
    db_.exec("PRAGMA synchronous = OFF");
    MakeTables(db_);
    db_.exec("BEGIN");
  }
  ~Db3Writer() override { db_.exec("COMMIT"); }

  static void MakeTables(SQLite::Database& db) {
    db.exec(
        "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
        "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)");
    db.exec(
        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp "
        "INTEGER NOT NULL, data BLOB NOT NULL)");
    db.exec("CREATE INDEX timestamp_idx ON messages (timestamp ASC)");
  }

  void Put(const std::string& topic, const std::string& type, std::chrono::nanoseconds logged_at,
           const bag::Bytes& message) override {
    if (!topics_.contains(topic)) {
      SQLite::Statement insert(db_, "INSERT INTO topics VALUES(?, ?, ?, 'cdr', '')");
      const int id = static_cast<int>(topics_.size()) + 1;
      topics_[topic] = id;
      insert.bind(1, id);
      insert.bind(2, topic);
      insert.bind(3, type);
      insert.exec();
    }
    const bag::Bytes bytes = zstd_ ? bag::Compress(bag::Compression::kZstd, message) : message;
    SQLite::Statement insert(db_, "INSERT INTO messages VALUES(NULL, ?, ?, ?)");
    insert.bind(1, topics_[topic]);
    insert.bind(2, static_cast<std::int64_t>(logged_at.count()));
    insert.bind(3, bytes.data(), static_cast<int>(bytes.size()));
    insert.exec();
  }

 private:
  SQLite::Database db_;
  bool zstd_;
  std::map<std::string, int> topics_;
};

class McapBagWriter final : public BagWriter {
 public:
  McapBagWriter(std::filesystem::path file, bag::Compression compression)
      : file_(std::move(file)), writer_(compression, "ros2") {}
  ~McapBagWriter() override {
    writer_.End();
    WriteBytes(file_, writer_.TakeBytes());
  }

  void Put(const std::string& topic, const std::string& type, std::chrono::nanoseconds logged_at,
           const bag::Bytes& message) override {
    if (!channels_.contains(topic)) {
      const auto schema = writer_.AddSchema(type, "ros2msg", {});
      channels_[topic] = writer_.AddChannel(schema, topic, "cdr");
    }
    writer_.Put(channels_[topic], logged_at, message);
  }
  void EndChunk() { writer_.EndChunk(); }

 private:
  std::filesystem::path file_;
  bag::McapWriter writer_;
  std::map<std::string, bag::McapWriter::Id> channels_;
};

}  // namespace trailcast::test
