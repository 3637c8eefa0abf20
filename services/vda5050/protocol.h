#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trailcast::vda5050 {

// The versions of VDA 5050 that the gateway speaks. They differ in names, and in what 2.1 lacks.
enum class Version : std::uint8_t { k2_1, k3_0 };

// A robot as the standard names it.
struct Identity {
  Version version = Version::k3_0;
  std::string manufacturer{};  // IsTopicWord
  std::string serial{};        // the robot's name in the fleet
};

// Messages of strangers beyond these bounds are refused. The factsheet tells them.
inline constexpr std::size_t kMostBytes = 256U << 10U;
inline constexpr std::size_t kMostNodes = 256;
inline constexpr std::size_t kMostIdBytes = 128;
inline constexpr std::size_t kMostActions = 32;       // instant actions of one message
inline constexpr std::size_t kMostActionStates = 64;  // told in the state

// Says whether a text can be one level of a topic: 1 to 64 of [A-Za-z0-9_.:-].
[[nodiscard]] bool IsTopicWord(std::string_view text);

// Returns "vda5050/v3/trailcast/robot1/state", or, of 2.1, "uagv/v2/trailcast/robot1/state".
[[nodiscard]] std::string TopicOf(const Identity& identity, std::string_view topic);

// Returns the members that begin each message. Times are in milliseconds since 1970.
[[nodiscard]] nlohmann::ordered_json Header(const Identity& identity, std::uint32_t header_id,
                                            std::int64_t unix_ms);

// What 2.1 calls WARNING or FATAL: it has no other levels.
enum class Level : std::uint8_t { kWarning, kUrgent, kCritical, kFatal };

// An entry of the state's errors. Types are those of 3.0 for both versions, since 2.1 leaves them
// open.
struct Fault {
  std::string type{};
  Level level = Level::kWarning;
  std::string description{};
  std::string hint{};  // what to do; may be empty
  std::vector<std::pair<std::string, std::string>> references{};
  bool operator==(const Fault&) const = default;
};

// Returns it as the state has it. Texts may come from anybody, and are made plain and short.
[[nodiscard]] nlohmann::ordered_json FaultJson(const Fault& fault, Version version);

// How the broker's other users see a robot: whether this gateway hears it.
enum class Connection : std::uint8_t { kOnline, kOffline, kBroken };

// Returns the message on the topic `connection`.
[[nodiscard]] std::string ConnectionText(const Identity& identity, Connection connection,
                                         std::uint32_t header_id, std::int64_t unix_ms);

// A robot's body, of which the factsheet has to tell and the gateway knows nothing. Lengths are in
// metres, speeds in m/s, accelerations in m/s^2.
struct Body {
  std::string series = "trailcast";
  double most_speed_mps = 1.0;
  double most_acceleration = 1.0;
  double length_m = 1.0;
  double width_m = 1.0;
  double height_m = 1.0;
};

[[nodiscard]] std::string FactsheetText(const Identity& identity, const Body& body,
                                        std::uint32_t header_id, std::int64_t unix_ms);

}  // namespace trailcast::vda5050
