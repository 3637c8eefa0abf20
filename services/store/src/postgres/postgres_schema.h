#pragma once

#include <pqxx/pqxx>
#include <string>

#include "services/base/result.h"

namespace trailcast::store {

// All our tables are in a schema of their own, so that a database may hold other things beside.
inline constexpr const char* kSchemaName = "trailcast";

// Makes the tables if `create` and there are none; two processes may do so at once. Errors, naming
// the store: kInvalidArgument when there are none, when they are of another version, or when
// PostgreSQL is too old or the database not in UTF-8. Throws libpqxx's exceptions.
[[nodiscard]] Result<void> PrepareSchema(pqxx::connection& connection, const std::string& store,
                                         bool create);

// What of a PostgreSQL server and a database the store cannot do with.
[[nodiscard]] Result<void> CheckServer(int version, const std::string& encoding,
                                       const std::string& store);

}  // namespace trailcast::store
