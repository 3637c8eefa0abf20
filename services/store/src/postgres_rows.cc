#include "services/store/src/postgres_rows.h"

#include <algorithm>
#include <cstdlib>

#include "services/route/digest.h"
#include "services/store/src/row_values.h"

namespace trailcast::store {
namespace {

double ReadDouble(const pqxx::field& field) { return std::strtod(field.c_str(), nullptr); }

// Nothing when it has another length than a digest.
std::optional<route::Digest> ReadDigest(const pqxx::field& field) {
  const route::Bytes bytes = ReadBytes(field);
  route::Digest digest{};
  if (bytes.size() != digest.size()) return std::nullopt;
  std::copy(bytes.begin(), bytes.end(), digest.begin());
  return digest;
}

std::optional<route::Place> ReadPlace(const pqxx::row& row, int first) {
  if (row[first].is_null()) return std::nullopt;
  return route::Place{static_cast<route::Place::Frame>(row[first].as<int>()),
                      ReadDouble(row[first + 1]), ReadDouble(row[first + 2])};
}

}  // namespace

route::Bytes ReadBytes(const pqxx::field& field) {
  if (field.is_null()) return {};
  const pqxx::binarystring bytes(field);
  return {bytes.begin(), bytes.end()};
}

void PostgresValues::Add(const std::string& text) {
  // It would be cut off there.
  if (text.find('\0') != std::string::npos) throw pqxx::argument_error("a text has a zero byte");
  values_.emplace_back(text);
}

void PostgresValues::AddBytes(const std::uint8_t* bytes, std::size_t size) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text = "\\x";
  text.reserve(2 + 2 * size);
  for (std::size_t i = 0; i < size; ++i) {
    text += kDigits[bytes[i] >> 4U];
    text += kDigits[bytes[i] & 15U];
  }
  values_.emplace_back(std::move(text));
}

void PostgresValues::Add(const route::RouteKey& key) {
  Add(key.route.value());
  Add(static_cast<std::int64_t>(key.teaching.value()));
}

void PostgresValues::Add(const std::vector<SqlCondition::Value>& values) {
  for (const SqlCondition::Value& value : values) {
    std::visit([this](const auto& each) { Add(each); }, value);
  }
}

void PostgresValues::AddRoute(const route::RouteInfo& info, std::int64_t grown_unix_ms) {
  Add(info.key);
  Add(info.name);
  Add(info.scout.value());
  Add(info.camera);
  Add(std::int64_t{info.image_width_px});
  Add(std::int64_t{info.image_height_px});
  Add(info.taught_unix_ms);
  Add(static_cast<std::int64_t>(info.state));
  Add(std::int64_t{info.segment_count});
  Add(info.length_m);
  Add(static_cast<std::int64_t>(info.bytes));
  Add(info.manifest_digest);
  Add(Seal(info));
  Add(JoinTags(info.tags));
  if (info.place) {
    Add(static_cast<std::int64_t>(info.place->frame));
    Add(info.place->x);
    Add(info.place->y);
  } else {
    for (int column = 0; column < 3; ++column) AddNull();
  }
  Add(info.description);
  Add(static_cast<std::int64_t>(info.standing));
  Add(std::int64_t{info.edition});
  Add(std::int64_t{info.revision.value()});
  Add(std::string(info.cut_off ? "true" : "false"));
  Add(grown_unix_ms);
}

void PostgresValues::AddSegment(const route::SegmentPiece& piece) {
  Add(piece.key);
  Add(std::int64_t{piece.index.value()});
  Add(piece.digest);
  Add(Seal(piece));
}

std::string PostgresValues::Rows(std::size_t columns) const {
  std::string rows;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const bool first = i % columns == 0;
    rows += fmt::format("{}${}{}",
                        !first   ? ","
                        : i == 0 ? "("
                                 : ",(",
                        i + 1, (i + 1) % columns == 0 ? ")" : "");
  }
  return rows;
}

pqxx::result PostgresValues::Execute(pqxx::transaction_base& transaction,
                                     const std::string& sql) const {
  std::string numbered;
  int number = 0;
  for (const char c : sql) {
    c == '?' ? numbered.append(fmt::format("${}", ++number)) : numbered.append(1, c);
  }
  std::vector<const char*> texts;
  for (const auto& value : values_) texts.push_back(value ? value->c_str() : nullptr);
  return transaction.exec_params(numbered, pqxx::prepare::make_dynamic_params(texts));
}

route::RouteKey ReadKey(const pqxx::row& row) {
  return {RouteId(row[0].as<std::string>()), TeachingId(row[1].as<std::uint64_t>())};
}

Result<route::RouteInfo> ReadRoute(const pqxx::row& row) {
  route::RouteInfo info;
  info.key = ReadKey(row);
  info.name = row[2].as<std::string>();
  info.scout = AgentId(row[3].as<std::string>());
  info.camera = row[4].as<std::string>();
  info.image_width_px = row[5].as<int>();
  info.image_height_px = row[6].as<int>();
  info.taught_unix_ms = row[7].as<std::int64_t>();
  info.state = row[8].as<int>() == 0 ? route::RouteState::kTeaching : route::RouteState::kComplete;
  info.segment_count = row[9].as<std::uint32_t>();
  info.length_m = ReadDouble(row[10]);
  info.bytes = row[11].as<std::uint64_t>();
  const std::optional<route::Digest> manifest = ReadDigest(row[12]);
  const std::optional<route::Digest> seal = ReadDigest(row[13]);
  info.tags = SplitTags(row[14].as<std::string>());
  info.place = ReadPlace(row, 15);
  info.description = row[18].as<std::string>();
  info.standing = static_cast<route::Standing>(row[19].as<int>());
  info.edition = row[20].as<std::uint32_t>();
  info.revision = RevisionNumber(row[21].as<std::uint32_t>());
  info.cut_off = row[22].as<bool>();
  info.manifest_digest = manifest.value_or(route::Digest{});
  if (!manifest || seal != Seal(info)) return DamagedRoute(info);
  return info;
}

Result<route::Digest> ReadSegmentDigest(const pqxx::row& row, const route::RouteKey& key,
                                        SegmentIndex index) {
  const std::optional<route::Digest> digest = ReadDigest(row["digest"]);
  const route::SegmentPiece named{key, index, digest.value_or(route::Digest{}), {}};
  if (!digest || ReadDigest(row["seal"]) != Seal(named)) return DamagedSegment(key, index);
  return *digest;
}

Result<route::SegmentPiece> ReadSegmentRow(const pqxx::row& row, const route::RouteKey& key,
                                           SegmentIndex index) {
  const Result<route::Digest> digest = ReadSegmentDigest(row, key, index);
  if (!digest) return tl::unexpected(digest.error());
  route::SegmentPiece piece{key, index, *digest, ReadBytes(row["bytes"])};
  if (auto whole = route::CheckDigest(piece); !whole) return tl::unexpected(whole.error());
  return piece;
}

}  // namespace trailcast::store
