#include "services/store/postgres_url.h"

namespace trailcast::store {
namespace {

// A server that is gone without a word is noticed within seconds. The URL's own settings come
// later, and take precedence.
constexpr std::string_view kBounds =
    "connect_timeout=3&tcp_user_timeout=10000&keepalives_idle=5&keepalives_interval=2&"
    "keepalives_count=3&application_name=trailcast";
constexpr std::string_view kSchemes[] = {"postgresql://", "postgres://"};

std::size_t SchemeLength(std::string_view location) {
  for (const std::string_view scheme : kSchemes) {
    if (location.starts_with(scheme)) return scheme.size();
  }
  return 0;
}

bool CanBeUser(std::string_view user) {
  const std::size_t colon = user.find(':');
  const bool one_password =
      colon == std::string_view::npos || user.find(':', colon + 1) == std::string_view::npos;
  return one_password && user.find_first_of("@/?#") == std::string_view::npos;
}

}  // namespace

bool IsPostgresUrl(std::string_view location) { return SchemeLength(location) > 0; }

Result<PostgresUrl> ParsePostgresUrl(const std::string& location) {
  const std::string_view scheme = std::string_view(location).substr(0, SchemeLength(location));
  const std::string_view rest = std::string_view(location).substr(scheme.size());
  const std::size_t at = rest.rfind('@');
  const std::string_view user = at == std::string_view::npos ? "" : rest.substr(0, at);
  if (!CanBeUser(user)) {
    return Fail(ErrorCode::kInvalidArgument,
                "the PostgreSQL URL cannot be read: expected {}user@host:port/database; an @ : / ? "
                "or # in a password must be written %40 %3A %2F %3F %23, or leave the password out "
                "and put it in ~/.pgpass",
                scheme);
  }
  const std::string_view host = rest.substr(user.empty() ? 0 : at + 1);
  const std::size_t query = host.find('?');
  PostgresUrl url;
  url.shown = fmt::format("{}{}{}{}", scheme, user.substr(0, user.find(':')),
                          user.empty() ? "" : "@", host.substr(0, query));
  const std::string_view settings =
      query == std::string_view::npos ? std::string_view() : host.substr(query + 1);
  url.connection = fmt::format("{}?{}{}{}", location.substr(0, location.find('?')), kBounds,
                               settings.empty() ? "" : "&", settings);
  return url;
}

}  // namespace trailcast::store
