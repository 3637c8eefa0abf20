#pragma once

#include <string>
#include <string_view>

#include "services/base/result.h"

namespace trailcast::store {

// Says whether `location` is a URL: postgresql://.. or postgres://..
[[nodiscard]] bool IsPostgresUrl(std::string_view location);

// The place of a PostgreSQL database in the form that its library takes.
struct PostgresUrl {
  std::string connection;  // with bounds on waiting that the URL lacked; may have a password
  std::string shown;       // for messages: host, port, database and user, never a password
};

// kInvalidArgument means that the URL can be read in two ways, one of which takes a part of a
// password for a host's name and would print it. The library judges everything else.
[[nodiscard]] Result<PostgresUrl> ParsePostgresUrl(const std::string& location);

}  // namespace trailcast::store
