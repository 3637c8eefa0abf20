#include "tests/unit/vda5050/json_schema.h"

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

#include "tests/support/places.h"

namespace trailcast::vda5050 {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

bool IsOfType(const json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  return false;
}

class Checker {
 public:
  explicit Checker(const json& root) : root_(root) {}

  void Check(const json& schema, const json& value, const std::string& at) {
    static const std::set<std::string> kSaysNothing{
        "$schema",     "subtopic", "title",       "examples", "unit",
        "description", "$id",      "definitions", "$comment", "properties"};
    for (const auto& [keyword, rule] : schema.items()) {
      if (keyword == "$ref") {
        Check(root_.at(json::json_pointer(rule.get<std::string>().substr(1))), value, at);
      } else if (keyword == "type") {
        CheckType(rule, value, at);
      } else if (keyword == "required") {
        for (const json& name : rule) {
          if (value.is_object() && !value.contains(name)) Add(at, "lacks " + name.dump());
        }
      } else if (keyword == "items") {
        if (!value.is_array()) continue;
        for (std::size_t i = 0; i < value.size(); ++i) {
          Check(rule, value[i], at + "/" + std::to_string(i));
        }
      } else if (keyword == "enum") {
        if (std::find(rule.begin(), rule.end(), value) == rule.end()) {
          Add(at, value.dump() + " is none of " + rule.dump());
        }
      } else if (keyword == "minimum" || keyword == "maximum") {
        if (!value.is_number()) continue;
        const bool is_least = keyword == "minimum";
        const double bound = rule.get<double>();
        const auto number = value.get<double>();
        if (is_least ? number < bound : number > bound) Add(at, value.dump() + " is out of bounds");
      } else if (keyword == "format") {
        static const std::regex kTime(R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(\.\d+)?Z)");
        if (rule == "date-time" && value.is_string() &&
            !std::regex_match(value.get<std::string>(), kTime)) {
          Add(at, value.dump() + " is no date-time");
        }
      } else if (!kSaysNothing.contains(keyword)) {
        Add(at, "the schema has the keyword " + keyword + ", which is not known here");
      }
    }
    if (!schema.contains("properties") || !value.is_object()) return;
    for (const auto& [name, rule] : schema.at("properties").items()) {
      if (value.contains(name)) Check(rule, value.at(name), at + "/" + name);
    }
  }

  std::vector<std::string> violations{};

 private:
  void Add(const std::string& at, const std::string& what) {
    violations.push_back((at.empty() ? "/" : at) + ": " + what);
  }
  void CheckType(const json& rule, const json& value, const std::string& at) {
    const json types = rule.is_array() ? rule : json::array({rule});
    for (const json& type : types) {
      if (IsOfType(value, type.get<std::string>())) return;
    }
    Add(at, value.dump() + " is no " + rule.dump());
  }

  const json& root_;
};

fs::path Schemas() { return fs::path(SourceDir()) / ".." / "shared" / "conformance" / "vda5050"; }

}  // namespace

std::vector<std::string> Violations(const json& schema, const json& value) {
  Checker checker(schema);
  checker.Check(schema, value, "");
  return std::move(checker.violations);
}

bool HasSchemas() { return fs::is_directory(Schemas()); }

std::vector<std::string> Violations(Version version, const std::string& topic,
                                    const std::string& message) {
  const fs::path file =
      Schemas() / (version == Version::k3_0 ? "v3" : "v2.1") / (topic + ".schema");
  std::ifstream stream(file);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  const json schema = json::parse(text, nullptr, false);
  const json value = json::parse(message, nullptr, false);
  if (schema.is_discarded()) return {file.string() + " is no JSON"};
  if (value.is_discarded()) return {"the message is no JSON: " + message};
  return Violations(schema, value);
}

}  // namespace trailcast::vda5050
