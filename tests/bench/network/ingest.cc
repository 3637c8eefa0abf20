#include <sqlite3.h>

#include <chrono>
#include <map>
#include <memory>
#include <thread>

#include "services/dds/dds_exchange.h"
#include "services/exchange/publish.h"
#include "services/exchange/route_sender.h"
#include "services/route/manifest.h"
#include "tests/bench/network/network_bench.h"
#include "tests/support/pieces.h"
#include "tests/unit/route/sample_segment.h"

namespace trailcast::bench {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
constexpr int kFeatures = 38;  // of a segment: some 4 kB
constexpr std::size_t kBytes = 4096;
constexpr std::chrono::seconds kSettle{2};     // endpoints find each other
constexpr std::chrono::seconds kPatience{10};  // for the last receipts

// One route's scout's end of the protocol, with its segments in memory.
class PlayedScout {
 public:
  PlayedScout(unsigned route, Clock::time_point first, const IngestOptions& options)
      : number_(route),
        next_at_(first),
        every_(std::chrono::duration_cast<Clock::duration>(
            std::chrono::duration<double>(1.0 / options.segments_per_s))),
        most_(options.segments_a_route),
        route_(Beginning(route)),
        sender_(route_.info().scout, route_.info(),
                [this](SegmentIndex index) -> Result<route::SegmentPiece> {
                  return pieces_.at(index.value());
                },
                {}, {}) {}
  PlayedScout(const PlayedScout&) = delete;
  PlayedScout& operator=(const PlayedScout&) = delete;

  void Hear(const exchange::Message& message) { sender_.Handle(message, Clock::now()); }
  void NoteReceipts(std::vector<double>& took_ms) {
    for (const SegmentIndex index : sender_.TakeNewlyReceipted()) {
      const std::chrono::duration<double, std::milli> took = Clock::now() - taught_at_[index];
      took_ms.push_back(took.count());
    }
  }
  std::vector<exchange::Message> Tick(Clock::time_point now, bool teaching) {
    while (teaching && !complete() && now >= next_at_) {
      taught_at_[SegmentIndex(taught())] = next_at_;
      pieces_.push_back(route_.Add(Next()));
      sender_.Add(pieces_.back(), route_.info());
      next_at_ += every_;
      if (taught() < most_) continue;
      route_.Complete();
      sender_.Update(route_.info());
    }
    return sender_.Tick(now);
  }
  [[nodiscard]] std::uint32_t taught() const { return static_cast<std::uint32_t>(pieces_.size()); }
  [[nodiscard]] std::size_t backlog() const { return sender_.Unreceipted().size(); }
  [[nodiscard]] Clock::time_point next_at() const { return next_at_; }
  [[nodiscard]] bool complete() const {
    return route_.info().state == route::RouteState::kComplete;
  }
  [[nodiscard]] bool done() const { return sender_.AllReceipted(); }

 private:
  // No two routes have a segment alike.
  [[nodiscard]] route::Segment Next() const {
    auto segment = route::SampleSegment(number_ * most_ + taught(), kFeatures);
    segment.index = SegmentIndex(taught());
    return segment;
  }
  static route::RouteInfo Beginning(unsigned number) {
    route::RouteInfo info;
    info.key = test::KeyNumber(number + 1);
    info.name = fmt::format("route-{}", number);
    info.scout = AgentId(fmt::format("scout-{}", number));
    return info;
  }

  unsigned number_;
  Clock::time_point next_at_;
  Clock::duration every_;
  std::uint32_t most_;
  route::RouteBuilder route_;
  std::vector<route::SegmentPiece> pieces_;
  std::map<SegmentIndex, Clock::time_point> taught_at_;  // when it was due, not when it was done
  exchange::RouteSender sender_;
};

struct Share {
  std::vector<double> took_ms;
  std::uint64_t taught = 0;
  std::size_t backlog_at_end = 0;  // when teaching ended
  std::size_t unreceipted = 0;     // some seconds later
  Result<void> result;
};

using PlayedScouts = std::map<route::RouteKey, std::unique_ptr<PlayedScout>>;

// Dismisses scouts whose routes are acknowledged to the end, and returns how many segments they
// taught.
std::uint64_t TakeDone(PlayedScouts& scouts) {
  std::uint64_t taught = 0;
  for (auto scout = scouts.begin(); scout != scouts.end();) {
    if (scout->second->done()) {
      taught += scout->second->taught();
      scout = scouts.erase(scout);
    } else {
      ++scout;
    }
  }
  return taught;
}

// The scouts of one participant, on one thread.
void Play(const IngestOptions& options, std::uint32_t part, Share& share) {
  dds::DdsOptions dds;
  dds.discovery_tag = options.tag;
  dds.network_interface = "lo";
  dds.self = AgentId(fmt::format("scouts-{}", part));
  auto opened = dds::OpenDdsExchange(dds, exchange::ScoutTopics());
  if (!opened) {
    share.result = tl::unexpected(opened.error());
    return;
  }
  const auto begin = Clock::now() + kSettle;
  PlayedScouts scouts;
  std::uint32_t next_route = part;
  const auto begin_route = [&](Clock::time_point first) {
    scouts.emplace(test::KeyNumber(next_route + 1),
                   std::make_unique<PlayedScout>(next_route, first, options));
    next_route += options.participants;
  };
  while (next_route < options.scouts) {
    begin_route(begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(
                            next_route / options.segments_per_s / options.scouts)));
  }
  const auto end = begin + std::chrono::duration_cast<Clock::duration>(
                               std::chrono::duration<double>(options.duration_s));
  const auto backlog = [&] {
    std::size_t count = 0;
    for (const auto& [key, scout] : scouts) count += scout->backlog();
    return count;
  };
  const auto hear = [&](const exchange::Message& message) {
    const route::RouteKey* key = nullptr;
    if (const auto* receipt = std::get_if<exchange::Receipt>(&message)) key = &receipt->key;
    if (const auto* request = std::get_if<exchange::SegmentRequest>(&message)) key = &request->key;
    if (key == nullptr) return;
    if (const auto scout = scouts.find(*key); scout != scouts.end()) scout->second->Hear(message);
  };
  bool ended = false;
  while (Clock::now() < end + kPatience && !(ended && backlog() == 0)) {
    for (const exchange::Message& message : (*opened)->Take(milliseconds(5))) hear(message);
    const auto now = Clock::now();
    if (!ended && now >= end) {
      ended = true;
      share.backlog_at_end = backlog();
    }
    std::vector<exchange::Message> due;
    std::vector<Clock::time_point> successors;
    for (auto& [key, scout] : scouts) {
      const bool was_complete = scout->complete();
      auto some = scout->Tick(now, !ended);
      std::move(some.begin(), some.end(), std::back_inserter(due));
      scout->NoteReceipts(share.took_ms);
      if (scout->complete() && !was_complete) successors.push_back(scout->next_at());
    }
    for (const Clock::time_point first : successors) begin_route(first);
    share.taught += TakeDone(scouts);
    // A piece that cannot be sent is asked for.
    (void)exchange::PublishAll(**opened, due);
  }
  share.unreceipted = backlog();
  for (const auto& [key, scout] : scouts) share.taught += scout->taught();
}

