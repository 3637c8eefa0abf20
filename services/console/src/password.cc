#include "services/console/password.h"

#include <termios.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>

namespace trailcast::console {
namespace {

// This is a terminal that does not show what is typed.
class Unseen {
 public:
  Unseen() : is_terminal_(tcgetattr(STDIN_FILENO, &shown_) == 0) {
    if (!is_terminal_) return;
    termios unseen = shown_;
    unseen.c_lflag &= ~static_cast<tcflag_t>(ECHO);
    (void)tcsetattr(STDIN_FILENO, TCSAFLUSH, &unseen);
  }
  ~Unseen() {
    if (!is_terminal_) return;
    (void)tcsetattr(STDIN_FILENO, TCSAFLUSH, &shown_);
    std::fputs("\n", stderr);
  }
  Unseen(const Unseen&) = delete;
  Unseen& operator=(const Unseen&) = delete;
  [[nodiscard]] bool is_terminal() const { return is_terminal_; }

 private:
  termios shown_{};
  bool is_terminal_;
};

}  // namespace

Result<std::string> ReadPassword(const std::string& prompt) {
  const Unseen unseen;
  if (unseen.is_terminal()) std::fputs(prompt.c_str(), stderr);
  std::string line;
  if (!std::getline(std::cin, line)) {
    return Fail(ErrorCode::kInvalidArgument, "a password is to come on standard input, as a line");
  }
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return line;
}

}  // namespace trailcast::console
