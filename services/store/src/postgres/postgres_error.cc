#include "services/store/src/postgres/postgres_error.h"

#include <algorithm>
#include <pqxx/except>
#include <sstream>
#include <string_view>

namespace trailcast::store {
namespace {

// https://www.postgresql.org/docs/15/errcodes-appendix.html: the first two letters are the class.
std::string_view StateOf(const std::exception& thrown) {
  const auto* sql = dynamic_cast<const pqxx::sql_error*>(&thrown);
  return sql == nullptr ? std::string_view() : std::string_view(sql->sqlstate());
}

template <typename Kind>
bool Is(const std::exception& thrown) {
  return dynamic_cast<const Kind*>(&thrown) != nullptr;
}

// Lines that begin with a tab are libpq's own advice.
std::string OneLine(const std::string& text) {
  std::string joined;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.front() == '\t') continue;
    joined += (joined.empty() ? "" : " ") + line;
  }
  return joined;
}

struct Advice {
  std::string_view sign;  // beginning of a state, or part of a message
  ErrorCode code;
  std::string_view text;
};

constexpr Advice kByState[] = {
    {"22", ErrorCode::kInvalidArgument, ""},
    {"25006", ErrorCode::kUnavailable, "; is that a standby? Name the primary"},
    {"42501", ErrorCode::kInvalidArgument,
     "; the user must own the store's tables, and may create them only in a database of its own "
     "(createdb -O USER DATABASE)"},
    {"53100", ErrorCode::kUnavailable,
     "; nothing of this was stored: free disk space on PostgreSQL's machine"},
    {"53300", ErrorCode::kUnavailable, "; raise max_connections or stop another client"},
    {"53", ErrorCode::kUnavailable, ""},
    {"55P03", ErrorCode::kUnavailable, "; another server holds on to what this needs: is it hung?"},
    {"57014", ErrorCode::kUnavailable, "; PostgreSQL is too slow at present"},
    {"58", ErrorCode::kUnavailable, "; look at PostgreSQL's log"},
    {"XX", ErrorCode::kCorrupt, "; look at PostgreSQL's log, and restore a backup if need be"},
};

constexpr Advice kByConnectMessage[] = {
    {"password", ErrorCode::kInvalidArgument,
     "; put the right one in ~/.pgpass (host:port:database:user:password, mode 0600) or "
     "PGPASSWORD"},
    {"database \"", ErrorCode::kInvalidArgument, "; create it: createdb -O USER DATABASE"},
    {"role \"", ErrorCode::kInvalidArgument, "; create it: createuser --pwprompt USER"},
    {"pg_hba.conf", ErrorCode::kInvalidArgument,
     "; allow this user and host in PostgreSQL's pg_hba.conf"},
    {"Peer authentication", ErrorCode::kInvalidArgument,
     "; allow a password in PostgreSQL's pg_hba.conf, or name the host"},
};
// Other messages quote the URL, and perhaps a password in it.
constexpr std::string_view kQuotable[] = {"connection to server", "could not translate host name",
                                          "could not connect"};

}  // namespace

PostgresTrouble TroubleOf(const std::exception& thrown) {
  const std::string_view state = StateOf(thrown);
  if (Is<pqxx::broken_connection>(thrown) || Is<pqxx::in_doubt_error>(thrown) ||
      state.starts_with("08") || state.starts_with("57P")) {
    return PostgresTrouble::kLost;
  }
  // This includes a content that another transaction deleted while this one pointed to it: 23503.
  const bool in_the_way =
      Is<pqxx::transaction_rollback>(thrown) || state.starts_with("40") || state == "23503";
  return in_the_way ? PostgresTrouble::kInTheWay : PostgresTrouble::kOther;
}

Error ToError(const std::exception& thrown, const std::string& store, const std::string& doing) {
  const auto error = [&](ErrorCode code, std::string_view advice) {
    return Error{code, fmt::format("route store {}: {}: {}{}", store, doing, OneLine(thrown.what()),
                                   advice)};
  };
  if (TroubleOf(thrown) != PostgresTrouble::kOther) return error(ErrorCode::kUnavailable, "");
  for (const Advice& advice : kByState) {
    if (StateOf(thrown).starts_with(advice.sign)) return error(advice.code, advice.text);
  }
  const bool argument = Is<pqxx::argument_error>(thrown);
  return error(argument ? ErrorCode::kInvalidArgument : ErrorCode::kInternal, "");
}

Error ToConnectError(const std::exception& thrown, const std::string& store) {
  const std::string message = OneLine(thrown.what());
  const auto error = [&](ErrorCode code, std::string_view advice) {
    return Error{code, fmt::format("route store {}: {}{}", store, message, advice)};
  };
  if (std::none_of(std::begin(kQuotable), std::end(kQuotable),
                   [&](std::string_view start) { return message.starts_with(start); })) {
    return {ErrorCode::kInvalidArgument,
            fmt::format("route store {}: the URL is not one that PostgreSQL's library takes; "
                        "expected postgresql://user@host:port/database",
                        store)};
  }
  for (const Advice& advice : kByConnectMessage) {
    if (message.find(advice.sign) != std::string::npos) return error(advice.code, advice.text);
  }
  return error(ErrorCode::kUnavailable,
               "; is PostgreSQL running there, and listening to this machine (listen_addresses)?");
}

}  // namespace trailcast::store
