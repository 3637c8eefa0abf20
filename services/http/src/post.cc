#include "services/http/post.h"

#include <httplib.h>

#include <algorithm>
#include <string_view>

namespace trailcast::http {

Result<Destination> ParseUrl(const std::string& url) {
  const auto wrong = [&](const char* why) {
    return Fail(ErrorCode::kInvalidArgument,
                "'{}' {}: expected http://HOST[:PORT]/PATH or https://HOST[:PORT]/PATH", url, why);
  };
  const bool is_plain =
      std::all_of(url.begin(), url.end(), [](char c) { return c > ' ' && c <= '~'; });
  if (!is_plain) return wrong("has blanks or other than ASCII");
  std::size_t host = 0;
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (url.starts_with(scheme)) host = scheme.size();
  }
  if (host == 0) return wrong("begins neither with http:// nor with https://");
  const std::size_t path = std::min(url.find('/', host), url.size());
  if (path == host || url[host] == ':') return wrong("names no host");
  if (url.substr(host, path - host).find('@') != std::string::npos) {
    return wrong("has a user in it");
  }
  if (url.find('#') != std::string::npos) return wrong("has a fragment");
  return Destination{url.substr(0, path), path < url.size() ? url.substr(path) : "/"};
}

Result<int> Post(const Destination& to, const std::multimap<std::string, std::string>& headers,
                 const std::string& body, std::chrono::seconds timeout) {
  httplib::Client client(to.origin);
  client.set_connection_timeout(timeout);
  client.set_read_timeout(timeout);
  client.set_write_timeout(timeout);
  client.enable_server_certificate_verification(true);
  httplib::Headers sent;
  for (const auto& [name, value] : headers) sent.emplace(name, value);
  const auto answer = client.Post(to.path, sent, body, "application/json");
  if (!answer) {
    return Fail(ErrorCode::kUnavailable, "{}: no answer: {}", to.origin,
                httplib::to_string(answer.error()));
  }
  return answer->status;
}

}  // namespace trailcast::http
