#include "tests/support/described.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "services/console/src/api/files.h"

namespace trailcast::console {
namespace {

using nlohmann::json;

// One line's value, and what is within its braces.
class FlowReader {
 public:
  explicit FlowReader(const std::string& text) : text_(text) {}

  json Read() {
    Skip();
    if (At() == '{') return ReadMap();
    if (At() == '[') return ReadList();
    if (At() == '\'' || At() == '"') return ReadQuoted();
    const std::size_t from = at_;
    const char* const ends = depth_ > 0 ? ",}]" : "";
    while (at_ < text_.size() && std::string_view(ends).find(At()) == std::string_view::npos) {
      if (depth_ > 0 && EndsKey()) break;
      ++at_;
    }
    return Plain(text_.substr(from, at_ - from));
  }

 private:
  [[nodiscard]] char At() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  [[nodiscard]] bool EndsKey() const {
    return At() == ':' && (at_ + 1 == text_.size() || text_[at_ + 1] == ' ');
  }
  void Skip() {
    while (At() == ' ') ++at_;
  }
  json ReadMap() {
    json map = json::object();
    ++depth_;
    for (++at_; Skip(), At() != '}' && At() != '\0';) {
      const json key = Read();
      const std::string name = key.is_string() ? key.get<std::string>() : key.dump();
      Skip();
      json value;
      if (At() == ':') {
        ++at_;
        value = Read();
      }
      map[name] = std::move(value);
      Skip();
      if (At() == ',') ++at_;
    }
    ++at_;
    --depth_;
    return map;
  }
  json ReadList() {
    json list = json::array();
    ++depth_;
    for (++at_; Skip(), At() != ']' && At() != '\0';) {
      list.push_back(Read());
      Skip();
      if (At() == ',') ++at_;
    }
    ++at_;
    --depth_;
    return list;
  }
  json ReadQuoted() {
    const char quote = text_[at_++];
    std::string text;
    for (; at_ < text_.size(); ++at_) {
      if (At() == quote) {
        if (quote != '\'' || at_ + 1 >= text_.size() || text_[at_ + 1] != '\'') break;
        ++at_;
      }
      text += At();
    }
    ++at_;
    return text;
  }
  static json Plain(std::string text) {
    while (!text.empty() && text.back() == ' ') text.pop_back();
    static const std::regex kNumber(R"(-?\d+(\.\d+)?)");
    if (text == "true" || text == "false" || std::regex_match(text, kNumber)) {
      return json::parse(text);
    }
    return text;
  }

  const std::string& text_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

struct Line {
  std::size_t indent = 0;
  std::string text{};
};

class BlockReader {
 public:
  explicit BlockReader(const std::string& yaml) {
    std::istringstream stream(yaml);
    for (std::string line; std::getline(stream, line);) {
      const std::size_t indent = line.find_first_not_of(' ');
      if (indent != std::string::npos) lines_.push_back({indent, line.substr(indent)});
    }
  }

  json Read() { return lines_[at_].text.starts_with("- ") ? ReadList() : ReadMap(); }

 private:
  [[nodiscard]] bool Goes(std::size_t indent) const {
    return at_ < lines_.size() && lines_[at_].indent == indent;
  }
  // Where a key ends: at a colon that is not in quotes, and that a value or nothing follows.
  static std::size_t KeyEnd(const std::string& text) {
    if (text.front() == '\'') return text.find('\'', 1) + 1;
    std::size_t end = text.find(':');
    while (end != std::string::npos && end + 1 < text.size() && text[end + 1] != ' ') {
      end = text.find(':', end + 1);
    }
    return end;
  }
  json ReadMap() {
    json map = json::object();
    const std::size_t indent = lines_[at_].indent;
    while (Goes(indent) && !lines_[at_].text.starts_with("- ")) {
      const std::string text = lines_[at_].text;
      const std::size_t end = KeyEnd(text);
      if (end == std::string::npos) throw std::runtime_error("no key: " + text);
      const json key = FlowReader(text.substr(0, end)).Read();
      const std::string value = end + 2 < text.size() ? text.substr(end + 2) : "";
      ++at_;
      map[key.get<std::string>()] = ReadValue(value, indent);
    }
    return map;
  }
  json ReadValue(const std::string& value, std::size_t indent) {
    if (value == ">") return ReadText(indent);
    if (!value.empty()) return FlowReader(value).Read();
    const bool is_nested = at_ < lines_.size() && lines_[at_].indent > indent;
    return is_nested ? Read() : json();
  }
  json ReadText(std::size_t indent) {
    std::string text;
    for (; at_ < lines_.size() && lines_[at_].indent > indent; ++at_)
      text += lines_[at_].text + " ";
    return text;
  }
  json ReadList() {
    json list = json::array();
    const std::size_t indent = lines_[at_].indent;
    while (Goes(indent) && lines_[at_].text.starts_with("- ")) {
      const std::string item = lines_[at_].text.substr(2);
      const bool is_map = item.front() != '{' && KeyEnd(item) != std::string::npos;
      if (!is_map) {
        list.push_back(FlowReader(item).Read());
        ++at_;
        continue;
      }
      lines_[at_] = {indent + 2, item};
      list.push_back(ReadMap());
    }
    return list;
  }

  std::vector<Line> lines_;
  std::size_t at_ = 0;
};

class Checker {
 public:
  explicit Checker(const json& description) : description_(description) {}

  std::vector<std::string> TakeWrong() { return std::move(wrong_); }

  // Returns what "#/components/.." stands for.
  const json& Resolve(const json& value) const {
    if (!value.is_object() || !value.contains("$ref")) return value;
    return Resolve(description_.at(json::json_pointer(value["$ref"].get<std::string>().substr(1))));
  }

