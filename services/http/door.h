#pragma once

#include <httplib.h>

#include <optional>
#include <set>
#include <string>

#include "services/http/server.h"

namespace trailcast::http {

// Hosts and types are compared in lower case.
[[nodiscard]] std::string Lower(std::string text);

// Decides which requests are let in: those meant for this program that come from its own page, or
// from no page at all. Any page in a browser can send requests to a program on the same machine,
// and under a name that points at 127.0.0.1 (DNS rebinding) it can even read the answers.
struct Door {
  int port = 0;                      // on this port, localhost, 127.0.0.1 and [::1] are this
                                     // program
  std::set<std::string> names = {};  // its other names, with any port, in lower case
  bool any_name = false;             // allowed where clients have to authenticate
  bool encrypted = false;            // its own pages come by https only
  std::string guarded = "/api/";     // only its own pages may use paths below this
};

// Returns why a request is not let in: 421 if it is for another host, 403 if it is from another
// page.
[[nodiscard]] std::optional<Refusal> Judge(const httplib::Request& request, const Door& door);

// Returns 415 for a POST whose type is neither JSON nor a file, because other pages can send such a
// body without asking. A request without a body needs no type.
[[nodiscard]] std::optional<Refusal> JudgeType(const httplib::Request& request);

}  // namespace trailcast::http