Result<void> Check(int code, sqlite3* db, const char* doing) {
  if (code == SQLITE_OK || code == SQLITE_DONE || code == SQLITE_ROW) return {};
  return Fail(ErrorCode::kInternal, "{}: {}", doing, sqlite3_errmsg(db));
}

}  // namespace

Result<void> MeasureIngest(const IngestOptions& options) {
  std::vector<Share> shares(options.participants);
  {
    std::vector<std::jthread> threads;
    for (std::uint32_t part = 0; part < options.participants; ++part) {
      threads.emplace_back([&, part] { Play(options, part, shares[part]); });
    }
  }
  Share all;
  for (Share& share : shares) {
    if (!share.result) return share.result;
    all.took_ms.insert(all.took_ms.end(), share.took_ms.begin(), share.took_ms.end());
    all.taught += share.taught;
    all.backlog_at_end += share.backlog_at_end;
    all.unreceipted += share.unreceipted;
  }
  fmt::print(
      "{:.0f} segments/s: taught {} receipt_p50_ms {:.0f} p99_ms {:.0f} max_ms {:.0f} backlog {} "
      "unreceipted {}\n",
      options.scouts * options.segments_per_s, all.taught, Percentile(all.took_ms, 0.5),
      Percentile(all.took_ms, 0.99), Percentile(all.took_ms, 1.0), all.backlog_at_end,
      all.unreceipted);
  return {};
}

Result<void> MeasureCommits(const std::filesystem::path& folder, int group) {
  constexpr std::chrono::seconds kDuration{5};
  sqlite3* opened = nullptr;
  const auto file = folder / "bare.db";
  std::filesystem::remove(file);
  const int code = sqlite3_open(file.c_str(), &opened);
  const std::unique_ptr<sqlite3, decltype(&sqlite3_close)> db(opened, &sqlite3_close);
  if (auto ok = Check(code, db.get(), "opening"); !ok) return ok;
  const auto run = [&](const char* sql) {
    return Check(sqlite3_exec(db.get(), sql, nullptr, nullptr, nullptr), db.get(), sql);
  };
  for (const char* sql :
       {"PRAGMA locking_mode = EXCLUSIVE", "PRAGMA journal_mode = WAL", "PRAGMA synchronous = FULL",
        "CREATE TABLE segment (route TEXT, number INTEGER, digest BLOB, bytes BLOB, PRIMARY KEY "
        "(route, number))"}) {
    if (auto ok = run(sql); !ok) return ok;
  }
  sqlite3_stmt* prepared = nullptr;
  sqlite3_prepare_v2(db.get(), "INSERT INTO segment VALUES (?, ?, ?, ?)", -1, &prepared, nullptr);
  const std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)> insert(prepared,
                                                                          &sqlite3_finalize);
  const auto piece = test::PieceOf(test::KeyNumber(1), 0, kBytes);
  const std::string& route = piece.key.route.value();
  int written = 0;
  const auto began = Clock::now();
  while (Clock::now() < began + kDuration) {
    if (auto ok = run("BEGIN"); !ok) return ok;
    for (int i = 0; i < group; ++i) {
      sqlite3_bind_text(insert.get(), 1, route.data(), static_cast<int>(route.size()),
                        SQLITE_STATIC);
      sqlite3_bind_int(insert.get(), 2, written++);
      sqlite3_bind_blob(insert.get(), 3, piece.digest.data(), static_cast<int>(piece.digest.size()),
                        SQLITE_STATIC);
      sqlite3_bind_blob(insert.get(), 4, piece.bytes.data(), static_cast<int>(piece.bytes.size()),
                        SQLITE_STATIC);
      if (auto ok = Check(sqlite3_step(insert.get()), db.get(), "inserting"); !ok) return ok;
      sqlite3_reset(insert.get());
    }
    if (auto ok = run("COMMIT"); !ok) return ok;
  }
  const std::chrono::duration<double> took = Clock::now() - began;
  fmt::print("groups of {}: {:.0f} segments/s, {:.0f} commits/s\n", group, written / took.count(),
             written / took.count() / group);
  return {};
}

}  // namespace trailcast::bench
