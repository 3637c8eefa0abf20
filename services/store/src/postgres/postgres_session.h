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

// One connection to a PostgreSQL database, made anew when it is lost, and the transactions on it.
// Not thread-safe.
class PostgresSession {
 public:
  enum class Access : std::uint8_t { kReadWrite, kReadOnly };
  enum class Kind : std::uint8_t {
    kRead,   // one statement by itself
    kWrite,  // a transaction: all or nothing, on PostgreSQL's disk when it returns
  };
  using Work = std::function<bool(pqxx::transaction_base&)>;

  // Connects, makes the store's tables where there are none, and checks that they are ours.
  // kInvalidArgument for what waiting does not mend (URL, password, database, right, version),
  // kUnavailable when there is no connection at present. Messages say what to do.
  // `patience` bounds the wait for any one answer; a server that is alive says itself that a
  // statement takes too long, sooner than after the usual one.
  [[nodiscard]] static Result<std::unique_ptr<PostgresSession>> Open(
      const std::string& url, Access access, std::chrono::milliseconds patience);

  // What `work` returns, a Result, given a transaction, which is committed if that is no error. It
  // may be run several times: again when the connection was lost and is there again, or when
  // another process' transaction was in the way. Within another Run's `work` it is part of that
  // one's transaction. What PostgreSQL refuses comes back as an Error that says what was being
  // done.
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
    pqxx::quiet_errorhandler silence;  // errors are thrown; notices are for nobody
  };

  PostgresUrl url_;
  Access access_;
  SilenceWatch watch_;
  std::unique_ptr<Link> link_;  // none: lost
  std::chrono::steady_clock::time_point reconnect_at_{};
  Error lost_;  // why there is no connection
  pqxx::transaction_base* current_ = nullptr;
  std::exception_ptr failed_within_;  // what broke the current transaction
};

}  // namespace trailcast::store
