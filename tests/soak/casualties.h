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

// Three more robots in each cycle, which fetch the route while it is taught, and of which, once
// they are at it, one is killed, one stopped and one cut off, and left so until the cycle's end.
// Nobody mends them, and nobody else may notice: the cycle has to end as ever.
class Casualties {
 public:
  Casualties(test::NetworkLab& lab, const std::filesystem::path& folder);

  // The cycle's route, and where the robots' stores are.
  void Begin(std::string route, std::filesystem::path stores);
  void Handle(const exchange::Message& message);
  // Takes away what is left of them. What did not come to be struck is a failure.
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
