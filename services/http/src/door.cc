#include "services/http/door.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace trailcast::http {
namespace {

// Returns "name" from "name:port".
std::string NameOf(const std::string& host) {
  const std::size_t colon = host.rfind(':');
  const bool in_brackets = !host.empty() && host.back() == ']';
  return colon == std::string::npos || in_brackets ? host : host.substr(0, colon);
}

bool IsOurs(const std::string& host, const Door& door) {
  for (const char* name : {"localhost", "127.0.0.1", "[::1]"}) {
    if (host == fmt::format("{}:{}", name, door.port)) return true;
    if (door.port == 80 && host == name) return true;
  }
  return door.any_name || door.names.contains(NameOf(host));
}

// Other pages cannot send these types without asking first (the Fetch standard, section 2.2.2,
// safelisted types).
bool IsOfOurs(const std::string& content_type) {
  std::string type = content_type.substr(0, content_type.find(';'));
  while (!type.empty() && type.back() == ' ') type.pop_back();
  type = Lower(type);
  return type == "application/json" || type == "application/octet-stream" || type == "image/jpeg" ||
         type == "image/png";
}

}  // namespace

std::string Lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::optional<Refusal> Judge(const httplib::Request& request, const Door& door) {
  // Every browser names the host. A client that does not cannot have been misled by a page.
  const std::size_t hosts = request.get_header_value_count("Host");
  const std::string host = Lower(request.get_header_value("Host"));
  if (hosts > 1 || (hosts == 1 && !IsOurs(host, door))) {
    return Refusal{421,
                   "this is not the host that was asked for: use localhost with the port, or "
                   "start the program with --allowed-host NAME"};
  }
  const std::string origin = Lower(request.get_header_value("Origin"));
  const bool own_origin = origin.empty() || origin == "https://" + host ||
                          (!door.encrypted && origin == "http://" + host);
  const std::string site = request.get_header_value("Sec-Fetch-Site");
  const bool own_site = site.empty() || site == "same-origin" || site == "none";
  const bool is_guarded = request.path.starts_with(door.guarded) || request.method != "GET";
  if (is_guarded && !(own_origin && own_site)) {
    return Refusal{403, "this comes from another page than this program's own"};
  }
  return std::nullopt;
}

std::optional<Refusal> JudgeType(const httplib::Request& request) {
  if (request.method != "POST") return std::nullopt;
  if (BringsNoBody(request) && !request.has_header("Content-Type")) return std::nullopt;
  if (IsOfOurs(request.get_header_value("Content-Type"))) return std::nullopt;
  return Refusal{415,
                 "a POST needs 'Content-Type: application/json', or of a file image/jpeg, "
                 "image/png or application/octet-stream"};
}

}  // namespace trailcast::http
