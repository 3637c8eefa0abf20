#pragma once

#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/exchange/messages.h"
#include "services/fleet/now_client.h"

namespace trailcast::console {

// The bodies of requests and of replies, as openapi.yaml has them. What is read may be anything:
// kInvalidArgument says what was expected.

// {"reason": ".."}, or nothing at all.
[[nodiscard]] Result<std::string> ReadReason(const std::string& body);

struct SendBody {
  std::string orders;
  std::string id;  // empty: to be drawn
  std::uint32_t valid_s = 600;
  bool goes_on = false;
};
[[nodiscard]] Result<SendBody> ReadSend(const std::string& body);

[[nodiscard]] std::string ErrorBody(const std::string& why);
[[nodiscard]] std::string WordBody(const fleet::RobotsWord& word);
[[nodiscard]] std::string WordsBody(const std::vector<fleet::RobotsWord>& words);
[[nodiscard]] std::string ReportBody(const mission::Report& report);
[[nodiscard]] std::string MissionsBody(const std::vector<mission::Record>& missions);

}  // namespace trailcast::console
