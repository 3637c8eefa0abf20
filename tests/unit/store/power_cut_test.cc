// These test what a loss of power, or a disk that fails for a moment, leaves of a store.
#include <gtest/gtest.h>

#include "services/store/route_store.h"
#include "tests/support/unlucky_disk.h"
#include "tests/unit/store/pieces.h"

namespace trailcast::store {
namespace {

using ToldToRoutes = test::Told<RouteStore>;

ToldToRoutes Appended(std::uint32_t index) {
  return {[index](RouteStore& store) { return store.AppendSegments(Pieces({index})); },
          [index](RouteStore& store) {
            const auto piece = store.ReadSegment(kYard, SegmentIndex(index));
            return piece && piece->bytes == Piece(index).bytes;
          }};
}

ToldToRoutes Receipted(std::uint32_t index) {
  return {[index](RouteStore& store) { return store.AppendFetched(Pieces({index})); },
          [index](RouteStore& store) {
            const auto held = store.HeldSegments(kYard);
            const auto unreceipted = store.UnreceiptedSegments(kYard);
            const auto has = [index](const Result<std::vector<SegmentIndex>>& all) {
              return all && std::count(all->begin(), all->end(), SegmentIndex(index)) == 1;
            };
            return has(held) && unreceipted && !has(unreceipted);
          }};
}

ToldToRoutes Known(const route::RouteInfo& info) {
  return {[info](RouteStore& store) { return store.PutRoute(info); },
          [info](RouteStore& store) {
            const auto found = store.FindRoute(info.key);
            return found && *found && (*found)->state >= info.state &&
                   (*found)->standing >= info.standing;
          }};
}

route::RouteInfo DeletedHall() {
  route::RouteInfo hall = Complete(1);
  hall.key.teaching = TeachingId(7);
  hall.standing = route::Standing::kDeleted;
  return hall;
}

const std::vector<ToldToRoutes>& WhatAServerIsTold() {
  static const std::vector<ToldToRoutes> kAll{Known(Teaching(1)), Appended(0),
                                              Appended(1),        Receipted(2),
                                              Known(Complete(3)), Known(DeletedHall())};
  return kAll;
}

TEST(PowerCut, NothingThatAServersStoreHasTakenIsLost) {
  test::ExpectThatNothingTakenIsLost<RouteStore>(
      [](const std::filesystem::path& file) { return OpenSqliteStore(file); }, WhatAServerIsTold());
}

// A follower's copies are on the disk with the route that counts them.
TEST(PowerCut, OfCopiesNothingIsLostThatARouteCounts) {
  const auto all = [] {
    std::vector<ToldToRoutes> told;
    for (const std::uint32_t count : {1U, 2U, 3U}) {
      const auto is_held = Receipted(count - 1).is_there;
      const auto is_known = Known(Teaching(count)).is_there;
      told.push_back({[count](RouteStore& store) {
                        return store.AppendFetched(Pieces({count - 1})).and_then([&] {
                          return store.PutRoute(Teaching(count));
                        });
                      },
                      [=](RouteStore& store) { return is_held(store) && is_known(store); }});
    }
    return told;
  }();
  test::ExpectThatNothingTakenIsLost<RouteStore>(
      [](const std::filesystem::path& file) {
        return OpenSqliteStore(file, {.durability = SqliteOptions::Durability::kWithRoutes});
      },
      all);
}

}  // namespace
}  // namespace trailcast::store
