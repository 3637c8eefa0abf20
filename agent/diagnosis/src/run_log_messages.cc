#include "agent/diagnosis/src/run_log_messages.h"

#include <array>
#include <cmath>
#include <fstream>
#include <string_view>
#include <variant>

#include "agent/diagnosis/src/protobuf_reader.h"
#include "agent/diagnosis/src/protobuf_writer.h"
#include "services/base/text.h"

namespace trailcast::agent {
namespace {

using Bytes = std::span<const std::uint8_t>;
using Field = ProtobufReader::Field;

constexpr std::size_t kLongestValue = 1000;  // of texts
// Logs without pictures compress to a tenth or so. A file that expands more was made to keep its
// readers busy.
constexpr std::uint64_t kMostGrowth = 32;

using Member = std::variant<int FrameRow::*, double FrameRow::*, std::optional<double> FrameRow::*,
                            Phase FrameRow::*, Evidence FrameRow::*>;

// The message Frame has these members, in the order of its fields, which are numbered from 1. The
// writer and the reader both go by this table.
const std::array kMembers = std::to_array<Member>({
    &FrameRow::frame,
    &FrameRow::t_s,
    &FrameRow::segment,
    &FrameRow::fraction,
    &FrameRow::progress,
    &FrameRow::phase,
    &FrameRow::stored,
    &FrameRow::tracked,
    &FrameRow::agreeing,
    &FrameRow::rejected,
    &FrameRow::rejected_by_px,
    &FrameRow::left_picture,
    &FrameRow::not_returned,
    &FrameRow::turn_rad,
    &FrameRow::vision_turn_rad,
    &FrameRow::odometry_turn_rad,
    &FrameRow::delta,
    &FrameRow::delta_minus,
    &FrameRow::left_m,
    &FrameRow::left_sigma_m,
    &FrameRow::heading_rad,
    &FrameRow::along_m,
    &FrameRow::mount_yaw_rad,
    &FrameRow::magnification,
    &FrameRow::driven_m,
    &FrameRow::x_m,
    &FrameRow::y_m,
    &FrameRow::linear_mps,
    &FrameRow::angular_radps,
    &FrameRow::cpu_ms,
    &FrameRow::true_off_m,
    &FrameRow::place,
    &FrameRow::place_sigma,
    &FrameRow::off_route,
    &FrameRow::odometry_trust,
    &FrameRow::odometry_scale,
    &FrameRow::evidence,
});

// Protobuf encodes negative numbers in 64 bits.
void Put(ProtobufWriter& to, std::uint32_t field, int value) {
  to.Number(field, static_cast<std::uint64_t>(std::int64_t{value}));
}
void Put(ProtobufWriter& to, std::uint32_t field, Phase value) {
  Put(to, field, static_cast<int>(value));
}
void Put(ProtobufWriter& to, std::uint32_t field, Evidence value) {
  Put(to, field, static_cast<int>(value));
}
void Put(ProtobufWriter& to, std::uint32_t field, double value) {
  if (std::isfinite(value)) to.Double(field, value);
}
void Put(ProtobufWriter& to, std::uint32_t field, const std::optional<double>& value) {
  if (value) Put(to, field, *value);
}
void Put(ProtobufWriter& to, std::uint32_t field, const std::string& value) {
  to.Bytes(field, PlainText(value, kLongestValue));
}
void Put(ProtobufWriter& to, std::uint32_t field, const Fields& fields) {
  for (const auto& [key, value] : fields.all()) {
    ProtobufWriter pair;
    Put(pair, 1, key);
    Put(pair, 2, value);
    to.Message(field, pair);
  }
}

// Returns false if there is no such value.
bool Take(const Field& field, int& value) {
  value = static_cast<int>(field.integer);
  return true;
}
bool Take(const Field& field, Phase& value) {
  const bool known = field.integer <= static_cast<std::uint64_t>(Phase::kLooking);
  if (known) value = static_cast<Phase>(field.integer);
  return known;
}
bool Take(const Field& field, Evidence& value) {
  const bool known = field.integer <= static_cast<std::uint64_t>(Evidence::kMotion);
  if (known) value = static_cast<Evidence>(field.integer);
  return known;
}
bool Take(const Field& field, double& value) {
  if (std::isfinite(field.real)) value = field.real;
  return true;
}
bool Take(const Field& field, std::optional<double>& value) {
  if (std::isfinite(field.real)) value = field.real;
  return true;
}

std::string TextOf(const Field& field) {
  return PlainText({reinterpret_cast<const char*>(field.bytes.data()), field.bytes.size()},
                   kLongestValue);
}

// Calls `take` with each field of a message; it says whether the field is valid.
template <typename TakeField>
Result<void> ReadAll(Bytes message, const TakeField& take) {
  if (message.size() > kLongestMessage) {
    return Fail(ErrorCode::kCorrupt, "longer than {} bytes", kLongestMessage);
  }
  ProtobufReader reader(message);
  while (const auto field = reader.Next()) {
    if (!take(*field)) return Fail(ErrorCode::kCorrupt, "its field {} is none", field->number);
  }
  if (!reader.whole()) return Fail(ErrorCode::kCorrupt, "its bytes are no message");
  return {};
}

bool TakePair(const Field& field, Fields& fields) {
  std::string key;
  std::string value;
  const auto read = ReadAll(field.bytes, [&](const Field& part) {
    if (part.number == 1) key = TextOf(part);
    if (part.number == 2) value = TextOf(part);
    return true;
  });
  fields.Add(std::move(key), std::move(value));
  return read && fields.all().size() <= kMostFields;
}

}  // namespace

std::string HeaderMessage(const Fields& header) {
  ProtobufWriter message;
  Put(message, 1, header);
  return message.bytes();
}

std::string FrameMessage(const FrameRow& row) {
  ProtobufWriter message;
  std::uint32_t field = 0;
  for (const Member& each : kMembers) {
    ++field;
    std::visit([&](auto member) { Put(message, field, row.*member); }, each);
  }
  return message.bytes();
}

std::string EventMessage(const RunEvent& event) {
  ProtobufWriter message;
  Put(message, 1, event.frame);
  Put(message, 2, event.t_s);
  Put(message, 3, event.what);
  Put(message, 4, event.fields);
  Put(message, 5, event.text);
  return message.bytes();
}

Result<Fields> ReadHeader(Bytes message) {
  Fields header;
  return ReadAll(message,
                 [&](const Field& field) { return field.number != 1 || TakePair(field, header); })
      .map([&] { return std::move(header); });
}

Result<FrameRow> ReadFrame(Bytes message) {
  FrameRow row;
  return ReadAll(message,
                 [&](const Field& field) {
                   return field.number > kMembers.size() ||
                          std::visit([&](auto member) { return Take(field, row.*member); },
                                     kMembers[field.number - 1]);
                 })
      .map([&] { return row; });
}

Result<RunEvent> ReadEvent(Bytes message) {
  RunEvent event;
  return ReadAll(message,
                 [&](const Field& field) {
                   if (field.number == 1) return Take(field, event.frame);
                   if (field.number == 2) return Take(field, event.t_s);
                   if (field.number == 3) event.what = TextOf(field);
                   if (field.number == 4) return TakePair(field, event.fields);
                   if (field.number == 5) event.text = TextOf(field);
                   return true;
                 })
      .map([&] { return std::move(event); });
}

Result<std::unique_ptr<bag::Bag>> OpenMcap(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file)) {
    return Fail(ErrorCode::kNotFound, "it cannot be read");
  }
  constexpr std::string_view kBegins = "\x89MCAP";
  std::string beginning(kBegins.size(), '\0');
  if (!stream.read(beginning.data(), std::ssize(beginning)) || beginning != kBegins) {
    return Fail(ErrorCode::kCorrupt, "it is no MCAP file");
  }
  return bag::Bag::Open(
      file, [](const std::string&) {}, kMostGrowth);
}

}  // namespace trailcast::agent
