#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <map>
#include <memory>
#include <set>

#include "services/bag/compression.h"
#include "services/bag/src/bag_file.h"

namespace trailcast::bag {

// A file of rosbag2's SQLite storage, of any version, because it reads only the columns that all
// versions have. Messages may be compressed one by one. Rows on damaged pages are left out.
class Db3File final : public BagFile {
 public:
  [[nodiscard]] static Result<std::unique_ptr<Db3File>> Open(const std::filesystem::path& file);

  // Returns how many bytes are whole pages. SQLite would read a page that was cut through with
  // zeros for the missing part.
  [[nodiscard]] static std::uintmax_t WholeBytes(std::uintmax_t size,
                                                 std::span<const std::uint8_t> beginning);

  [[nodiscard]] Result<Contents> Survey(const Bag::Tell& tell) override;
  void Begin(const Topic& topic, std::chrono::nanoseconds from) override;
  [[nodiscard]] Result<std::optional<Message>> Next() override;

 private:
  Db3File(std::unique_ptr<SQLite::Database> db, std::map<std::int64_t, Topic> topics)
      : db_(std::move(db)), topics_(std::move(topics)) {}

  // Steps to the next row of `rows_` that can be read; returns false at the end.
  [[nodiscard]] bool Step();
  [[nodiscard]] bool SkipDamage(const SQLite::Exception& damage);
  void Select(const std::string& columns, const std::set<std::int64_t>& topics);
  [[nodiscard]] std::optional<Message> Unpacked(std::span<const std::uint8_t> bytes);

  std::unique_ptr<SQLite::Database> db_;
  std::map<std::int64_t, Topic> topics_;  // by their ids
  std::set<std::int64_t> wanted_;         // ids of the wanted ones
  std::int64_t from_ns_ = 0;
  std::unique_ptr<SQLite::Statement> rows_;
  std::int64_t last_id_ = 0;
  std::int64_t jump_ = 1;  // how many rows to skip when one cannot be read
  Bytes message_;
};

}  // namespace trailcast::bag
