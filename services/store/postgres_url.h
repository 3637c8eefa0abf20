#pragma once

#include <string>
#include <string_view>

#include "services/base/result.h"

namespace trailcast::store {

// Whether `location` is meant to be one: postgresql://.. or postgres://..
[[nodiscard]] bool IsPostgresUrl(std::string_view location);

// Where a PostgreSQL database is, in the form that its library takes.
struct PostgresUrl {
  std::string connection;  // with bounds on waiting that the given one lacked; may have a password
  std::string shown;       // for messages: host, port and database, with the user; never a password
};

// kInvalidArgument when it could be read in two ways, one of which takes a part of a password for a
// host's name and would print it. All else is the library's to judge.
[[nodiscard]] Result<PostgresUrl> ParsePostgresUrl(const std::string& location);

}  // namespace trailcast::store
