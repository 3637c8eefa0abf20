#include "services/store/src/postgres/postgres_rows.h"

#include <algorithm>
#include <cstdlib>

#include "services/base/hex.h"
#include "services/route/digest.h"
#include "services/route/info_codec.h"

namespace trailcast::store {
namespace {

// Returns nothing if it does not have a digest's length.
std::optional<route::Digest> ReadDigest(const pqxx::field& field) {
  const route::Bytes bytes = ReadBytes(field);
  route::Digest digest{};
  if (bytes.size() != digest.size()) return std::nullopt;
  std::copy(bytes.begin(), bytes.end(), digest.begin());
  return digest;
}

bool Is(const pqxx::field& field, const SqlValue& value) {
  if (field.is_null()) return std::holds_alternative<std::monostate>(value);
  if (const auto* text = std::get_if<std::string>(&value)) return *text == field.c_str();
  if (const auto* real = std::get_if<double>(&value)) return ReadDouble(field) == *real;
  const auto* number = std::get_if<std::int64_t>(&value);
  return number != nullptr && field.as<std::int64_t>() == *number;
}

}  // namespace

double ReadDouble(const pqxx::field& field) { return std::strtod(field.c_str(), nullptr); }

route::Bytes ReadBytes(const pqxx::field& field) {
  if (field.is_null()) return {};
  const pqxx::binarystring bytes(field);
  return {bytes.begin(), bytes.end()};
}

void PostgresValues::Add(const std::string& text) {
  // The text would be cut off there.
  if (text.find('\0') != std::string::npos) throw pqxx::argument_error("a text has a zero byte");
  values_.emplace_back(text);
}

void PostgresValues::AddBytes(const std::uint8_t* bytes, std::size_t size) {
  values_.emplace_back("\\x" + ToHex({bytes, size}));
}

void PostgresValues::Add(const route::RouteKey& key) {
  Add(key.route.value());
  Add(static_cast<std::int64_t>(key.teaching.value()));
}

void PostgresValues::Add(const std::vector<SqlValue>& values) {
  for (const SqlValue& value : values) {
    std::visit([this](const auto& each) { Add(each); }, value);
  }
}

void PostgresValues::AddRoute(const route::RouteInfo& info) {
  const route::Bytes bytes = route::EncodeInfo(info);
  Add(FoundBy(info));
  AddBytes(bytes.data(), bytes.size());
  Add(route::Sha256(bytes));
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
  auto info = OpenInfo(ReadBytes(row[kFoundByCount]), ReadBytes(row[kFoundByCount + 1]),
                       [&](int i, const SqlValue& value) { return Is(row[i], value); });
  if (info) return info;
  return DamagedRoute(ReadKey(row), row[3].as<std::string>());
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
