// This fuzzes what operators send robots to do, and what a robot keeps of it in a file.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "agent/link/mission_handler.h"
#include "services/exchange/bounds.h"
#include "services/mission/orders.h"
#include "tests/fuzz/fuzz.h"

namespace {

namespace fs = std::filesystem;
using trailcast::fuzz::Require;

std::string TextOf(const std::string& orders, const std::vector<trailcast::mission::Task>& tasks) {
  const auto going = trailcast::mission::GoingIn(orders);
  return going ? ToText(*going, tasks) : trailcast::mission::ToText(tasks);
}

void ReadOrders(const std::string& orders) {
  const auto tasks = trailcast::mission::ParseOrders(orders);
  if (!tasks) return;
  Require(!tasks->empty(), "there is something to do");
  const std::string text = TextOf(orders, *tasks);
  const auto again = trailcast::mission::ParseOrders(text);
  Require(again && TextOf(text, *again) == text, "orders are what their text says");
}

void ReadKept(const std::string& text) {
  const fs::path file =
      fs::temp_directory_path() / ("trailcast-fuzz-missions-" + std::to_string(getpid()));
  std::ofstream(file, std::ios::binary) << text;
  trailcast::agent::MissionHandler handler(trailcast::AgentId("robot1"), file);
  if (handler.Load()) {
    if (const auto& current = handler.current()) {
      Require(current->task < current->tasks.size(), "there is something to be done");
      handler.Tell(trailcast::mission::State::kArrived);
    }
    for (const auto& message : handler.Due({}, true)) {
      Require(trailcast::exchange::CheckBounds(message).has_value(), "what it says is in bounds");
    }
  }
  fs::remove(file);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  ReadOrders(text);
  ReadKept(text);
  ReadKept("trailcast-missions 2\n" + text);
  return 0;
}
