// Queries of strangers, cursors above all, to a catalog that has something to find.
#include <fuzzer/FuzzedDataProvider.h>

#include <memory>
#include <set>
#include <string>

#include "services/catalog/catalog.h"
#include "services/exchange/bounds.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/pieces.h"

namespace trailcast::fuzz {
namespace {

std::unique_ptr<store::RouteStore> SomeRoutes(const std::filesystem::path& file) {
  auto store = store::OpenSqliteStore(file).value();
  for (unsigned i = 0; i < 12; ++i) {
    route::RouteInfo info = test::InfoOf(test::KeyNumber(i), {}, route::RouteState::kTeaching);
    info.name = "route-" + std::to_string(i / 2);
    info.length_m = i / 3;  // several of one length
    info.taught_unix_ms += i / 4;
    if (i % 2 == 0) info.tags = {"indoor", "night"};
    if (i % 3 == 0) info.place = {route::Place::Frame::kSite, 1.0 * i, -1.0};
    if (i % 3 == 1) info.place = {route::Place::Frame::kWgs84, 11.5, 48.2};
    Require(store->PutRoute(info).has_value(), "the routes were stored");
  }
  return store;
}

route::RouteQuery AnyQuery(FuzzedDataProvider& input) {
  const auto maybe = [&](auto value, decltype(value) otherwise) {
    return input.ConsumeIntegral<std::uint8_t>() < 32 ? value : otherwise;
  };
  route::RouteQuery query;
  query.order = static_cast<route::RouteOrder>(input.ConsumeIntegralInRange<int>(0, 5));
  query.page_size = input.ConsumeIntegralInRange<std::uint32_t>(0, 4);
  query.name = maybe(input.ConsumeRandomLengthString(8), "");
  query.name_prefix = maybe(input.ConsumeRandomLengthString(8), "");
  query.scout = maybe(input.ConsumeRandomLengthString(8), "");
  query.camera_prefix = maybe(input.ConsumeRandomLengthString(8), "");
  if (input.ConsumeIntegral<std::uint8_t>() < 32) query.tags = {"indoor"};
  query.min_length_m = maybe(input.ConsumeFloatingPoint<double>(), 0.0);
  query.max_length_m = maybe(input.ConsumeFloatingPoint<double>(), 0.0);
  query.taught_from_unix_ms = maybe(input.ConsumeIntegral<std::int64_t>(), 0);
  query.taught_until_unix_ms = maybe(input.ConsumeIntegral<std::int64_t>(), 0);
  if (input.ConsumeIntegral<std::uint8_t>() < 32) {
    const auto frame = static_cast<route::Place::Frame>(input.ConsumeIntegralInRange<int>(0, 3));
    query.near = {{frame, input.ConsumeFloatingPointInRange(-200.0, 200.0),
                   input.ConsumeFloatingPointInRange(-100.0, 100.0)},
                  input.ConsumeFloatingPointInRange(-1.0, 1e7)};
  }
  query.cursor = input.ConsumeRemainingBytesAsString();
  return query;
}

exchange::CatalogReply Ask(const route::RouteQuery& query, store::RouteStore& store) {
  const exchange::CatalogRequest request{.client = AgentId("client"), .query = query};
  exchange::CatalogReply reply = catalog::Answer(request, AgentId("server"), store);
  Require(exchange::CheckBounds(reply).has_value(), "the reply can be sent");
  return reply;
}

// From wherever the cursor leads to: no route twice, and an end.
void ReadAllPages(route::RouteQuery query, store::RouteStore& store) {
  std::set<route::RouteKey> seen;
  while (true) {
    const exchange::CatalogReply reply = Ask(query, store);
    for (const route::RouteInfo& info : reply.page.routes) {
      Require(seen.insert(info.key).second, "no route is on two pages");
    }
    if (reply.page.next.empty()) return;
    query.cursor = reply.page.next;
  }
}

}  // namespace
}  // namespace trailcast::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trailcast::fuzz;
  static const auto store = SomeRoutes(AsFile({}, "routes.db"));
  FuzzedDataProvider input(data, size);
  ReadAllPages(AnyQuery(input), *store);
  return 0;
}
