#pragma once

#include <httplib.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/described.h"

namespace trailcast::console {

// This is the console's answer to a request; the status is 0 if there was none.
struct Replied {
  int status = 0;
  nlohmann::json body{};
  [[nodiscard]] std::string error() const { return body.value("error", ""); }
};

inline Replied ReplyOf(const httplib::Result& got) {
  if (!got) return {};
  return {got->status, nlohmann::json::parse(got->body, nullptr, /*allow_exceptions=*/false)};
}

// Returns a client of the console at that port, which holds all answers against its description.
inline httplib::Client ClientOf(int port, std::chrono::seconds patience) {
  httplib::Client client("localhost", port);
  client.set_logger(ExpectAsDescribed());
  client.set_read_timeout(patience);
  return client;
}

}  // namespace trailcast::console
