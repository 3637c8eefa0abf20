#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trailcast::http {

// What a program measures, in Prometheus's text format, version 0.0.4
// (https://prometheus.io/docs/instrumenting/exposition_formats/).
class MetricsText {
 public:
  static constexpr const char* kType = "text/plain; version=0.0.4; charset=utf-8";
  using Labels = std::vector<std::pair<std::string_view, std::string_view>>;

  // A metric, whose samples follow: "gauge", "counter". A name is put behind "trailcast_".
  void Begin(std::string_view name, std::string_view type, std::string_view help);
  // Of the metric begun last. The values of labels may be anything that is UTF-8.
  void Add(double value, const Labels& labels = {});
  // One without labels.
  template <typename Number>
  void Add(std::string_view name, std::string_view type, std::string_view help, Number value) {
    Begin(name, type, help);
    Add(static_cast<double>(value));
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string name_;
  std::string text_;
};

}  // namespace trailcast::http
