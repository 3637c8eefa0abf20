#pragma once

#include <string>
#include <utility>
#include <vector>

#include "agent/diagnosis/run_log.h"
#include "agent/diagnosis/run_mcap.h"
#include "services/base/time.h"

namespace trailcast::test {

// This makes a replay's log in a small language: a robot goes straight on at 0.4 m/s, with ten
// frames a second, and things happen to it.
class SampleRun {
 public:
  SampleRun() {
    agent::Fields& header = log_.header;
    header.Add("route", "hall");
    header.Add("segments", "5");
    header.Add("length_m", "10.00");
    header.Add("scout", "scout");
    header.Add("scout_camera", "webcam 320x240");
    header.Add("robot", "robot2");
    header.Add("camera", "wide 320x240");
    header.Add("method", "default");
    moments_.push_back({.header = header});
    row_.stored = 30;
    row_.tracked = row_.agreeing = 25;
    row_.linear_mps = 0.4;
    row_.left_m = 0.02;
    row_.left_sigma_m = 0.01;
    row_.cpu_ms = 1.0;
    row_.driven_m = row_.x_m = row_.y_m = 0.0;
    row_.phase = agent::Phase::kSure;
  }

  agent::FrameRow& row() { return row_; }  // the next frames will be like this

  SampleRun& HandOver(int segment, int found, const std::string& search = "near",
                      double length_m = 2.0) {
    row_.segment = segment;
    row_.fraction = 0.0;
    Frame();
    agent::RunEvent event{row_.frame - 1, row_.t_s, "hand-over", {}, ""};
    event.fields.Add("segment", std::to_string(segment));
    event.fields.Add("found", std::to_string(found));
    event.fields.Add("stored", std::to_string(row_.stored));
    event.fields.Add("search", search);
    event.fields.Add("length_m", std::to_string(length_m));
    event.fields.Add("speed_mps", "0.4");
    return Add(std::move(event));
  }
  SampleRun& Frame() {
    log_.frames.push_back(row_);
    moments_.push_back({.stamp = FromSeconds(row_.t_s), .row = row_});
    ++row_.frame;
    row_.t_s += 0.1;
    if (row_.driven_m) row_.driven_m = *row_.driven_m + 0.1 * row_.linear_mps;
    if (row_.x_m) row_.x_m = row_.driven_m;
    row_.progress += 0.004;
    row_.left_picture = row_.not_returned = 0;
    return *this;
  }
  SampleRun& Frames(int count) {
    for (int i = 0; i < count; ++i) Frame();
    return *this;
  }
  SampleRun& Phase(agent::Phase phase, const std::string& reason) {
    row_.phase = phase;
    agent::RunEvent event{row_.frame, row_.t_s, "phase", {}, reason};
    event.fields.Add("to", ToString(phase));
    return Add(std::move(event));
  }
  SampleRun& CarriedOff(double left_m) {
    agent::RunEvent event{row_.frame - 1, row_.t_s, "carried", {}, ""};
    event.fields.Add("left_m", std::to_string(left_m));
    return Add(std::move(event));
  }
  SampleRun& End(const std::string& state, const std::string& reason) {
    log_.ending = {row_.frame, row_.t_s, "end", {}, reason};
    log_.ending->fields.Add("state", state);
    moments_.push_back({.events = {*log_.ending}});
    return *this;
  }

  [[nodiscard]] const agent::RunLog& Log() const { return log_; }
  // Returns the log as an agent writes it. Unless `whole`, it has what an agent has written by now.
  [[nodiscard]] std::string Mcap(bool whole = true) const {
    agent::RunMcap mcap(0.0);
    for (const agent::RunMoment& moment : moments_) mcap.Add(moment);
    if (whole) mcap.End();
    const bag::Bytes bytes = mcap.TakeBytes();
    return {bytes.begin(), bytes.end()};
  }

 private:
  SampleRun& Add(agent::RunEvent event) {
    moments_.push_back({.events = {event}});
    log_.events.push_back(std::move(event));
    return *this;
  }

  agent::FrameRow row_;
  agent::RunLog log_;
  std::vector<agent::RunMoment> moments_;
};

}  // namespace trailcast::test
