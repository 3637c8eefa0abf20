#pragma once

#include <chrono>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <pqxx/pqxx>
#include <string>
#include <type_traits>

#include "services/base/result.h"
#include "services/store/postgres_url.h"
#include "services/store/src/postgres/silence_watch.h"

namespace trailcast::store {

// One connection to a PostgreSQL database, which is made again when it is lost, and its
// transactions. It is not thread-safe.
class PostgresSession {
 public:
  enum class Access : std::uint8_t { kReadWrite, kReadOnly };
  enum class Kind : std::uint8_t {
    kRead,   // one statement by itself
    kWrite,  // a transaction: all or nothing, on PostgreSQL's disk when it returns
  };
  using Work = std::function<bool(pqxx::transaction_base&)>;

  // Connects, makes the store's tables if there are none, and checks that they are ours. Errors say
  // what to do: kInvalidArgument if waiting does not help (URL, password, database, right,
  // version), kUnavailable if there is no connection at present. `patience` bounds the wait for any
  // one answer; a live server itself ends a statement that takes too long, sooner than after the
  // usual patience.
  [[nodiscard]] static Result<std::unique_ptr<PostgresSession>> Open(
      const std::string& url, Access access, std::chrono::milliseconds patience);

  // Runs `work` with a transaction and returns its Result; the transaction is committed if that is
  // no error. `work` may run several times: again when a lost connection is back, or when another
  // process's transaction interfered. Within another Run's `work` it belongs to that one's
  // transaction. If PostgreSQL refuses, the Error says what was being done.
  template <typename Function>
  auto Run(Kind kind, const std::string& doing, const Function& work)
      -> std::invoke_result_t<Function, pqxx::transaction_base&> {
    using Outcome = std::invoke_result_t<Function, pqxx::transaction_base&>;
    std::optional<Outcome> outcome;
    const Result<void> ran = Attempt(kind, doing, [&](pqxx::transaction_base& transaction) {
      outcome.emplace(work(transaction));
      return outcome->has_value();
    });
    if (!ran) return tl::unexpected(ran.error());
    return std::move(*outcome);
  }

  [[nodiscard]] const std::string& name() const { return url_.shown; }  // for messages

 private:
  PostgresSession(PostgresUrl url, Access access, std::chrono::milliseconds patience)
      : url_(std::move(url)), access_(access), watch_(patience) {}

  [[nodiscard]] Result<void> Attempt(Kind kind, const std::string& doing, const Work& work);
  [[nodiscard]] Result<void> AttemptWithin(const std::string& doing, const Work& work);
  void RunOnce(Kind kind, const Work& work);
  [[nodiscard]] Result<void> Connect(bool create);
  [[nodiscard]] Result<void> Reconnect();

  struct Link {
    explicit Link(const std::string& url) : connection(url), silence(connection) {}
    pqxx::connection connection;
    pqxx::quiet_errorhandler silence;  // errors are thrown, and nobody needs notices
  };

  PostgresUrl url_;
  Access access_;
  SilenceWatch watch_;
  std::unique_ptr<Link> link_;  // null if it is lost
  std::chrono::steady_clock::time_point reconnect_at_{};
  Error lost_;  // why there is no connection
  pqxx::transaction_base* current_ = nullptr;
  std::exception_ptr failed_within_;  // why the current transaction broke
};

}  // namespace trailcast::store
