#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "services/exchange/messages.h"
#include "tests/soak/member.h"
#include "tests/support/network_lab.h"

namespace trailcast::soak {

enum class Role { kServer, kScout, kFollower };

// These are the robots' tasks until the next ones.
struct Errand {
  std::string route;
  std::filesystem::path folder;  // their stores
  std::uint64_t seed = 1;        // for their errors and noise
};

// This is a server with a disk of its own, a scout and followers, each at a host of its own on one
// network.
class Fleet {
 public:
  // `disk` is the server's folder, on a file system to which nothing else writes.
  Fleet(test::NetworkLab& lab, const std::filesystem::path& folder, std::filesystem::path disk);

  void StartServer();
  // The scout teaches, and the followers wait for the route and follow while it is taught.
  void Begin(const Errand& errand);
  // Starts a program after a kill. The server has its store, a scout delivers what it had taught,
  // and a follower starts over.
  void Resume(Role role, Member& member);

  // Returns whether the scout was killed in the middle of this errand's teaching.
  [[nodiscard]] bool teaching_cut_off() const { return teaching_cut_off_; }

  [[nodiscard]] Member& server() { return server_; }
  [[nodiscard]] Member& scout() { return scout_; }
  [[nodiscard]] std::vector<std::unique_ptr<Member>>& followers() { return followers_; }
  // Returns the members of the role that run at present.
  [[nodiscard]] std::vector<Member*> Running(Role role);

  void Hear(const exchange::AgentStatus& status, Clock::time_point now);
  // Returns the members that run, and were not heard since then.
  [[nodiscard]] std::vector<std::string> SilentSince(Clock::time_point then);

  void Cut(const Member& member) { lab_.Cut(member.host()); }
  void Join(const Member& member) { lab_.Join(member.host()); }
  // Drops this share of the packets that each host receives.
  void Lose(double share);
  void FillDisk();
  void ClearDisk();

  [[nodiscard]] std::filesystem::path ServersStore() const { return disk_ / "server.db"; }
  [[nodiscard]] std::filesystem::path ScoutsStore() const { return errand_.folder / "scout.db"; }
  [[nodiscard]] std::filesystem::path StoreOf(const Member& follower) const {
    return errand_.folder / (follower.name() + ".db");
  }

 private:
  [[nodiscard]] std::vector<Member*> All();
  void Teach();
  void Follow(Member& follower);
  [[nodiscard]] Words Simulated(const std::string& camera, std::uint64_t number) const;

  test::NetworkLab& lab_;
  std::filesystem::path disk_;
  std::filesystem::path path_;  // the taught path, as a file
  Member server_;
  Member scout_;
  std::vector<std::unique_ptr<Member>> followers_;
  Errand errand_;
  bool teaching_cut_off_ = false;
};

}  // namespace trailcast::soak