  void Check(const json& value, const json& described, const std::string& where) {
    const json& schema = Resolve(described);
    if (value.is_null()) {
      if (!schema.value("nullable", false)) wrong_.push_back(where + " is null");
      return;
    }
    if (schema.contains("enum") && !Has(schema["enum"], value)) {
      wrong_.push_back(where + " is none of these: " + value.dump());
    }
    const std::string type = schema.value("type", "");
    if (!type.empty() && !IsOf(type, value)) {
      wrong_.push_back(where + " is no " + type + ": " + value.dump().substr(0, 60));
    }
    if (value.is_array() && schema.contains("items")) {
      for (const json& each : value) Check(each, schema["items"], where + "[]");
    }
    if (value.is_object()) CheckFields(value, schema, where);
  }

 private:
  static bool Has(const json& list, const json& value) {
    return std::find(list.begin(), list.end(), value) != list.end();
  }
  static bool IsOf(const std::string& type, const json& value) {
    return (type == "object" && value.is_object()) || (type == "array" && value.is_array()) ||
           (type == "string" && value.is_string()) || (type == "boolean" && value.is_boolean()) ||
           (type == "integer" && value.is_number_integer()) ||
           (type == "number" && value.is_number());
  }
  // Gathers the fields of all that it is composed of. `any` means that it may have others.
  void Gather(const json& described, json& fields, json& required, bool& any, json& others) const {
    const json& schema = Resolve(described);
    for (const json& part : schema.value("allOf", json::array())) {
      Gather(part, fields, required, any, others);
    }
    if (schema.contains("properties")) fields.update(schema["properties"]);
    for (const json& name : schema.value("required", json::array())) required.push_back(name);
    if (!schema.contains("additionalProperties")) return;
    const json& more = schema["additionalProperties"];
    if (more.is_object()) others = more;
    any = any || more == true;
  }
  void CheckFields(const json& value, const json& schema, const std::string& where) {
    json fields = json::object();
    json required = json::array();
    json others;
    bool any = false;
    Gather(schema, fields, required, any, others);
    // Nothing is said of its fields.
    if (fields.empty() && others.is_null()) return;
    for (const json& name : required) {
      if (!value.contains(name.get<std::string>())) {
        wrong_.push_back(where + " lacks " + name.get<std::string>());
      }
    }
    for (const auto& [name, field] : value.items()) {
      if (fields.contains(name)) {
        Check(field, fields[name], where + "." + name);
      } else if (!others.is_null()) {
        Check(field, others, where + "." + name);
      } else if (!any) {
        wrong_.push_back(where + "." + name + " is not described");
      }
    }
  }

  const json& description_;
  std::vector<std::string> wrong_;
};

// The path as it is described, of several the one with the fewest variables.
std::optional<std::string> DescribedPath(const json& description, const std::string& path) {
  std::optional<std::string> best;
  for (const auto& [described, methods] : description["paths"].items()) {
    const std::string pattern = std::regex_replace(described, std::regex(R"(\{[^}]*\})"), "[^/]+");
    if (!std::regex_match(path, std::regex(pattern))) continue;
    const auto variables = [](const std::string& of) {
      return std::count(of.begin(), of.end(), '{');
    };
    if (!best || variables(described) < variables(*best)) best = described;
  }
  return best;
}

// Returns whether this is an answer that the description has for all requests alike.
bool IsRefusedLikeAny(const httplib::Response& response) {
  static const std::vector<int> kLikeAny{401, 403, 404, 405, 411, 413, 415, 421, 500};
  return std::find(kLikeAny.begin(), kLikeAny.end(), response.status) != kLikeAny.end();
}

}  // namespace

json ReadDescription(const std::string& yaml) { return BlockReader(yaml).Read(); }

std::vector<std::string> UnlikeDescribed(const json& description, const httplib::Request& request,
                                         const httplib::Response& response) {
  const std::string asked = request.path.substr(0, request.path.find('?'));
  if (!asked.starts_with("/api/") || asked == "/api/openapi.yaml") return {};
  std::string method = request.method;
  for (char& c : method) c = static_cast<char>(std::tolower(c));
  const std::string where = request.method + " " + asked;
  const auto path = DescribedPath(description, asked);
  const bool is_described = path && description["paths"][*path].contains(method);
  if (!is_described) {
    if (IsRefusedLikeAny(response)) return {};
    return {where + " is not described"};
  }
  Checker checker(description);
  const json& answers = description["paths"][*path][method]["responses"];
  const std::string status = std::to_string(response.status);
  if (!answers.contains(status)) {
    if (IsRefusedLikeAny(response)) return {};
    return {where + " answers " + status + ", which is not described"};
  }
  const std::string type = response.get_header_value("Content-Type");
  if (!type.starts_with("application/json") || response.body.empty()) return {};
  const json& answer = checker.Resolve(answers[status]);
  const auto content = answer.value("content", json::object());
  if (!content.contains("application/json")) return {};
  checker.Check(json::parse(response.body), content["application/json"]["schema"],
                where + " " + status + ": ");
  return checker.TakeWrong();
}

httplib::Logger ExpectAsDescribed() {
  static const json kDescription = [] {
    for (const File& file : Files()) {
      if (std::string(file.path) == "/api/openapi.yaml") {
        return ReadDescription(std::string(file.bytes));
      }
    }
    return json();
  }();
  return [](const httplib::Request& request, const httplib::Response& response) {
    for (const std::string& wrong : UnlikeDescribed(kDescription, request, response)) {
      ADD_FAILURE() << "openapi.yaml: " << wrong;
    }
  };
}

}  // namespace trailcast::console
