#pragma once

#include <httplib.h>

#include <optional>
#include <set>
#include <string>

#include "services/http/server.h"

namespace trailcast::http {

// As hosts and types are compared.
[[nodiscard]] std::string Lower(std::string text);

// Any page that a browser shows, from wherever it came, can have it send requests to a program that
// listens on its machine, and under a name that somebody points at 127.0.0.1 (DNS rebinding) even
// read the answers. The door lets in what was meant for this program and comes from its own page,
// or from no page at all.
struct Door {
  int port = 0;                      // on which localhost, 127.0.0.1 and [::1] are this program
  std::set<std::string> names = {};  // and other names of it, with any port, in lower case
  bool any_name = false;             // where who comes has to say who they are
  bool encrypted = false;            // its own pages come by https alone
  std::string guarded = "/api/";     // paths below it are for its own pages only
};

// Why it is not let in: 421 for another host's, 403 from another page.
[[nodiscard]] std::optional<Refusal> Judge(const httplib::Request& request, const Door& door);

// 415 for a POST whose body is said to be neither JSON nor a file, which other pages could send
// without being asked. What brings no body needs no type.
[[nodiscard]] std::optional<Refusal> JudgeType(const httplib::Request& request);

}  // namespace trailcast::http
