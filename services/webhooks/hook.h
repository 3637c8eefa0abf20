#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "services/base/result.h"
#include "services/http/post.h"

namespace trailcast::webhooks {

// This is a URL, and what it is told.
struct Hook {
  std::string url{};
  http::Destination to{};
  std::string secret{};            // signs what is sent; empty: nothing is signed
  std::set<std::string> events{};  // "alert" or "mission", or one of its events, "mission.failed"

  [[nodiscard]] bool Wants(std::string_view event) const;
};

inline constexpr std::size_t kMostHooks = 32;

// Parses [{"url": "https://...", "secret": "...", "events": ["alert", "mission.failed"]}]. Without
// "events" a hook gets all of them. kInvalidArgument says which hook is wrong and what was
// expected.
[[nodiscard]] Result<std::vector<Hook>> ParseHooks(const std::string& json);
// Reads such a file; the error names it.
[[nodiscard]] Result<std::vector<Hook>> LoadHooks(const std::filesystem::path& file);

// Returns the value of the header Trailcast-Signature: "t=1700000000,v1=HEX", where HEX is
// HMAC-SHA256 with the secret over the time, a full stop, and the body.
[[nodiscard]] std::string SignatureOf(const std::string& secret, std::int64_t unix_s,
                                      const std::string& body);

}  // namespace trailcast::webhooks
