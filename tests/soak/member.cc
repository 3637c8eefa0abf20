#include "tests/soak/member.h"
#include "tests/support/places.h"

#include <fmt/format.h>

#include <csignal>
#include <fstream>
#include <utility>

namespace trailcast::soak {

Member::Member(test::NetworkLab& lab, int host, std::string name, std::filesystem::path folder)
    : lab_(lab), host_(host), address_(host), name_(std::move(name)), folder_(std::move(folder)) {
  lab_.AddHost(host_);
  SetClockAhead(std::chrono::seconds(0));
}

void Member::LoseAddress() { lab_.TakeAddress(host_, address_); }

void Member::TakeOtherAddress() {
  constexpr int kOther = 100;
  address_ = address_ == host_ ? host_ + kOther : host_;
  lab_.GiveAddress(host_, address_);
}

void Member::SetClockAhead(std::chrono::seconds by) const {
  // libfaketime looks at the file each second, and a file that is half written would stop it.
  const std::filesystem::path file = ClockFile();
  const std::filesystem::path next = file.string() + ".new";
  std::ofstream(next) << fmt::format("{:+}s\n", by.count());
  std::filesystem::rename(next, file);
}

std::filesystem::path Member::ClockFile() const { return folder_ / (name_ + ".clock"); }

void Member::Start(const std::string& program, const Words& words) {
  Words all{"/usr/bin/env",
            fmt::format("LD_PRELOAD={}", kClockLibrary),
            "FAKETIME_TIMESTAMP_FILE=" + ClockFile().string(),
            "FAKETIME_CACHE_DURATION=1",
            "FAKETIME_DONT_FAKE_MONOTONIC=1",
            "NO_FAKE_STAT=1",
            ProgramsDir() + "/" + program,
            "--network-interface",
            "eth0",
            "--name",
            name_};
  all.insert(all.end(), words.begin(), words.end());
  // The log before the last is of no use any more.
  std::filesystem::remove(folder_ / fmt::format("{}-{}.log", name_, starts_ - 2));
  process_ = std::make_unique<test::Process>(lab_.At(host_, all),
                                             folder_ / fmt::format("{}-{}.log", name_, starts_));
  ++starts_;
}

void Member::Kill() {
  process_->Signal(SIGKILL);
  [[maybe_unused]] const auto status = process_->Wait();
  process_.reset();
}

bool Member::running() { return process_ && !process_->Ended(); }

std::optional<int> Member::TakeEnded() {
  if (!process_ || !process_->Ended()) return std::nullopt;
  const auto status = process_->Wait();
  process_.reset();
  return status;
}

std::optional<int> Member::Stop() {
  process_->Signal(SIGTERM);
  const auto status = process_->Wait();
  process_.reset();
  return status;
}

std::string Member::LastWords() const {
  constexpr std::size_t kMost = 1500;
  std::ifstream log(folder_ / fmt::format("{}-{}.log", name_, starts_ - 1));
  const std::string text{std::istreambuf_iterator<char>(log), {}};
  return text.size() > kMost ? "..." + text.substr(text.size() - kMost) : text;
}

}  // namespace trailcast::soak
