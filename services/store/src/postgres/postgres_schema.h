#pragma once

#include <pqxx/pqxx>
#include <string>

#include "services/base/result.h"

namespace trailcast::store {

// All our tables are in a schema of their own, so that a database may hold other things as well.
inline constexpr const char* kSchemaName = "trailcast";

// Makes the tables if `create` is set and there are none; two processes may do so at once. Errors
// name the store: kInvalidArgument if there are none, if they are of another version, or if
// PostgreSQL is too old or the database not in UTF-8. It throws libpqxx's exceptions.
[[nodiscard]] Result<void> PrepareSchema(pqxx::connection& connection, const std::string& store,
                                         bool create);

// Checks the properties of a PostgreSQL server and a database that the store needs.
[[nodiscard]] Result<void> CheckServer(int version, const std::string& encoding,
                                       const std::string& store);

}  // namespace trailcast::store
