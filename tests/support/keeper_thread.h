#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "services/catalog/catalog.h"
#include "services/exchange/in_process_exchange.h"
#include "services/exchange/publish.h"
#include "services/exchange/route_keeper.h"
#include "services/route/digest.h"
#include "services/store/route_store.h"

namespace trailcast::test {

// This is the loop of a route server 'barn' on a thread of its own, until that is stopped. Bus and
// store outlive it.
inline std::jthread KeepRoutes(exchange::InProcessBus& bus, store::RouteStore& store) {
  return std::jthread([&](const std::stop_token& stop) {
    using std::chrono::steady_clock;
    const AgentId self("barn");
    const auto exchange = bus.Open(exchange::ServerTopics());
    const exchange::Integrity integrity{route::CheckDigest, route::ManifestDigest};
    const auto answer = [&](const exchange::CatalogRequest& request) {
      return catalog::Answer(request, self, store);
    };
    auto keeper = exchange::RouteKeeper::Open(self, store, {.answer = answer}, integrity);
    ASSERT_TRUE(keeper) << keeper.error().message;
    while (!stop.stop_requested()) {
      for (const exchange::Message& message : exchange->Take(std::chrono::milliseconds(5))) {
        (*keeper)->Handle(message, steady_clock::now());
      }
      // A message that is lost is asked for again.
      (void)exchange::PublishAll(*exchange, (*keeper)->Tick(steady_clock::now()));
    }
  });
}

}  // namespace trailcast::test
