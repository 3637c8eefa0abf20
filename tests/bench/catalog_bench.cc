#include <benchmark/benchmark.h>
#include <sqlite3.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <random>

#include "services/catalog/catalog.h"
#include "services/store/route_store.h"
#include "tests/bench/million_routes.h"
#include "tests/support/temp_dir.h"

// The catalog's answers over a million stored routes, beside the same questions put to SQLite by
// hand (prepared once, every column read), and the store's opening. p99_ms: of all answers
// measured.

namespace trailcast {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t kPageSize = 100;

[[noreturn]] void Die(const std::string& why) {
  std::cerr << why << '\n';
  std::abort();
}

// The store, and a copy of its file that SQLite alone has open.
class Million {
 public:
  Million() {
    Open();
    if (auto put = bench::PutMillionRoutes(*store_); !put) Die(put.error().message);
    store_.reset();
    std::filesystem::copy_file(file_, copy_);
    Open();
    if (sqlite3_open(copy_.c_str(), &bare_) != SQLITE_OK) Die("no bare database");
  }
  ~Million() { sqlite3_close(bare_); }
  Million(const Million&) = delete;
  Million& operator=(const Million&) = delete;

  void Open() {
    store_.reset();
    auto opened = store::OpenSqliteStore(file_);
    if (!opened) Die(opened.error().message);
    store_ = std::move(*opened);
  }
  [[nodiscard]] store::RouteStore& store() { return *store_; }
  [[nodiscard]] sqlite3* bare() { return bare_; }

 private:
  test::TempDir dir_;
  std::filesystem::path file_ = dir_ / "routes.db";
  std::filesystem::path copy_ = dir_ / "bare.db";
  std::unique_ptr<store::RouteStore> store_;
  sqlite3* bare_ = nullptr;
};

Million& TheMillion() {
  static Million million;
  return million;
}

// Runs `ask(n)` for ever other n, and notes the slowest hundredth.
template <typename Ask>
void Measure(benchmark::State& state, const Ask& ask) {
  std::vector<double> times_ms;
  std::mt19937 random(7);
  for ([[maybe_unused]] auto _ : state) {
    const auto n = static_cast<std::uint32_t>(random() % bench::kMillion);
    const auto begin = Clock::now();
    const std::size_t found = ask(n);
    times_ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
    if (found == 0) Die("nothing found");
  }
  const auto at = times_ms.begin() + static_cast<std::ptrdiff_t>(times_ms.size() * 99 / 100);
  std::nth_element(times_ms.begin(), at, times_ms.end());
  state.counters["p99_ms"] = *at;
}

using MakeQuery = route::RouteQuery (*)(std::uint32_t n);

void Answered(benchmark::State& state, MakeQuery make) {
  Million& million = TheMillion();
  Measure(state, [&](std::uint32_t n) {
    route::RouteQuery query = make(n);
    query.page_size = kPageSize;
    const auto reply =
        catalog::Answer({AgentId("bench"), 1, query}, AgentId("server"), million.store());
    if (!reply.error.empty()) Die(reply.error);
    return reply.page.routes.size();
  });
}

using BindBare = void (*)(sqlite3_stmt* statement, std::uint32_t n);

void Bare(benchmark::State& state, const char* from, BindBare bind) {
  sqlite3_stmt* statement = nullptr;
  const std::string sql = fmt::format(
      "SELECT * FROM {} ORDER BY taught_unix_ms DESC, route DESC, revision DESC LIMIT "
      "{}",
      from, kPageSize);
  if (sqlite3_prepare_v2(TheMillion().bare(), sql.c_str(), -1, &statement, nullptr) != SQLITE_OK) {
    Die(sqlite3_errmsg(TheMillion().bare()));
  }
  Measure(state, [&](std::uint32_t n) {
    sqlite3_reset(statement);
    bind(statement, n);
    std::size_t rows = 0;
    while (sqlite3_step(statement) == SQLITE_ROW) {
      ++rows;
      for (int column = 0; column < sqlite3_column_count(statement); ++column) {
        benchmark::DoNotOptimize(sqlite3_column_blob(statement, column));
      }
    }
    return rows;
  });
  sqlite3_finalize(statement);
}

void BindText(sqlite3_stmt* statement, const std::string& text) {
  sqlite3_bind_text(statement, 1, text.c_str(), -1, SQLITE_TRANSIENT);
}

void Opening(benchmark::State& state) {
  Million& million = TheMillion();
  for ([[maybe_unused]] auto _ : state) million.Open();
}

route::Surroundings Near(std::uint32_t n) { return {*bench::RouteNumber(n).place, 20.0}; }

void Register() {
  const auto add = [](const char* name, auto&&... arguments) {
    benchmark::RegisterBenchmark(name, arguments...)->Unit(benchmark::kMillisecond);
  };
  add(
      "Answer/by_name", Answered,
      +[](std::uint32_t n) { return route::RouteQuery{.name = bench::RouteNumber(n).name}; });
  add(
      "Bare/by_name", Bare, "route WHERE name = ?", +[](sqlite3_stmt* statement, std::uint32_t n) {
        BindText(statement, bench::RouteNumber(n).name);
      });
  add(
      "Answer/by_tag", Answered,
      +[](std::uint32_t n) { return route::RouteQuery{.tags = {bench::RouteNumber(n).tags[1]}}; });
  add(
      "Bare/by_tag", Bare, "route_tag CROSS JOIN route USING (id) WHERE tag = ?",
      +[](sqlite3_stmt* statement, std::uint32_t n) {
        BindText(statement, bench::RouteNumber(n).tags[1]);
      });
  add(
      "Answer/by_place", Answered,
      +[](std::uint32_t n) { return route::RouteQuery{.near = Near(n)}; });
  add(
      "Bare/by_place", Bare,
      "route_place CROSS JOIN route USING (id) WHERE east_low <= ?1 + 20.0 AND east_high >= ?1 - "
      "20.0 "
      "AND north_low <= ?2 + 20.0 AND north_high >= ?2 - 20.0 AND frame = 1",
      +[](sqlite3_stmt* statement, std::uint32_t n) {
        const route::Place place = *bench::RouteNumber(n).place;
        sqlite3_bind_double(statement, 1, place.x);
        sqlite3_bind_double(statement, 2, place.y);
      });
  // A hundredth of all routes: more than are sorted for a page.
  add(
      "Answer/by_common_tag", Answered,
      +[](std::uint32_t n) { return route::RouteQuery{.tags = {bench::RouteNumber(n).tags[0]}}; });
  add(
      "Answer/newest", Answered, +[](std::uint32_t) { return route::RouteQuery{}; });
  add("Opening", Opening);
}

}  // namespace
}  // namespace trailcast

int main(int argc, char** argv) {
  trailcast::Register();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
