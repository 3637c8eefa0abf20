#pragma once

#include <chrono>
#include <map>
#include <string>

#include "services/base/result.h"

namespace trailcast::http {

// Where a URL leads: "https://host:port", and the path with what follows it.
struct Destination {
  std::string origin{};
  std::string path{};
};
// kInvalidArgument says what is wrong with it: it has to be http:// or https://, and to name a
// host.
[[nodiscard]] Result<Destination> ParseUrl(const std::string& url);

// Sends `body` as JSON and returns the answer's status. It follows no redirection, and believes
// those servers over TLS whom this machine's authorities vouch for. kUnavailable says why there was
// no answer within this time.
[[nodiscard]] Result<int> Post(const Destination& to,
                               const std::multimap<std::string, std::string>& headers,
                               const std::string& body, std::chrono::seconds timeout);

}  // namespace trailcast::http
