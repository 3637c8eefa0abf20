#include "services/store/src/postgres/postgres_session.h"

#include "services/store/src/postgres/postgres_error.h"
#include "services/store/src/postgres/postgres_schema.h"

namespace trailcast::store {
namespace {

using Clock = std::chrono::steady_clock;

// Trying to connect may take seconds, in which no client is answered.
constexpr std::chrono::seconds kReconnectEvery{1};
constexpr int kAttempts = 5;

// libpqxx restores these if it reconnects by itself.
void Configure(pqxx::connection& connection, PostgresSession::Access access) {
  connection.set_client_encoding("UTF8");
  connection.set_variable("search_path", kSchemaName);
  connection.set_variable("statement_timeout", "'30s'");
  connection.set_variable("lock_timeout", "'10s'");
  // A process that stops within a transaction must not hold up the others for long.
  connection.set_variable("idle_in_transaction_session_timeout", "'10s'");
  if (access == PostgresSession::Access::kReadOnly) {
    connection.set_variable("default_transaction_read_only", "on");
  }
  // Stronger settings, which wait for standbys, are the operator's.
  if (connection.get_variable("synchronous_commit") == "off") {
    connection.set_variable("synchronous_commit", "on");
  }
}

}  // namespace

Result<std::unique_ptr<PostgresSession>> PostgresSession::Open(const std::string& location,
                                                               Access access,
                                                               std::chrono::milliseconds patience) {
  Result<PostgresUrl> url = ParsePostgresUrl(location);
  if (!url) return tl::unexpected(url.error());
  std::unique_ptr<PostgresSession> session(new PostgresSession(std::move(*url), access, patience));
  const bool create = access == Access::kReadWrite;
  if (auto connected = session->Connect(create); !connected) {
    return tl::unexpected(connected.error());
  }
  return session;
}

Result<void> PostgresSession::Connect(bool create) {
  try {
    link_ = std::make_unique<Link>(url_.connection);
  } catch (const std::exception& thrown) {
    return tl::unexpected(ToConnectError(thrown, name()));
  }
  Result<void> ours;
  try {
    const SilenceWatch::Guard guard(watch_, link_->connection.sock());
    Configure(link_->connection, access_);
    ours = PrepareSchema(link_->connection, name(), create);
  } catch (const std::exception& thrown) {
    ours = tl::unexpected(ToError(thrown, name(), "opening it"));
  }
  if (!ours) link_.reset();
  return ours;
}

Result<void> PostgresSession::Reconnect() {
  if (Clock::now() < reconnect_at_) return tl::unexpected(lost_);
  const Result<void> connected = Connect(false);
  if (connected) return {};
  lost_ = {ErrorCode::kUnavailable, connected.error().message};
  reconnect_at_ = Clock::now() + kReconnectEvery;
  return tl::unexpected(lost_);
}

Result<void> PostgresSession::Attempt(Kind kind, const std::string& doing, const Work& work) {
  if (current_ != nullptr) return AttemptWithin(doing, work);
  for (int attempt = 1;; ++attempt) {
    if (link_ == nullptr) {
      if (auto connected = Reconnect(); !connected) return connected;
    }
    try {
      RunOnce(kind, work);
      return {};
    } catch (const std::exception& thrown) {
      const PostgresTrouble trouble = TroubleOf(thrown);
      if (trouble == PostgresTrouble::kLost) link_.reset();
      if (trouble == PostgresTrouble::kOther || attempt == kAttempts) {
        return tl::unexpected(ToError(thrown, name(), doing));
      }
    }
  }
}

// The transaction is of no use any more; its own Attempt learns why.
Result<void> PostgresSession::AttemptWithin(const std::string& doing, const Work& work) {
  try {
    work(*current_);
    return {};
  } catch (const std::exception& thrown) {
    if (!failed_within_) failed_within_ = std::current_exception();
    return tl::unexpected(ToError(thrown, name(), doing));
  }
}

void PostgresSession::RunOnce(Kind kind, const Work& work) {
  const SilenceWatch::Guard guard(watch_, link_->connection.sock());
  std::unique_ptr<pqxx::transaction_base> transaction;
  if (kind == Kind::kRead) {
    transaction = std::make_unique<pqxx::nontransaction>(link_->connection);
  } else {
    transaction = std::make_unique<pqxx::work>(link_->connection);
  }
  failed_within_ = nullptr;
  current_ = transaction.get();
  const auto forget = [this](void*) { current_ = nullptr; };
  const std::unique_ptr<void, decltype(forget)> at_end(this, forget);
  const bool done = work(*transaction);
  if (failed_within_) std::rethrow_exception(failed_within_);
  if (done) transaction->commit();
}

}  // namespace trailcast::store
