#include "services/plot/network_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/plot/plot_style.h"
#include "tests/support/count_near.h"

namespace trailcast::plot {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;

int CountNear(const NetworkPicture& network, image::Color color) {
  return test::CountNear(DrawNetwork(network).Render(), color);
}

// office leaves hall at 12 m, and comes back to it; the ring is by itself.
NetworkPicture Three() {
  NetworkPicture network;
  network.routes = {{"hall", 20.0, {}}, {"office", 10.0, {}}, {"ring", 8.0, {}}};
  network.junctions = {{{0, 12.0}, {1, 2.0}, false, true},
                       {{1, 10.0}, {0, 19.0}, false, true},
                       {{2, 8.0}, {2, 0.0}, false, true}};
  return network;
}

TEST(DrawNetwork, RowsAreMovedSoThatTheFirstJunctionStandsUpright) {
  NetworkPicture network = Three();
  EXPECT_THAT(RowStarts(network), ElementsAre(DoubleEq(0.0), DoubleEq(10.0), DoubleEq(0.0)));
  network.junctions = {{{1, 9.0}, {0, 1.0}, true, true}};
  EXPECT_THAT(RowStarts(network), ElementsAre(DoubleEq(8.0), DoubleEq(0.0), DoubleEq(8.0)));
}

TEST(DrawNetwork, EachPartIsThereInItsColour) {
  NetworkPicture network = Three();
  const int route = CountNear(network, kBlue);
  EXPECT_GT(route, 3 * 38 * 40) << "three pixels high at least, 38 m of some 48 pixels";
  EXPECT_LT(CountNear(network, kOrange), 20);
  network.routes[0].marked = {{NetworkPicture::Part::kClosed, 3.0, 7.0},
                              {NetworkPicture::Part::kLimited, 10.0, 1e7}};
  EXPECT_GT(CountNear(network, kOrange), 10 * 4 * 30);
  EXPECT_GT(CountNear(network, kGreen), 6 * 10 * 30) << "up to its end";
  EXPECT_LT(CountNear(network, kBlue), route - 4 * 14 * 30);
  network.routes[0].marked = {{NetworkPicture::Part::kLost, 3.0, 7.0}};
  EXPECT_GT(CountNear(network, kOrange), 20 * 10) << "tick by tick";
  EXPECT_LT(CountNear(network, kOrange), 10 * 4 * 30);
  network.routes[0].marked = {{NetworkPicture::Part::kBacked, 3.0, 7.0}};
  EXPECT_GT(CountNear(network, kBlue), route + 4 * 30) << "an arrow below it";
  network.routes[0].marked.clear();
  const int ink = CountNear(network, kInk);
  network.names = {{"loading-bay", {1, 8.0}}};
  EXPECT_GT(CountNear(network, kInk), ink + 50);
}

TEST(DrawNetwork, ARouteOfNoLengthOrWithoutJunctionsIsDrawnAllTheSame) {
  NetworkPicture network;
  network.routes = {{"point", 0.0, {}}};
  EXPECT_GT(CountNear(network, kBlue), 20);
}

}  // namespace
}  // namespace trailcast::plot
