#include "tests/soak/fleet.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "services/store/route_store.h"

namespace trailcast::soak {
namespace {

constexpr const char* kWorld = "indoor";
// Four metres straight on: some five segments.
constexpr const char* kPath = "x_m,y_m\n1.0,1.5\n5.0,1.5\n";
constexpr std::array kFollowerCameras{"webcam", "wide"};
// Longer than any fault lasts, and what comes after it.
constexpr const char* kPatience_s = "120";

}  // namespace

Fleet::Fleet(test::NetworkLab& lab, const std::filesystem::path& folder, std::filesystem::path disk)
    : lab_(lab),
      disk_(std::move(disk)),
      path_(folder / "path.csv"),
      server_(lab, 1, "server", folder),
      scout_(lab, 2, "scout", folder) {
  std::ofstream(path_) << kPath;
  for (std::size_t i = 0; i < kFollowerCameras.size(); ++i) {
    followers_.push_back(std::make_unique<Member>(lab, static_cast<int>(3 + i),
                                                  fmt::format("follower-{}", i + 1), folder));
  }
}

void Fleet::StartServer() {
  server_.Start("trailcast-server", {"--store", ServersStore().string(), "--keep-days", "30"});
}

void Fleet::Begin(const Errand& errand) {
  errand_ = errand;
  teaching_cut_off_ = false;
  std::filesystem::create_directories(errand_.folder);
  Teach();
  for (const auto& follower : followers_) Follow(*follower);
}

void Fleet::Resume(Role role, Member& member) {
  if (role == Role::kServer) return StartServer();
  if (role == Role::kFollower) return Follow(member);
  std::vector<route::RouteInfo> taught;
  if (const auto store = store::OpenSqliteStore(ScoutsStore())) {
    taught = (*store)->ListRoutes().value_or(taught);
  }
  if (taught.empty()) return Teach();
  teaching_cut_off_ =
      taught.front().cut_off || taught.front().state == route::RouteState::kTeaching;
  scout_.Start("trailcast-agent",
               {"--store", ScoutsStore().string(), "deliver", "--delivery-timeout", kPatience_s});
}

Words Fleet::Simulated(const std::string& camera, std::uint64_t number) const {
  return {"--sim",    kWorld,       "--path", path_.string(),
          "--camera", camera,       "--seed", std::to_string(100 * errand_.seed + number),
          "--route",  errand_.route};
}

void Fleet::Teach() {
  Words words{"--store", ScoutsStore().string(), "--server", "teach", "--speed",
              "0.6",     "--delivery-timeout",   kPatience_s};
  const Words robot = Simulated("webcam", 0);
  words.insert(words.end(), robot.begin(), robot.end());
  scout_.Start("trailcast-agent", words);
}

void Fleet::Follow(Member& follower) {
  const auto number = static_cast<std::size_t>(follower.host() - followers_.front()->host());
  Words words{"--store",  StoreOf(follower).string(), "--server",
              "replay",   "--wait-for-route",         "--wait",
              kPatience_s};
  const Words robot = Simulated(kFollowerCameras.at(number), number + 1);
  words.insert(words.end(), robot.begin(), robot.end());
  follower.Start("trailcast-agent", words);
}

std::vector<Member*> Fleet::All() {
  std::vector<Member*> all{&server_, &scout_};
  for (const auto& follower : followers_) all.push_back(follower.get());
  return all;
}

std::vector<Member*> Fleet::Running(Role role) {
  std::vector<Member*> running;
  if (role == Role::kServer) running = {&server_};
  if (role == Role::kScout) running = {&scout_};
  if (role == Role::kFollower) {
    for (const auto& follower : followers_) running.push_back(follower.get());
  }
  std::erase_if(running, [](Member* member) { return !member->running(); });
  return running;
}

void Fleet::Hear(const exchange::AgentStatus& status, Clock::time_point now) {
  for (Member* member : All()) {
    if (member->name() == status.agent.value()) member->NoteHeard(now);
  }
}

std::vector<std::string> Fleet::SilentSince(Clock::time_point then) {
  std::vector<std::string> silent;
  for (Member* member : All()) {
    if (member->running() && member->heard_at() <= then) silent.push_back(member->name());
  }
  return silent;
}

void Fleet::Lose(double share) {
  for (const Member* member : All()) lab_.Lose(member->host(), share);
}

void Fleet::FillDisk() {
  constexpr std::size_t kPiece = 64U << 10U;
  const std::vector<char> piece(kPiece, 'x');
  const int file = open((disk_ / "ballast").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) throw std::runtime_error("cannot write to the server's disk");
  while (write(file, piece.data(), piece.size()) > 0) {
  }
  close(file);
}

void Fleet::ClearDisk() { std::filesystem::remove(disk_ / "ballast"); }

}  // namespace trailcast::soak
