#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "services/exchange/messages.h"
#include "tests/soak/member.h"
#include "tests/support/network_lab.h"

namespace trailcast::soak {

// These are three more robots in each cycle, which fetch the route while it is taught. During that,
// one is killed, one stopped and one cut off, until the cycle's end. They are not repaired, and no
// other member may be affected: the cycle has to end as ever.
class Casualties {
 public:
  Casualties(test::NetworkLab& lab, const std::filesystem::path& folder);

  // Takes the cycle's route, and where the robots' stores are.
  void Begin(std::string route, std::filesystem::path stores);
  void Handle(const exchange::Message& message);
  // Removes what is left of them. It is a failure if one of them was not struck.
  void End();

  [[nodiscard]] int struck() const { return struck_; }
  [[nodiscard]] std::vector<std::string> TakeFailures() { return std::exchange(failures_, {}); }

 private:
  enum class Fate { kKilled, kStopped, kCutOff };
  struct Casualty {
    Fate fate;
    std::unique_ptr<Member> member;
    bool struck = false;
  };

  void Start();
  void Strike(Casualty& casualty);

  test::NetworkLab& lab_;
  std::vector<Casualty> casualties_;
  std::string route_;
  std::filesystem::path stores_;
  bool started_ = false;
  int struck_ = 0;
  std::vector<std::string> failures_;
};

}  // namespace trailcast::soak
